// The SIMD readings of every case, once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/parity/simd.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include "tests/parity/parity.hpp"
#include "welkin/atmosphere/law-inl.hpp"
#include "welkin/base/law_tone-inl.hpp"
#include "welkin/density/law-inl.hpp"
#include "welkin/light/law-inl.hpp"
#include "welkin/noise/law-inl.hpp"
#include "welkin/scene/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {
#include "welkin/base/law_begin.inc"
#define LAW(...) __VA_ARGS__
#define CASE(name, tolerance, scale, lowA, highA, lowB, highB, ...)                                                  \
  [[maybe_unused]] static Vec4 case_##name([[maybe_unused]] const Vec4& a, [[maybe_unused]] const Vec4& b,           \
                                           [[maybe_unused]] const Sampler2& s2, [[maybe_unused]] const Sampler3& s3, \
                                           [[maybe_unused]] const Sampler2Array& sA) __VA_ARGS__
#include "tests/parity/cases.inc"
#undef CASE
#undef LAW
#include "welkin/base/law_end.inc"

using CaseFunction = Vec4 (*)(const Vec4&, const Vec4&, const Sampler2&, const Sampler3&, const Sampler2Array&);
static const CaseFunction kCases[] = {
#define LAW(...)
#define CASE(name, ...) &case_##name,
#include "tests/parity/cases.inc"
#undef CASE
#undef LAW
};

static Vec4 loadLanes(const glm::vec4* p) {
  const std::size_t n = laneCount();
  alignas(64) float lanes[4][64];
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 4; ++c) lanes[c][i] = p[i][c];
  return Vec4(hn::Load(D(), lanes[0]), hn::Load(D(), lanes[1]), hn::Load(D(), lanes[2]), hn::Load(D(), lanes[3]));
}

static void storeLanes(const Vec4& v, glm::vec4* p) {
  const std::size_t n = laneCount();
  alignas(64) float lanes[4][64];
  hn::Store(v.x.v, D(), lanes[0]);
  hn::Store(v.y.v, D(), lanes[1]);
  hn::Store(v.z.v, D(), lanes[2]);
  hn::Store(v.w.v, D(), lanes[3]);
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 4; ++c) p[i][c] = lanes[c][i];
}

}  // namespace welkin::HWY_NAMESPACE::law

namespace welkin::HWY_NAMESPACE {
static void evaluateCase(std::size_t index, const glm::vec4* a, const glm::vec4* b, const TextureView& s2,
                         const TextureView& s3, const TextureView& sA, glm::vec4* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += law::laneCount())
    law::storeLanes(law::kCases[index](law::loadLanes(a + i), law::loadLanes(b + i), s2, s3, sA), out + i);
}
static std::size_t lanesOfTarget() { return law::laneCount(); }
}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(evaluateCase);
HWY_EXPORT(lanesOfTarget);

namespace parity {
void evaluateSimd(std::size_t index, const glm::vec4* a, const glm::vec4* b, const TextureView& s2,
                  const TextureView& s3, const TextureView& sA, glm::vec4* out, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(evaluateCase)(index, a, b, s2, s3, sA, out, count);
}
std::size_t simdLanes() { return HWY_DYNAMIC_DISPATCH(lanesOfTarget)(); }
}  // namespace parity
}  // namespace welkin
#endif
