#pragma once
// The SIMD parts of the room under the current target, one lane after another, for tests. Counts are multiples of 64.
#include <cstdint>
#include <functional>
#include <hwy/targets.h>
#include <span>

#include "welkin/trace/phase_table.hpp"

namespace welkin::lanes {

// Numbers first + 0, 1, 2 ... of the paths (index i, sample), i counting through `out`: `skip` numbers are left out.
void randomNumbers(std::uint32_t seed, std::uint32_t sample, int skip, std::span<float> out);
// Every second lane draws twice, the others once; writes what all lanes draw next.
void maskedNumbers(std::uint32_t seed, std::span<float> out);

void samplePhase(const PhaseTableView& table, std::span<const float> u, std::span<float> versine, std::span<float> pdf);
void phasePdf(const PhaseTableView& table, std::span<const float> versine, std::span<float> pdf);
void evaluatePhase(const PhaseTableView& table, std::span<const float> versine, std::span<float> value);

// Runs `body` once for every instruction set of this machine.
inline void forEachTarget(const std::function<void(const char* name)>& body) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    body(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace welkin::lanes
