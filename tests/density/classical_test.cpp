// The classical models, and their voxels in the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "welkin/density/classical/balls.hpp"
#include "welkin/density/classical/clouds.hpp"
#include "welkin/density/classical/ellipsoids.hpp"
#include "welkin/density/classical/perlin_array.hpp"
#include "welkin/density/cloud_cache.hpp"
#include "welkin/density/field.hpp"

namespace welkin {
namespace {

constexpr auto kKinds = {ClassicalKind::height_map, ClassicalKind::perlin,    ClassicalKind::metaballs,
                         ClassicalKind::ellipsoids, ClassicalKind::particles, ClassicalKind::automaton};

Classical smallCloud(ClassicalKind kind) {
  Classical c;
  c.cloud.kind = kind;
  c.cloud.voxels = 60000;
  c.heightMap.elements = 256;
  c.heightMap.squares = 40;
  c.automaton.width = 64;
  c.automaton.breadth = 48;
  c.automaton.height = 16;
  c.automaton.start = 30;
  if (kind == ClassicalKind::automaton) c.cloud.edge = 0.3f;  // the mean over cells seldom nears 1
  return c;
}

// In the cloud's box and a little round it.
std::vector<glm::dvec3> pointsRound(const Classical& cloud, const Drift& drift, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-0.05, 1.05);
  const WorldBox box = boxOf(cloud, drift);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(box.low + (box.high - box.low) * glm::dvec3(unit(random), unit(random), unit(random)));
  return points;
}

TEST(PerlinArray, InterpolationsMeetTheirValues) {
  const float v[4] = {0.2f, 0.9f, 0.4f, 0.7f};
  for (const auto how : {ArrayInterpolation::linear, ArrayInterpolation::cosine, ArrayInterpolation::cubic}) {
    EXPECT_NEAR(interpolated(how, v[0], v[1], v[2], v[3], 0.0f), v[1], 1e-6f);
    EXPECT_NEAR(interpolated(how, v[0], v[1], v[2], v[3], 1.0f), v[2], 1e-6f);
    for (const float x : {0.2f, 0.7f}) EXPECT_NEAR(interpolated(how, 0.5f, 0.5f, 0.5f, 0.5f, x), 0.5f, 1e-6f);
  }
  EXPECT_NEAR(interpolated(ArrayInterpolation::linear, 0, 1, 3, 0, 0.25f), 1.5f, 1e-6f);
  EXPECT_NEAR(interpolated(ArrayInterpolation::cosine, 0, 1, 3, 0, 0.25f), 1.0f + 2.0f * 0.1464466f, 1e-6f);
  // P x^3 + Q x^2 + R x + S with P = v3 - v2 - v0 + v1, Q = v0 - v1 - P, R = v2 - v0, S = v1.
  EXPECT_NEAR(interpolated(ArrayInterpolation::cubic, 2, 1, 3, 7, 0.5f), 0.375f + -0.5f + 0.5f + 1.0f, 1e-6f);
}

TEST(PerlinArray, FilterCutsByCoverAndHardensBySharpness) {
  EXPECT_EQ(filteredNoise(0.4f, 0.4f, 0.9f), 0.0f);
  EXPECT_EQ(filteredNoise(0.1f, 0.4f, 0.9f), 0.0f);
  EXPECT_NEAR(filteredNoise(0.4f + 10.0f / 255.0f, 0.4f, 0.9f), 1.0f - std::pow(0.9f, 10.0f), 1e-4f);
  EXPECT_GT(filteredNoise(0.45f, 0.4f, 0.9f), filteredNoise(0.45f, 0.4f, 0.99f));
  EXPECT_EQ(filteredNoise(0.45f, 0.4f, 0.0f), 1.0f);
  EXPECT_EQ(filteredNoise(0.45f, 0.4f, 1.0f), 0.0f);
}

TEST(PerlinArray, IsZeroOnItsSidesAndSoAtRest) {
  for (const auto how : {ArrayInterpolation::linear, ArrayInterpolation::cosine, ArrayInterpolation::cubic}) {
    const PerlinArray array({.interpolation = how, .smoothing = 1}, 4);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit;
    float most = 0.0f;
    for (int i = 0; i < 300; ++i) {
      glm::vec3 p(unit(random), unit(random), unit(random));
      most = std::max(most, array.noise(p));
      p[i % 3] = i % 2 ? 0.0f : 1.0f;
      ASSERT_NEAR(array.noise(p), 0.0f, 1e-6f);
    }
    EXPECT_GT(most, 0.3f);
    EXPECT_LT(most, 1.1f);
  }
}

TEST(PerlinArray, PersistenceWeighsTheFinerArrays) {
  // Without it only the first array counts, and that is linear between its values.
  const PerlinArray coarse({.cells = 4, .persistence = 0.0f, .interpolation = ArrayInterpolation::linear}, 4);
  const auto bend = [](const PerlinArray& a) {
    const float step = 1.0f / 16.0f;  // a quarter of a cell
    return std::abs(a.noise({0.25f + step, 0.5f, 0.5f}) - 2.0f * a.noise({0.25f + 2.0f * step, 0.5f, 0.5f}) +
                    a.noise({0.25f + 3.0f * step, 0.5f, 0.5f}));
  };
  EXPECT_NEAR(bend(coarse), 0.0f, 1e-6f);
  EXPECT_GT(bend(PerlinArray({.cells = 4, .persistence = 0.7f, .interpolation = ArrayInterpolation::linear}, 4)),
            1e-3f);
}

TEST(Balls, AreFoundWhereverTheyAre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit;
  std::vector<glm::vec4> some;
  for (int i = 0; i < 60; ++i)
    some.emplace_back(100.0f * unit(random), 60.0f * unit(random), 30.0f * unit(random), 2.0f + 10.0f * unit(random));
  const Balls balls(some);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 p(140.0f * unit(random) - 20.0f, 100.0f * unit(random) - 20.0f, 70.0f * unit(random) - 20.0f);
    double expected = 0.0, found = 0.0;
    for (const glm::vec4& b : some) {
      const glm::vec3 d = (p - glm::vec3(b)) / b.w;
      const float square = d.x * d.x + d.y * d.y + d.z * d.z;
      if (square < 0.999999f) expected += metaballField(square);
    }
    balls.near(p, [&](float d) { found += metaballField(d); });
    ASSERT_NEAR(found, expected, 1e-4);
  }
  EXPECT_EQ(metaballField(0.0f), 1.0f);
  EXPECT_NEAR(metaballField(1.0f), 0.0f, 1e-6f);
  EXPECT_NEAR(metaballField(0.25f), 0.5f, 1e-6f);  // half at half the radius
}

