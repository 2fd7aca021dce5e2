// The laws of atmosphere: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_ATMOSPHERE_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_ATMOSPHERE_LAW_INL
#undef WELKIN_ATMOSPHERE_LAW_INL
#else
#define WELKIN_ATMOSPHERE_LAW_INL
#endif
#include "welkin/light/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#include "welkin/atmosphere/night.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
