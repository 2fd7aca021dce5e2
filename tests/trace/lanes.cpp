// Once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/trace/lanes.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include "tests/trace/lanes.hpp"
#include "welkin/trace/phase_table-inl.hpp"
#include "welkin/trace/random-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

using law::Real, law::Uint;

static Real load(const float* p) { return law::hn::LoadU(law::D(), p); }
static void store(Real x, float* p) { law::hn::StoreU(x.v, law::D(), p); }
static Uint indices(std::size_t i) { return law::hn::Iota(law::DU(), static_cast<std::uint32_t>(i)); }

static void randomNumbers(std::uint32_t seed, std::uint32_t sample, int skip, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); i += law::laneCount()) {
    Random random = seedRandom(seed, indices(i), Uint(sample));
    for (int k = 0; k < skip; ++k) next(random);
    store(next(random), out.data() + i);
  }
}

static void maskedNumbers(std::uint32_t seed, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); i += law::laneCount()) {
    Random random = seedRandom(seed, indices(i), Uint(0u));
    next(random);
    next(random, (indices(i) & Uint(1u)) == Uint(0u));
    store(next(random), out.data() + i);
  }
}

static void samplePhases(const PhaseTableView& table, std::span<const float> u, std::span<float> versine,
                         std::span<float> pdf) {
  for (std::size_t i = 0; i < u.size(); i += law::laneCount()) {
    const PhaseSample s = samplePhase(table, load(u.data() + i));
    store(s.versine, versine.data() + i);
    store(s.pdf, pdf.data() + i);
  }
}

static void phasePdfs(const PhaseTableView& table, std::span<const float> versine, std::span<float> pdf) {
  for (std::size_t i = 0; i < pdf.size(); i += law::laneCount())
    store(phasePdf(table, load(versine.data() + i)), pdf.data() + i);
}

static void evaluatePhases(const PhaseTableView& table, std::span<const float> versine, std::span<float> value) {
  for (std::size_t i = 0; i < value.size(); i += law::laneCount())
    store(evaluatePhase(table, load(versine.data() + i)), value.data() + i);
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(randomNumbers);
HWY_EXPORT(maskedNumbers);
HWY_EXPORT(samplePhases);
HWY_EXPORT(phasePdfs);
HWY_EXPORT(evaluatePhases);

namespace lanes {
void randomNumbers(std::uint32_t seed, std::uint32_t sample, int skip, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(randomNumbers)(seed, sample, skip, out);
}
void maskedNumbers(std::uint32_t seed, std::span<float> out) { HWY_DYNAMIC_DISPATCH(maskedNumbers)(seed, out); }
void samplePhase(const PhaseTableView& table, std::span<const float> u, std::span<float> versine,
                 std::span<float> pdf) {
  HWY_DYNAMIC_DISPATCH(samplePhases)(table, u, versine, pdf);
}
void phasePdf(const PhaseTableView& table, std::span<const float> versine, std::span<float> pdf) {
  HWY_DYNAMIC_DISPATCH(phasePdfs)(table, versine, pdf);
}
void evaluatePhase(const PhaseTableView& table, std::span<const float> versine, std::span<float> value) {
  HWY_DYNAMIC_DISPATCH(evaluatePhases)(table, versine, value);
}
}  // namespace lanes
}  // namespace welkin
#endif
