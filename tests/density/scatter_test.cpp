// Copies of a hero cloud over the land.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/density/cloud_cache.hpp"
#include "welkin/density/field.hpp"

namespace welkin {
namespace {

constexpr glm::dvec3 kPlace(300.0, -200.0, 800.0);

Hero scattered(float spacing, float radius = 30000.0f) {
  Hero hero = heroPreset(HeroSpecies::mediocris);
  hero.cloud.position = kPlace;
  hero.cloud.heading = 0.7f;
  hero.scatter = {.radius = radius, .spacing = spacing, .share = 0.7f, .variation = 0.4f, .turn = 0.5f};
  return hero;
}

DensityField fieldOf(const Hero& hero) { return DensityField({.seed = 3, .heroes = std::span(&hero, 1)}); }

std::vector<glm::dvec3> pointsIn(const glm::dvec3& low, const glm::dvec3& high, int count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(low + glm::dvec3(unit(random), unit(random), unit(random)) * (high - low));
  return points;
}

TEST(Scatter, LeavesTheCloudInTheMiddleAsItIs) {
  const Hero hero = scattered(9000.0f);
  const DensityField all = fieldOf(hero), one = fieldOf(alone(hero));
  std::mt19937 random(1);
  const HeroBody& body = one.heroes().front();
  const std::vector<glm::dvec3> points = pointsIn(body.lowest(), body.highest(), 4000, random);
  const std::vector<float> with = all.extinction(points), without = one.extinction(points);
  double difference = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    difference += std::abs(with[i] - without[i]);
    sum += without[i];
  }
  ASSERT_GT(sum, 0.0);
  EXPECT_LT(difference, 1e-4 * sum);  // rounding of positions: .1 mm of an edge of 10 m
}

// The lanes' answer is the cloud's own at the point that scatter.hpp names.
TEST(Scatter, CopiesAreTheCloud) {
  const Hero hero = scattered(0.0f, 12000.0f);
  const DensityField all = fieldOf(hero), one = fieldOf(alone(hero));
  const HeroBody& body = all.heroes().front();
  std::mt19937 random(2);
  const std::vector<glm::dvec3> points = pointsIn(body.lowest(), body.highest(), 80000, random);
  std::vector<glm::dvec3> own;
  for (const glm::dvec3& p : points) own.push_back(body.scatter.toCloud(p));
  const std::vector<float> found = all.extinction(points), wanted = one.extinction(own);
  double difference = 0.0, sum = 0.0;
  std::size_t outside = 0, inCloud = 0;  // of the middle square
  for (std::size_t i = 0; i < points.size(); ++i) {
    difference += std::abs(found[i] - wanted[i]);
    sum += wanted[i];
    inCloud += wanted[i] > 0.0f;
    outside += wanted[i] > 0.0f && glm::length(glm::dvec2(points[i] - kPlace)) > body.scatter.params.place.w;
  }
  ASSERT_GT(inCloud, 500u);
  EXPECT_GT(outside, 400u);
  EXPECT_LT(difference, 1e-3 * sum);  // 12 km away a float's step is 1 mm of an edge of 10 m
}

TEST(Scatter, CopiesStayInTheirSquaresAndOnTheLand) {
  for (const float spacing : {0.0f, 6000.0f}) {
    const DensityField field = fieldOf(scattered(spacing, 90000.0f));
    const law::ScatterParams& s = field.heroes().front().scatter.params;
    const float half = 0.5f * s.place.w;
    EXPECT_GE(s.place.w, spacing);
    double squares = 0.0, copies = 0.0, mirrored = 0.0, sizes = 0.0;
    for (float j = -60.0f; j <= 60.0f; ++j)
      for (float i = -60.0f; i <= 60.0f; ++i) {
        const glm::vec4 copy = law::scatterCopy(i, j, s);
        const bool onLand = std::hypot(i, j) * s.place.w <= s.chance.x;
        squares += onLand;
        if (copy.w == 0.0f) continue;
        EXPECT_TRUE(onLand);
        ++copies;
        mirrored += copy.w < 0.0f;
        sizes += std::abs(copy.w);
        EXPECT_LE(std::max(std::abs(copy.x), std::abs(copy.y)) + s.chance.w * std::abs(copy.w), half * 1.0001f);
        EXPECT_LE(std::abs(std::abs(copy.w) - 1.0f), s.chance.z);
        EXPECT_LE(std::abs(copy.z), s.axis.z);
      }
    ASSERT_GT(squares, 600.0);
    const double deviation = 4.0 / std::sqrt(squares);  // four standard deviations of shares at most
    EXPECT_NEAR(copies / squares, 0.7, 0.5 * deviation);
    EXPECT_NEAR(mirrored / copies, 0.5, 0.6 * deviation);
    EXPECT_NEAR(sizes / copies, 1.0, 0.4 * deviation);
  }
}

// Nearby square by square, far away for all at once. The formula of shape "classic" answers more than its extinction.
class Scattered : public testing::TestWithParam<HeroShape> {};

TEST_P(Scattered, BoundsHoldEverySample) {
  Hero hero = scattered(2500.0f, 40000.0f);
  hero.form.shape = GetParam();
  hero.classic.distortion = 1.0f;
  const glm::dvec3 anchor(1234.0, -777.0, 150.0), ground(1234.0, -777.0, 0.0), near(3000.0, 3000.0, 0.0);
  for (const int cells : {64, 4}) {
    const CloudCache cache =
        bakeCloudCache({.seed = 5, .heroes = std::span(&hero, 1)}, {}, anchor, {.cells = cells, .cellLayers = 24});
    const HeroBody& body = cache.heroes.front().body;
    std::mt19937 random(4);
    const glm::dvec3 low = body.lowest(), high = body.highest();
    std::vector<glm::dvec3> points = pointsIn(low, high, 100000, random);
    const std::vector<glm::dvec3> nearby = pointsIn(ground - near + glm::dvec3(0.0, 0.0, low.z),
                                                    ground + near + glm::dvec3(0.0, 0.0, high.z), 100000, random);
    points.insert(points.end(), nearby.begin(), nearby.end());
    std::size_t inCloud = 0, empty = 0;
    float densest = 0.0f;
    for (const glm::dvec3& point : points) {
      const glm::vec3 p(point - ground);
      const float sigma = extinctionIn(cache, p), most = majorantAt(cache.majorants, p);
      ASSERT_LE(sigma, most) << p.x << " " << p.y << " " << p.z;
      inCloud += sigma > 0.0f;
      empty += most == 0.0f;
      densest = std::max(densest, sigma / body.params.high.w);
    }
    EXPECT_GT(inCloud, 2000u);
    if (cells == 64) {
      EXPECT_GT(empty, 20000u);
    }
    if (GetParam() == HeroShape::classic) {
      EXPECT_GT(densest, 1.2f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Scattered, testing::Values(HeroShape::towers, HeroShape::classic));

}  // namespace
}  // namespace welkin
