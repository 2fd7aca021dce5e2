// The laws of rain and snow: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_PRECIPITATION_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_PRECIPITATION_LAW_INL
#undef WELKIN_PRECIPITATION_LAW_INL
#else
#define WELKIN_PRECIPITATION_LAW_INL
#endif
#include "welkin/base/law_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/precipitation/precipitation.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
