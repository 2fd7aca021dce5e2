#pragma once
// The laws of light: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/light/slab.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
