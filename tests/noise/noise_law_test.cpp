// What each noise promises: range, zeros, periods, exact distances, curl without divergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "welkin/noise/law.hpp"

namespace welkin {
namespace {

using law::Vec2, law::Vec3, law::Vec4;

std::vector<Vec4> randomPoints(int count, float low, float high, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(low, high);
  std::vector<Vec4> points(static_cast<std::size_t>(count));
  for (Vec4& p : points) p = {uniform(random), uniform(random), uniform(random), uniform(random)};
  return points;
}

TEST(Perlin, IsZeroAtLatticePointsAndStaysInRange) {
  for (int i = -5; i < 5; ++i)
    for (int j = -5; j < 5; ++j) {
      EXPECT_EQ(law::perlin2(Vec2(i, j), 0, 1u), 0.0f);
      EXPECT_EQ(law::perlin3(Vec3(i, j, i + j), 7, 1u), 0.0f);
    }
  float least = 0, most = 0;
  for (const Vec4& p : randomPoints(2000000, -500, 500))
    for (const float n : {law::perlin2(Vec2(p), 0, 1u), law::perlin3(Vec3(p), 0, 1u)}) {
      least = std::min(least, n);
      most = std::max(most, n);
    }
  EXPECT_GE(least, -1.04f);
  EXPECT_LE(most, 1.04f);
  EXPECT_LT(least, -0.9f);
  EXPECT_GT(most, 0.9f);
}

TEST(Simplex, StaysInRangeAndFillsIt) {
  float most3 = 0, most4 = 0;
  for (const Vec4& p : randomPoints(2000000, -100, 100)) {
    most3 = std::max(most3, std::abs(law::simplex3(Vec3(p), 0, 1u)));
    most4 = std::max(most4, std::abs(law::simplex4(p, 0, 1u)));
  }
  EXPECT_LE(most3, 1.0f);
  EXPECT_GT(most3, 0.95f);
  EXPECT_LE(most4, 1.0f);
  EXPECT_GT(most4, 0.85f);
}

// Kernels that reached beyond the simplices would leave steps: a walk of 1e-4 moves the value by little.
TEST(Simplex, HasNoSteps) {
  float worst = 0;
  for (const Vec4& p : randomPoints(300000, -20, 20)) {
    const Vec4 q = p + Vec4(1e-4f, -0.7e-4f, 0.4e-4f, 0.9e-4f);
    worst = std::max(worst, std::abs(law::simplex3(Vec3(p), 0, 1u) - law::simplex3(Vec3(q), 0, 1u)));
    worst = std::max(worst, std::abs(law::simplex4(p, 0, 1u) - law::simplex4(q, 0, 1u)));
  }
  EXPECT_LT(worst, 2e-3f);
}

// Each noise on each axis: the same one period on, another half a period on, and never again without a period. Points
// are multiples of 1/64, so that adding the period is exact.
using NoiseAt = std::function<float(const Vec4&, int period)>;
void expectPeriod(const char* name, int axes, int period, const NoiseAt& field) {
  int moved = 0, unbounded = 0, count = 0;
  for (Vec4 p : randomPoints(500, 0, 60)) {
    p = glm::floor(p * 64.0f) / 64.0f;
    for (int axis = 0; axis < axes; ++axis) {
      Vec4 whole(0), half(0);
      whole[axis] = static_cast<float>(period);
      half[axis] = std::floor(static_cast<float>(period) / 2.0f);
      const float here = field(p, period);
      EXPECT_NEAR(here, field(p + whole, period), 1e-4f) << name << " axis " << axis;
      EXPECT_NEAR(here, field(p - 3.0f * whole, period), 1e-4f) << name << " axis " << axis;
      moved += std::abs(here - field(p + half, period)) > 1e-3f;
      unbounded += std::abs(field(p, 0) - field(p + whole, 0)) > 1e-3f;
      ++count;
    }
  }
  EXPECT_GT(moved, count * 8 / 10) << name;
  EXPECT_GT(unbounded, count * 8 / 10) << name;
}

TEST(Periods, EveryNoiseRepeatsOnEveryAxis) {
  using namespace law;
  expectPeriod("perlin2", 2, 5, [](const Vec4& p, int n) { return perlin2(Vec2(p), n, 1u); });
  expectPeriod("perlin3", 3, 8, [](const Vec4& p, int n) { return perlin3(Vec3(p), n, 1u); });
  expectPeriod("simplex3", 3, 6, [](const Vec4& p, int n) { return simplex3(Vec3(p), n, 1u); });
  expectPeriod("simplex4", 4, 9, [](const Vec4& p, int n) { return simplex4(p, n, 1u); });
  expectPeriod("worley2", 2, 5, [](const Vec4& p, int n) { return worley2(Vec2(p), n, kWorleyEuclidean, 1u).x; });
  expectPeriod("worley3", 3, 6, [](const Vec4& p, int n) { return worley3(Vec3(p), n, kWorleyManhattan, 1u).y; });
  expectPeriod("perlinFbm2", 2, 4, [](const Vec4& p, int n) { return perlinFbm2(Vec2(p), n, 4, 2, 0.5f, 1u); });
  expectPeriod("perlinFbm3", 3, 5, [](const Vec4& p, int n) { return perlinFbm3(Vec3(p), n, 4, 3, 0.5f, 1u); });
  expectPeriod("worleyFbm3", 3, 4, [](const Vec4& p, int n) { return worleyFbm3(Vec3(p), n, 3, 2, 0.5f, 1u); });
  expectPeriod("billowFbm3", 3, 4, [](const Vec4& p, int n) { return billowFbm3(Vec3(p), n, 3, 2, 0.5f, 1u); });
  expectPeriod("ridgeFbm3", 3, 4, [](const Vec4& p, int n) { return ridgeFbm3(Vec3(p), n, 3, 2, 0.5f, 1.8f, 1u); });
  expectPeriod("curlFbm2", 2, 4, [](const Vec4& p, int n) { return curlFbm2(Vec2(p), n, 3, 2, 0.5f, 1u).x; });
  expectPeriod("curlFbm3", 3, 4, [](const Vec4& p, int n) { return curlFbm3(Vec3(p), n, 2, 2, 0.5f, 1u).z; });
}

TEST(Periods, AxesMayDiffer) {
  const Vec3 p(1.25f, 2.5f, 0.75f);
  const glm::ivec3 periods(3, 4, 7);
  EXPECT_EQ(law::perlin3(p, periods, 1u), law::perlin3(p + Vec3(3, -4, 14), periods, 1u));
  EXPECT_NE(law::perlin3(p, periods, 1u), law::perlin3(p + Vec3(4, 0, 0), periods, 1u));
}

// A cell and a fraction keep their detail where a float has lost it.
TEST(Perlin, CellAndFractionWorkFarAway) {
  const int far = 1500000000;
  const float a = law::perlin2At({far, -far}, Vec2(0.25f, 0.5f), 0, 1u);
  const float b = law::perlin2At({far, -far}, Vec2(0.251f, 0.5f), 0, 1u);
  EXPECT_NE(a, b);
  EXPECT_NEAR(a, b, 0.01f);
  EXPECT_NE(a, law::perlin2At({far + 1, -far}, Vec2(0.25f, 0.5f), 0, 1u));
  const float c = law::perlinFbm2At({far, -far}, Vec2(0.25f, 0.5f), 0, 6, 2, 0.5f, 1u);
  EXPECT_NEAR(c, law::perlinFbm2At({far, -far}, Vec2(0.251f, 0.5f), 0, 6, 2, 0.5f, 1u), 0.02f);
}

// Against a search of 5^3 cells in double precision: exact wherever the answer is below the limit.
TEST(Worley, DistancesAreExact) {
  int cut = 0, count = 0;
  for (const Vec4& p : randomPoints(20000, -30, 30)) {
    for (const int metric : {law::kWorleyEuclidean, law::kWorleyManhattan}) {
      std::vector<double> distances;
      const glm::ivec3 cell(glm::floor(Vec3(p)));
      for (int z = -3; z <= 3; ++z)
        for (int y = -3; y <= 3; ++y)
          for (int x = -3; x <= 3; ++x) {
            const glm::ivec3 c = cell + glm::ivec3(x, y, z);
            const glm::dvec3 d =
                glm::dvec3(c) + glm::dvec3(law::worleyPoint3(law::hashCell3(c.x, c.y, c.z, 3u))) - glm::dvec3(Vec3(p));
            distances.push_back(metric == law::kWorleyManhattan ? std::abs(d.x) + std::abs(d.y) + std::abs(d.z)
                                                                : glm::length(d));
          }
      std::nth_element(distances.begin(), distances.begin() + 1, distances.end());
      const double limit = metric == law::kWorleyManhattan ? 2 : 1;
      const double f2 = distances[1], f1 = *std::min_element(distances.begin(), distances.begin() + 1);
      const Vec2 answer = law::worley3(Vec3(p), 0, metric, 3u);
      EXPECT_NEAR(answer.x, std::min(f1, limit), 1e-5);
      EXPECT_NEAR(answer.y, std::min(f2, limit), 1e-5);
      EXPECT_LE(answer.x, answer.y);
      cut += f1 > limit;
      ++count;
    }
  }
  EXPECT_LT(cut, count / 100) << "the limit should be the exception";
}

TEST(Worley, PlaneDistancesAreExact) {
  for (const Vec4& p : randomPoints(20000, -30, 30)) {
    double f1 = 9, f2 = 9;
    const glm::ivec2 cell(glm::floor(Vec2(p)));
    for (int y = -3; y <= 3; ++y)
      for (int x = -3; x <= 3; ++x) {
        const glm::ivec2 c = cell + glm::ivec2(x, y);
        const double d = glm::length(glm::dvec2(c) + glm::dvec2(law::worleyPoint2(law::hashCell2(c.x, c.y, 3u))) -
                                     glm::dvec2(Vec2(p)));
        f2 = std::min(f2, std::max(f1, d));
        f1 = std::min(f1, d);
      }
    const Vec2 answer = law::worley2(Vec2(p), 0, law::kWorleyEuclidean, 3u);
    EXPECT_NEAR(answer.x, std::min(f1, 2.0), 1e-5);
    EXPECT_NEAR(answer.y, std::min(f2, 2.0), 1e-5);
    EXPECT_LT(answer.y, 2.0f);
  }
}

TEST(Worley, MapsOfDistances) {
  EXPECT_EQ(law::worleyInverted(0.25f), 0.75f);
  EXPECT_EQ(law::worleyInverted(1.5f), 0.0f);
  EXPECT_EQ(law::billow(0.5f), 0.75f);
  EXPECT_EQ(law::billow(2.0f), 0.0f);
  EXPECT_EQ(law::worleyGap({0.25f, 0.75f}), 0.5f);
}

// Weights: an fBm is the weighted mean of its octaves.
TEST(Fbm, IsTheWeightedMeanOfItsOctaves) {
  for (const Vec4& q : randomPoints(200, 0, 4)) {
    const Vec3 p(q);
    const float perlin =
        (law::perlin3(p, 4, 9u) + 0.4f * law::perlin3(p * 3.0f, 12, 10u) + 0.16f * law::perlin3(p * 9.0f, 36, 11u)) /
        1.56f;
    EXPECT_NEAR(law::perlinFbm3(p, 4, 3, 3, 0.4f, 9u), perlin, 2e-5f);
    const auto b = [&](float scale, int period, law::uint seed) {
      return law::billow(law::worley3(p * scale, period, law::kWorleyEuclidean, seed).x);
    };
    const float billows = (8 * b(1, 4, 9u) + 4 * b(2, 8, 10u) + 2 * b(4, 16, 11u) + b(8, 32, 12u)) / 15.0f;
    EXPECT_NEAR(law::billowFbm3(p, 4, 4, 2, 0.5f, 9u), billows, 1e-6f);
  }
}

// All six combinations against remap as the thesis writes it (eq. 2.27).
TEST(PerlinWorley, CombinationsAreRemaps) {
  const auto remap = [](float v, float a, float b, float c, float d) { return c + (v - a) / (b - a) * (d - c); };
  for (const Vec4& q : randomPoints(1000, 0.01f, 0.98f)) {
    const float p = q.x, w = q.y, lifted = remap(p, 0, 1, w, 1);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleySquare), lifted * lifted, 1e-5f);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleyLift), lifted, 1e-5f);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleyCarve), std::max(0.0f, remap(p, w, 1, 0, 1)), 1e-5f);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleyDilate), remap(p, w - 1, 1, 0, 1), 1e-5f);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleyErode), std::max(0.0f, remap(p, 1 - w, 1, 0, 1)), 1e-4f);
    EXPECT_NEAR(law::perlinWorley(p, w, law::kPerlinWorleyProduct), remap(w, 0, 1, 0, p), 1e-5f);
  }
}

