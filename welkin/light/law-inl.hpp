// The laws of light: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_LIGHT_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_LIGHT_LAW_INL
#undef WELKIN_LIGHT_LAW_INL
#else
#define WELKIN_LIGHT_LAW_INL
#endif
#include "welkin/base/law_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/light/slab.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
