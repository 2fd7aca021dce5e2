#pragma once
// The laws of atmosphere: scalar C++ reading.
#include "welkin/light/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#include "welkin/atmosphere/night.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