// The analytic derivatives against central differences in double steps.
TEST(Perlin, DerivativesAreThoseOfTheNoise) {
  const float h = 1.0f / 256.0f;
  for (const Vec4& q : randomPoints(2000, 0.05f, 0.95f)) {
    const Vec3 f(q);
    const Vec4 s = law::perlin3SlopeAt({3, -2, 9}, f, 0, 4u);
    EXPECT_NEAR(s.w, law::perlin3At({3, -2, 9}, f, 0, 4u), 1e-6f);
    const Vec3 s2 = law::perlin2SlopeAt({3, -2}, Vec2(f), 5, 4u);
    EXPECT_NEAR(s2.z, law::perlin2At({3, -2}, Vec2(f), 5, 4u), 1e-6f);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 d(0);
      d[axis] = h;
      const float difference = law::perlin3At({3, -2, 9}, f + d, 0, 4u) - law::perlin3At({3, -2, 9}, f - d, 0, 4u);
      EXPECT_NEAR(s[axis], difference / (2 * h), 1e-3f);
      if (axis == 2) continue;
      const Vec2 e(d);
      EXPECT_NEAR(s2[axis],
                  (law::perlin2At({3, -2}, Vec2(f) + e, 5, 4u) - law::perlin2At({3, -2}, Vec2(f) - e, 5, 4u)) / (2 * h),
                  1e-3f);
    }
  }
}