TEST(Balls, ParticlesCoverOneAnother) {
  const Balls two({{0.0f, 0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, 0.0f, 2.0f}});
  EXPECT_NEAR(particleDensity(two, {.opacity = 0.5f}, {0.0f, 0.0f, 0.0f}), 0.75f, 1e-6f);
  EXPECT_EQ(particleDensity(two, {.opacity = 0.5f}, {0.0f, 2.1f, 0.0f}), 0.0f);
  const MetaballSettings s{.strength = 0.5f, .threshold = 0.2f};
  EXPECT_NEAR(metaballDensity(two, s, {0.0f, 0.0f, 0.0f}), 1.0f, 1e-6f);
  EXPECT_NEAR(metaballDensity(two, s, {1.0f, 0.0f, 0.0f}), (0.5f - 0.2f) / 0.8f, 1e-5f);
}

TEST(Ellipsoids, TexturesStayInRangeAndEatTheRim) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit;
  double mean = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const float t = spectralTexture(50.0f * glm::vec3(unit(random), unit(random), unit(random)), 6, 0.7f, 1.0f);
    ASSERT_GE(t, -1e-5f);
    ASSERT_LE(t, 1.0f + 1e-5f);
    mean += t / 2000.0;
  }
  EXPECT_NEAR(mean, 0.25, 0.05);  // of two independent factors of mean 1/2
  for (const auto texture : {EllipsoidTexture::spectral, EllipsoidTexture::perlin}) {
    const glm::vec3 size(1000.0f, 1000.0f, 1000.0f);
    const TexturedEllipsoids one({.count = 1, .texture = texture, .middle = 0.2f, .rim = 0.9f}, size, 3);
    double inner = 0.0, outer = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const glm::vec3 way(unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f);
      const auto at = [&](float share) {
        return one.density(glm::vec3(0.0f, 0.0f, 100.0f) +
                           way / std::sqrt(way.x * way.x / 9e4f + way.y * way.y / 9e4f + way.z * way.z / 722500.0f) *
                               share);
      };
      inner += at(0.4f);
      outer += at(0.9f);
      ASSERT_EQ(at(1.01f), 0.0f);
    }
    EXPECT_GT(inner, 2.0 * outer);
    EXPECT_GT(outer, 0.0);
  }
}

