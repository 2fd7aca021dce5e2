// The laws that hold a scene together: SIMD reading. Include it after hwy/foreach_target.h.
#if defined(WELKIN_SCENE_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_SCENE_LAW_INL
#undef WELKIN_SCENE_LAW_INL
#else
#define WELKIN_SCENE_LAW_INL
#endif
#include "welkin/density/law-inl.hpp"
#include "welkin/precipitation/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#include "welkin/scene/camera.glsl"
#include "welkin/scene/rain.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
