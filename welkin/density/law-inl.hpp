// The laws of density: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_DENSITY_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_DENSITY_LAW_INL
#undef WELKIN_DENSITY_LAW_INL
#else
#define WELKIN_DENSITY_LAW_INL
#endif
#include "welkin/noise/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/density/profile.glsl"
#include "welkin/density/nubis.glsl"
#include "welkin/density/sheet.glsl"
#include "welkin/density/scatter.glsl"
#include "welkin/density/hero.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