TEST(Classical, EveryKindIsACloudInItsBoxThatItsSeedDecides) {
  for (const ClassicalKind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    const Classical cloud = smallCloud(kind);
    const auto field = [&](const Classical& c, int seed) {
      return DensityField({.seed = seed, .classical = std::span(&c, 1)});
    };
    const std::vector<glm::dvec3> points = pointsRound(cloud, {}, 20000, 1);
    const std::vector<float> found = field(cloud, 1).extinction(points);
    double sum = 0.0, most = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_GE(found[i], 0.0f);
      ASSERT_LE(found[i], cloud.cloud.extinction * 1.0001f);
      sum += found[i];
      most = std::max<double>(most, found[i]);
    }
    EXPECT_GT(sum / 20000.0, 0.01 * cloud.cloud.extinction);
    EXPECT_GT(most, 0.5 * cloud.cloud.extinction);
    EXPECT_EQ(found, field(cloud, 1).extinction(points));
    EXPECT_NE(found, field(cloud, 2).extinction(points));
    Classical other = cloud;
    other.cloud.seed = 1;
    EXPECT_NE(found, field(other, 1).extinction(points));
    other = cloud;
    other.cloud.detail = 0.7f;
    const DensityField carved = field(other, 1);
    double left = 0.0;
    for (const float sigma : carved.extinction(points)) left += sigma;
    EXPECT_LT(left, 0.97 * sum);
    EXPECT_GT(left, 0.0);
  }
}

TEST(Classical, StandsOnItsHeadingAndGoesWithTheWind) {
  for (const ClassicalKind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    Classical cloud = smallCloud(kind);
    cloud.cloud.position = {500.0, -700.0, 900.0};
    cloud.cloud.size = {2000.0f, 800.0f, 600.0f};
    cloud.cloud.heading = 0.0f;  // north: its length is the world's y
    cloud.automaton.step = 10000.0f;
    const WorldBox box = boxOf(cloud, {});
    EXPECT_NEAR(box.high.y - box.low.y, 2000.0, 1e-3);
    EXPECT_NEAR(box.high.x - box.low.x, 800.0, 1e-3);
    ClassicalClouds clouds;
    EXPECT_TRUE(clouds.update(std::span(&cloud, 1), {}, 1));
    const PlacedGrid still = clouds.placed().front();
    // A wind from the west for so short that the window of a height map does not step.
    const Drift drift{10.0f, 4.71238898f, 2.0};
    EXPECT_FALSE(clouds.update(std::span(&cloud, 1), drift, 1));
    const PlacedGrid moved = clouds.placed().front();
    EXPECT_EQ(moved.voxels, still.voxels);
    double seen = 0.0;
    for (const glm::dvec3& p : pointsRound(cloud, {}, 2000, 1)) {
      ASSERT_NEAR(moved.at(p + glm::dvec3(20.0, 0.0, 0.0)), still.at(p), 1e-6f);
      seen += still.at(p);
    }
    EXPECT_GT(seen, 0.0);
  }
}

// The window is elsewhere on the map, and what lies far from its sides has gone with the wind all the same.
TEST(Classical, AHeightMapMovesThroughItsWindow) {
  Classical cloud = smallCloud(ClassicalKind::height_map);
  cloud.cloud.size = {1600.0f, 1600.0f, 400.0f};
  cloud.cloud.voxels = 400000;
  const Drift drift{10.0f, 4.71238898f, 40.0};  // 400 m, which are four steps
  const DensityField before({.classical = std::span(&cloud, 1)});
  const DensityField after({.drift = drift, .classical = std::span(&cloud, 1)});
  EXPECT_NEAR(momentOf(cloud, drift).carried.x, 0.0, 1e-3);
  double difference = 0.0, sum = 0.0;
  for (glm::dvec3 p : pointsRound(cloud, {}, 20000, 1)) {
    if (std::abs(p.x + 200.0) > 350.0 || std::abs(p.y) > 600.0) continue;
    difference += std::abs(before.extinction(p) - after.extinction(p + glm::dvec3(400.0, 0.0, 0.0)));
    sum += before.extinction(p);
  }
  ASSERT_GT(sum, 0.0);
  EXPECT_LT(difference / sum, 0.02);  // voxels lie elsewhere on the map
}

