#pragma once
// The laws of density: scalar C++ reading.
#include "welkin/noise/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/density/profile.glsl"
#include "welkin/density/nubis.glsl"
#include "welkin/density/sheet.glsl"
#include "welkin/density/scatter.glsl"
#include "welkin/density/hero.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
