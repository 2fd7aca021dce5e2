#include "welkin/base/angle.hpp"
#include "welkin/trace/sky_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace welkin::trace {

namespace {
constexpr float kFloor = 0.05f;  // least density, as a share of the mean: cells are not seen everywhere
// Where the sky is even, phase functions find its light as well as a table of it: what counts is the light above
// kEven times the mean. Below kLeastShare the questions that the sun loses cost more than they bring. By measured
// efficiency.
constexpr float kEven = 4.0f, kMostShare = 0.5f, kLeastShare = 0.05f;
}  // namespace

SkyDistribution::SkyDistribution(const std::function<float(const glm::vec3&)>& luminance, float sun) {
  constexpr int kRows = SkyDistributionView::kRows, kColumns = SkyDistributionView::kColumns, kCells = kRows * kColumns;
  std::vector<double> weight(kCells);
  double sum = 0.0;
  std::size_t next = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      double cell = 0.0;
      for (const float u : {0.25f, 0.75f})
        for (const float v : {0.25f, 0.75f}) {
          const float z = 2.0f * (static_cast<float>(row) + u) / kRows - 1.0f;
          const float azimuth = 2.0f * kPiFloat * (static_cast<float>(column) + v) / kColumns;
          const float s = std::sqrt(std::max(1.0f - z * z, 0.0f));
          const float l = luminance({s * std::cos(azimuth), s * std::sin(azimuth), z});
          if (l > 0.0f && std::isfinite(l)) cell += 0.25 * l;
        }
      weight[next++] = cell;
      sum += cell;
    }
  if (!(sum > 0.0)) return;
  double bright = 0.0;
  for (const double w : weight) bright += std::max(w - kEven * sum / kCells, 0.0) * (4.0 * kPiFloat / kCells);
  share_ = kMostShare * static_cast<float>(bright / (bright + sun + 1e-30));
  if (share_ < kLeastShare) {
    share_ = 0.0f;  // no table, then
    return;
  }
  for (double& w : weight) w = std::max(w * kCells / sum, static_cast<double>(kFloor));
  const double mean = std::accumulate(weight.begin(), weight.end(), 0.0) / kCells;
  for (const double w : weight) density_.push_back(static_cast<float>(w / mean / (4.0 * kPiFloat)));
  keep_.assign(kCells, 1.0f);
  alias_.resize(kCells);
  std::iota(alias_.begin(), alias_.end(), 0);
  std::vector<int> small, large;
  for (int i = 0; i < kCells; ++i) {
    weight[static_cast<std::size_t>(i)] /= mean;
    (weight[static_cast<std::size_t>(i)] < 1.0 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const auto low = static_cast<std::size_t>(small.back()), high = static_cast<std::size_t>(large.back());
    small.pop_back();
    keep_[low] = static_cast<float>(weight[low]);
    alias_[low] = large.back();
    weight[high] -= 1.0 - weight[low];
    if (weight[high] < 1.0) {
      small.push_back(large.back());
      large.pop_back();
    }
  }
}

}  // namespace welkin::trace
