// The laws of noise: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_NOISE_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_NOISE_LAW_INL
#undef WELKIN_NOISE_LAW_INL
#else
#define WELKIN_NOISE_LAW_INL
#endif
#include "welkin/base/law_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
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
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
