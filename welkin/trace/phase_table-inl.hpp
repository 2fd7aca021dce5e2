// Phase tables in SIMD lanes: see phase_table.hpp. Include it after hwy/foreach_target.h.
#if defined(WELKIN_TRACE_PHASE_TABLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_TRACE_PHASE_TABLE_INL
#undef WELKIN_TRACE_PHASE_TABLE_INL
#else
#define WELKIN_TRACE_PHASE_TABLE_INL
#endif
#include <bit>

#include "welkin/light/law-inl.hpp"
#include "welkin/trace/phase_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

struct PhaseSample {
  law::Real versine, pdf;  // 1 - cosTheta, and its density in 1/sr
};

// The last place in [from, to) whose key is not above `value`; keys ascend and `from` qualifies.
HWY_INLINE law::Int lastNotAbove(const float* keys, law::Int from, law::Int to, law::Real value, int steps) {
  for (int i = 0; i < steps; ++i) {
    const law::Int middle = law::Int(law::hn::ShiftRight<1>((from + to).v));
    const law::Mask below = law::gather(keys, middle) <= value;
    from = law::select(below, middle, from);
    to = law::select(below, to, middle);
  }
  return from;
}

// A scattering angle for u in [0, 1).
HWY_INLINE PhaseSample samplePhase(const PhaseTableView& t, law::Real u) {
  using law::Int, law::Real;
  const Real scaled = u * float(PhaseTable::kCells), cell = law::floor(scaled);
  const Real r = scaled - cell + float(PhaseTable::kCells) * 0x1p-25f;  // middle of the step of 24 bits
  Int segment = law::toInt(cell);
  Real x = r;
  if (t.cellSteps > 0) {
    const auto first = [&](Int i) { return Int(law::hn::GatherIndex(law::DI(), t.firstSegment, i.v)); };
    segment = lastNotAbove(t.fraction, first(segment), first(segment + Int(1)), r, t.cellSteps);
    x = law::min((r - law::gather(t.fraction, segment)) / law::gather(t.mass, segment), Real(1.0f));
  }
  const Real a = law::gather(t.low, segment), b = law::gather(t.high, segment);
  const Real density = law::sqrt(law::mix(a * a, b * b, x));
  const Real along = x * (a + b) / law::max(a + density, Real(1e-30f));
  return {law::min(law::gather(t.versine, segment) + law::gather(t.width, segment) * along, Real(2.0f)), density};
}

// The density of samplePhase at a versine, in 1/sr.
HWY_INLINE law::Real phasePdf(const PhaseTableView& t, law::Real versine) {
  const law::Int i = lastNotAbove(t.versine, law::Int(0), law::Int(t.segments), versine, t.segmentSteps);
  const law::Real x =
      law::saturate((versine - law::gather(t.versine, i)) / law::max(law::gather(t.width, i), law::Real(1e-30f)));
  return law::mix(law::gather(t.low, i), law::gather(t.high, i), x);
}

// The phase function itself at a versine, in 1/sr.
HWY_INLINE law::Real evaluatePhase(const PhaseTableView& t, law::Real versine) {
  if (t.rows == 0) return law::phaseMieOfVersine(versine, std::bit_cast<law::MiePhase>(t.mie));
  const law::Int i = lastNotAbove(t.rowVersine, law::Int(0), law::Int(t.rows - 1), versine, t.rowSteps);
  const law::Real v0 = law::gather(t.rowVersine, i), v1 = law::gather(t.rowVersine, i + law::Int(1));
  const law::Real x = law::saturate((versine - v0) / law::max(v1 - v0, law::Real(1e-30f)));
  return law::mix(law::gather(t.rowValue, i), law::gather(t.rowValue, i + law::Int(1)), x);
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
