#include "welkin/density/classical/balls.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "welkin/density/hero_shape.hpp"

namespace welkin {

namespace {

constexpr int kMostCells = 48;  // on an axis of a grid of balls

// A place on the base, evenly over an ellipse that leaves `margin` m to the box's sides, and how far out it is.
struct Spot {
  float x, y, out;
};
Spot spotIn(const glm::vec3& size, float margin, float spread, HeroDice& dice) {
  const float angle = dice(0.0f, 6.2831853f), out = std::pow(dice(0.0f, 1.0f), spread);
  const auto reach = [&](float length) { return std::max(0.5f * length - margin, 0.0f); };
  return {reach(size.x) * out * std::cos(angle), reach(size.y) * out * std::sin(angle), out};
}

// Height of a heap over a spot, as a share.
float heap(float out) { return 1.0f - 0.8f * out * out; }

float radiusOf(float mean, float variation, HeroDice& dice) { return mean * std::exp2(variation * dice(-1.0f, 1.0f)); }

}  // namespace

Balls::Balls(std::vector<glm::vec4> balls) : balls_(std::move(balls)) {
  glm::vec3 low(1e30f), high(-1e30f);
  float largest = 0.0f;
  for (const glm::vec4& b : balls_) {
    low = glm::min(low, glm::vec3(b) - b.w);
    high = glm::max(high, glm::vec3(b) + b.w);
    largest = std::max(largest, b.w);
  }
  origin_ = low;
  const glm::vec3 size = high - low;
  dims_ = glm::clamp(glm::ivec3(2.0f * size / largest), glm::ivec3(1), glm::ivec3(kMostCells));
  inverseCell_ = glm::vec3(dims_) / glm::max(size, glm::vec3(1e-6f));
  const std::size_t cells = std::size_t(dims_.x) * dims_.y * dims_.z;
  std::vector<std::vector<std::uint32_t>> lists(cells);
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    const glm::vec3 c(balls_[i]);
    const auto cellOf = [&](const glm::vec3& p) {
      return glm::clamp(glm::ivec3(glm::floor((p - origin_) * inverseCell_)), glm::ivec3(0), dims_ - 1);
    };
    const glm::ivec3 from = cellOf(c - balls_[i].w), to = cellOf(c + balls_[i].w);
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) lists[cellAt({x, y, z})].push_back(static_cast<std::uint32_t>(i));
  }
  first_.push_back(0);
  for (const auto& list : lists) {
    inCell_.insert(inCell_.end(), list.begin(), list.end());
    first_.push_back(static_cast<std::uint32_t>(inCell_.size()));
  }
}

Balls makeMetaballs(const MetaballSettings& s, const glm::vec3& size, std::uint32_t seed) {
  HeroDice dice(seed);
  std::vector<glm::vec4> balls;
  for (int i = 0; i < s.count; ++i) {
    // The balls of the rim are smaller; none is larger than the box.
    const Spot spot = spotIn(size, s.radius * size.x, 0.6f, dice);
    const float most = 0.5f * std::min({size.x, size.y, size.z});
    const float radius = std::min(radiusOf(s.radius * size.x, s.variation, dice) * (1.0f - 0.4f * spot.out), most);
    const float room = std::max(heap(spot.out) * size.z - radius, 0.2f * radius);
    balls.emplace_back(spot.x, spot.y, room * dice(0.0f, 1.0f), radius);
  }
  return Balls(std::move(balls));
}

std::vector<Ellipsoid> makeEllipsoids(int count, const glm::vec3& size, std::uint32_t seed) {
  HeroDice dice(seed);
  std::vector<Ellipsoid> heapOf{{{0.0f, 0.0f, 0.1f * size.z}, size * glm::vec3(0.3f, 0.3f, 0.85f)}};
  for (int i = 1; i < count; ++i) {
    const Spot spot = spotIn(size, 0.16f * std::min(size.x, size.y), 0.6f, dice);
    const glm::vec3 axes =
        size * glm::vec3(dice(0.12f, 0.2f), dice(0.12f, 0.2f), dice(0.25f, 0.45f) * (1.0f - 0.5f * spot.out));
    const float room = std::max(heap(spot.out) * size.z - axes.z, 0.0f);
    heapOf.push_back({{spot.x, spot.y, 0.7f * room * dice(0.0f, 1.0f)}, axes});
  }
  return heapOf;
}

Balls makeParticles(const ParticleSettings& s, const glm::vec3& size, std::uint32_t seed) {
  HeroDice dice(seed);
  const std::vector<Ellipsoid> puffs = makeEllipsoids(s.puffs, size * 0.9f, seed + 1u);
  std::vector<glm::vec4> balls;
  for (int i = 0; i < s.count; ++i) {
    const Ellipsoid& puff = puffs[std::min(
        static_cast<std::size_t>(dice(0.0f, 1.0f) * static_cast<float>(puffs.size())), puffs.size() - 1)];
    const float angle = dice(0.0f, 6.2831853f), up = dice(-0.3f, 1.0f), flat = std::sqrt(1.0f - up * up);
    const float out = std::cbrt(dice(0.1f, 1.0f));
    const float radius =
        std::min(radiusOf(s.radius * size.x, s.variation, dice), 0.5f * std::min({size.x, size.y, size.z}));
    const glm::vec3 p = puff.centre + puff.axes * out * glm::vec3(flat * std::cos(angle), flat * std::sin(angle), up);
    balls.emplace_back(p.x, p.y, std::max(p.z, 0.0f), radius);
  }
  return Balls(std::move(balls));
}

float metaballDensity(const Balls& balls, const MetaballSettings& s, const glm::vec3& p) {
  float sum = 0.0f;
  balls.near(p, [&](float d) { sum += metaballField(d); });
  return std::clamp((s.strength * sum - s.threshold) / (1.0f - s.threshold), 0.0f, 1.0f);
}

float particleDensity(const Balls& balls, const ParticleSettings& s, const glm::vec3& p) {
  float through = 1.0f;
  balls.near(p, [&](float d) { through *= 1.0f - s.opacity * (1.0f - d) * (1.0f - d); });
  return 1.0f - through;
}

}  // namespace welkin