// Divergence by central differences, as a share of the sum of its terms' sizes.
template <class Flow>
double divergenceShare(int axes, const Flow& flow) {
  const float h = 1.0f / 128.0f;
  double divergence = 0, size = 0;
  for (const Vec4& p : randomPoints(4000, 0, 8)) {
    double sum = 0;
    for (int axis = 0; axis < axes; ++axis) {
      Vec4 d(0);
      d[axis] = h;
      const double term = (static_cast<double>(flow(p + d)[axis]) - flow(p - d)[axis]) / (2.0 * h);
      sum += term;
      size += std::abs(term);
    }
    divergence += std::abs(sum);
  }
  return divergence / size;
}

TEST(Curl, HasNoDivergence) {
  const auto plane = [](const Vec4& p) { return Vec4(law::curlFbm2(Vec2(p), 8, 1, 2, 0.5f, 1u), 0, 0); };
  const auto space = [](const Vec4& p) { return Vec4(law::curlFbm3(Vec3(p), 8, 1, 2, 0.5f, 1u), 0); };
  EXPECT_LT(divergenceShare(2, plane), 2e-3);  // what the differences themselves miss
  EXPECT_LT(divergenceShare(3, space), 2e-3);
  // Negative control: a plain vector of noises does have one.
  const auto vector = [](const Vec4& p) {
    return Vec4(law::perlin2(Vec2(p), 8, 1u), law::perlin2(Vec2(p), 8, 2u), 0, 0);
  };
  EXPECT_GT(divergenceShare(2, vector), 0.3);
}

}  // namespace
}  // namespace welkin
