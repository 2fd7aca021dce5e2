// The sky's distribution in SIMD lanes: see sky_distribution.hpp. Include it after hwy/foreach_target.h.
#if defined(WELKIN_TRACE_SKY_DISTRIBUTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_TRACE_SKY_DISTRIBUTION_INL
#undef WELKIN_TRACE_SKY_DISTRIBUTION_INL
#else
#define WELKIN_TRACE_SKY_DISTRIBUTION_INL
#endif
#include "welkin/light/law-inl.hpp"
#include "welkin/trace/sky_distribution.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

// A direction for three numbers in [0, 1).
HWY_INLINE law::Vec3 sampleSky(const trace::SkyDistributionView& sky, law::Real u, law::Real v, law::Real w) {
  using law::Int, law::Real;
  constexpr int kRows = trace::SkyDistributionView::kRows, kColumns = trace::SkyDistributionView::kColumns;
  const Real scaled = u * static_cast<float>(kRows * kColumns), whole = law::floor(scaled);
  const Int chosen = law::toInt(whole);
  const Int other(law::hn::GatherIndex(law::DI(), sky.alias, chosen.v));
  const Int cell = law::select(scaled - whole < law::gather(sky.keep, chosen), chosen, other);
  const Int row(law::hn::ShiftRight<7>(cell.v));
  static_assert(kColumns == 1 << 7);
  const Int column = cell & Int(kColumns - 1);
  const Real z = (law::toReal(row) + v) * (2.0f / kRows) - 1.0f;
  const Real azimuth = (law::toReal(column) + w) * (6.28318531f / kColumns);
  const Real s = law::sqrt(law::max(1.0f - z * z, 0.0f));
  return law::Vec3(s * law::cos(azimuth), s * law::sin(azimuth), z);
}

// The density of sampleSky in a direction, in 1/sr.
HWY_INLINE law::Real skyPdf(const trace::SkyDistributionView& sky, law::Vec3 way) {
  using law::Int, law::Real;
  constexpr int kRows = trace::SkyDistributionView::kRows, kColumns = trace::SkyDistributionView::kColumns;
  const Real flat = law::sqrt(law::max(way.x * way.x + way.y * way.y, Real(1e-20f)));
  const Real half = law::acos(law::clamp(way.x / flat, Real(-1.0f), Real(1.0f))) * (1.0f / 6.28318531f);
  const Real turn = law::select(way.y < 0.0f, 1.0f - half, half);
  const auto within = [](Real x, int n) { return law::min(law::max(law::floorInt(x), Int(0)), Int(n - 1)); };
  const Int row = within((way.z + 1.0f) * (0.5f * kRows), kRows);
  const Int column = within(turn * static_cast<float>(kColumns), kColumns);
  return law::gather(sky.density, row * Int(kColumns) + column);
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