TEST(Classical, AnAutomatonIsTheSameWhicheverWayItCameThere) {
  const Classical cloud = smallCloud(ClassicalKind::automaton);
  const auto valuesOf = [](const ClassicalClouds& c) {
    const auto v = c.still(0).voxels->values();
    return std::vector<float>(v.begin(), v.end());
  };
  const auto at = [&](ClassicalClouds& c, double time) {
    c.update(std::span(&cloud, 1), {.time = time}, 1);
    return valuesOf(c);
  };
  ClassicalClouds walked, jumped;
  std::vector<float> last;
  for (double t = 0.0; t <= 45.0; t += 5.0) {
    const std::vector<float> now = at(walked, t);
    EXPECT_NE(now, last);
    last = now;
  }
  EXPECT_EQ(at(jumped, 47.0), last);
  const std::vector<float> early = at(jumped, 10.0);
  ClassicalClouds fresh;
  EXPECT_EQ(at(fresh, 10.0), early);
}

TEST(Classical, BoundsHoldEverySample) {
  std::vector<Classical> clouds;
  for (const ClassicalKind kind : kKinds) {
    clouds.push_back(smallCloud(kind));
    clouds.back().cloud.position.x = 2500.0 * static_cast<double>(clouds.size());
    clouds.back().cloud.heading = 0.3f * static_cast<float>(clouds.size());
  }
  const DensityParts parts{.drift = {8.0f, 1.0f, 30.0}, .classical = clouds};
  const CloudCache cache =
      bakeCloudCache(parts, {}, {4000.0, 100.0, 150.0}, {.weather = {.texels = 64}, .cells = 48, .cellLayers = 24});
  const DensityField field(parts);
  std::size_t inCloud = 0, empty = 0;
  for (const Classical& cloud : clouds)
    for (const glm::dvec3& p : pointsRound(cloud, parts.drift, 20000, 3)) {
      const glm::vec3 q(p - glm::dvec3(4000.0, 100.0, 0.0));
      const float sigma = extinctionIn(cache, q);
      ASSERT_LE(sigma, majorantAt(cache.majorants, q));
      inCloud += sigma > 0.0f;
      empty += majorantAt(cache.majorants, q) == 0.0f;
      if (inCloud % 64 == 0) {
        ASSERT_NEAR(field.extinction(p), sigma, 1e-3f * cloud.cloud.extinction);
      }
    }
  EXPECT_GT(inCloud, 10000u);
  EXPECT_GT(empty, 5000u);
}

TEST(Classical, WorstValuesBakeToo) {
  for (const ClassicalKind kind : kKinds) {
    Classical cloud = smallCloud(kind);
    cloud.cloud.size = {100000.0f, 20.0f, 20.0f};
    cloud.cloud.voxels = 1000;
    cloud.cloud.edge = 0.01f;
    cloud.cloud.detail = 1.0f;
    cloud.heightMap.cover = 0.0f;
    cloud.perlin.cover = 0.0f;
    cloud.perlin.sharpness = 0.0f;
    cloud.metaballs = {.count = 1, .radius = 0.5f, .variation = 1.0f, .strength = 10.0f, .threshold = 0.99f};
    cloud.ellipsoids = {.count = 1, .contrast = 0.0f, .middle = 1.0f, .rim = 0.0f};
    cloud.particles = {.count = 1, .radius = 0.002f, .opacity = 1.0f, .puffs = 1};
    cloud.automaton.humidity = cloud.automaton.rehumidification = cloud.automaton.activation = 1.0f;
    const DensityField field({.classical = std::span(&cloud, 1)});
    for (const float sigma : field.extinction(pointsRound(cloud, {}, 1000, 1))) {
      ASSERT_GE(sigma, 0.0f);
      ASSERT_LE(sigma, cloud.cloud.extinction * 1.0001f);
    }
  }
}

}  // namespace
}  // namespace welkin
