#pragma once
// The laws of noise: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
// clang-format off
#include "welkin/base/law_begin.inc"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/perlin.glsl"
#include "welkin/noise/simplex.glsl"
#include "welkin/noise/worley.glsl"
#include "welkin/noise/fbm.glsl"
#include "welkin/noise/gamma.glsl"
#include "welkin/noise/perlin_worley.glsl"
#include "welkin/noise/curl.glsl"
#include "welkin/noise/textures.glsl"
#include "welkin/base/law_end.inc"
// clang-format on
}  // namespace welkin::law
