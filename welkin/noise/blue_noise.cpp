#include "welkin/noise/blue_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace welkin {

namespace {

constexpr float kSpread = 1.9f;  // texels
constexpr int kReach = 11;       // texels: farther away the kernel is below a float's share of its peak

// Points on a torus, and how crowded it is round every texel.
class Pattern {
 public:
  explicit Pattern(int size) : size_(size), reach_(std::min(kReach, (size - 1) / 2)), crowd_(count()), set_(count()) {
    for (int d = 0; d <= reach_; ++d)
      kernel_.push_back(std::exp(-static_cast<float>(d * d) / (2.0f * kSpread * kSpread)));
  }
  void put(std::size_t texel, bool on) {
    set_[texel] = on;
    const int px = static_cast<int>(texel) % size_, py = static_cast<int>(texel) / size_;
    for (int dy = -reach_; dy <= reach_; ++dy) {
      const float row = (on ? 1.0f : -1.0f) * kernel_[static_cast<std::size_t>(std::abs(dy))];
      for (int dx = -reach_; dx <= reach_; ++dx)
        crowd_[at((px + dx + size_) % size_, (py + dy + size_) % size_)] +=
            row * kernel_[static_cast<std::size_t>(std::abs(dx))];
    }
  }
  std::size_t tightestCluster() const {
    return extreme(true, [](float a, float b) { return a > b; });
  }
  std::size_t largestVoid() const {
    return extreme(false, [](float a, float b) { return a < b; });
  }
  std::size_t count() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }
  bool has(std::size_t texel) const { return set_[texel] != 0; }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + x; }
  template <class Better>
  std::size_t extreme(bool on, Better better) const {
    std::size_t best = count();
    for (std::size_t i = 0; i < count(); ++i)
      if ((set_[i] != 0) == on && (best == count() || better(crowd_[i], crowd_[best]))) best = i;
    return best;
  }

  int size_, reach_;
  std::vector<float> kernel_, crowd_;
  std::vector<char> set_;
};

}  // namespace

std::vector<float> blueNoise(int size, std::uint32_t seed) {
  size = std::clamp(size, 4, 128);
  Pattern pattern(size);
  const std::size_t all = pattern.count(), first = all / 10;
  std::mt19937 random(seed);
  for (std::size_t placed = 0; placed < first;) {
    const std::size_t texel = random() % all;
    if (pattern.has(texel)) continue;
    pattern.put(texel, true);
    ++placed;
  }
  // Move points from clusters into voids until that changes nothing.
  for (std::size_t i = 0; i < all; ++i) {
    const std::size_t from = pattern.tightestCluster();
    pattern.put(from, false);
    const std::size_t to = pattern.largestVoid();
    pattern.put(to, true);
    if (from == to) break;
  }
  std::vector<float> values(all);
  const auto valueOf = [&](std::size_t rank) { return (static_cast<float>(rank) + 0.5f) / static_cast<float>(all); };
  Pattern emptied = pattern;
  for (std::size_t rank = first; rank-- > 0;) {
    const std::size_t texel = emptied.tightestCluster();
    values[texel] = valueOf(rank);
    emptied.put(texel, false);
  }
  for (std::size_t rank = first; rank < all; ++rank) {
    const std::size_t texel = pattern.largestVoid();
    values[texel] = valueOf(rank);
    pattern.put(texel, true);
  }
  return values;
}

}  // namespace welkin
