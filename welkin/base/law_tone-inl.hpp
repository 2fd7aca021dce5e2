// The law of tone: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_TONE_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_TONE_LAW_INL
#undef WELKIN_TONE_LAW_INL
#else
#define WELKIN_TONE_LAW_INL
#endif
#include "welkin/base/law_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/base/tone.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
