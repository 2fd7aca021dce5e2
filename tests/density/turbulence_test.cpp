// Turbulence: where it is, how strong, and that its gusts are a flow.
#include "tests/density/small_noise.hpp"
#include "welkin/density/turbulence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace welkin {
namespace {

Layer cumulusHumilis() {
  Layer layer;
  layer.cloud.thickness = 700.0f;
  return layer;
}
Layer cumulonimbus() {
  Layer layer;
  layer.cloud.base = 1000.0f;
  layer.cloud.thickness = 11000.0f;
  layer.weather.anvil = 1.0f;
  layer.weather.precipitation = 0.7f;
  layer.weather.type = 1.0f;
  layer.weather.cellSize = 42000.0f;
  layer.weather.clusterSize = 90000.0f;
  layer.profile.lengthScale = 4500.0f;
  return layer;
}
DensityField fieldOf(const Layer& layer) {
  return DensityField(
      {.layers = std::span(&layer, 1), .noise = test::smallNoise(), .drift = {8.0f, 1.0f, 0.0}, .seed = 5});
}

std::vector<glm::dvec3> level(double altitude, double edge, int count = 36) {
  std::vector<glm::dvec3> points;
  for (int y = 0; y < count; ++y)
    for (int x = 0; x < count; ++x) points.emplace_back(edge * x / count, edge * y / count, altitude);
  return points;
}
double most(const Turbulence& air, double altitude, double edge) {
  const std::vector<double> found = air.deviations(level(altitude, edge));
  return *std::max_element(found.begin(), found.end());
}

TEST(Turbulence, IsThatOfItsClouds) {
  const DensityField small = fieldOf(cumulusHumilis()), large = fieldOf(cumulonimbus());
  const Turbulence fair(small), storm(large);
  const double humilis = most(fair, 1500.0, 30000.0), tower = most(storm, 7000.0, 120000.0);
  std::printf("cumulus humilis %.2f m/s, cumulonimbus %.2f m/s\n", humilis, tower);
  EXPECT_GT(humilis, 0.9);
  EXPECT_LT(humilis, 2.0);
  EXPECT_GT(tower, 4.0);
  EXPECT_LT(tower, 10.0);
  EXPECT_GT(most(storm, 500.0, 120000.0), 1.3 * most(fair, 500.0, 30000.0)) << "rain drags air down with it";
}

TEST(Turbulence, IsCalmWhereTheAirIsClear) {
  const DensityField empty({});
  EXPECT_EQ(Turbulence(empty).deviation({0.0, 0.0, 1500.0}), 0.0);
  EXPECT_EQ(glm::length(Turbulence(empty).gust({0.0, 0.0, 1500.0}, 7.0)), 0.0);
  const DensityField field = fieldOf(cumulusHumilis());
  const Turbulence air(field);
  EXPECT_EQ(most(air, 4000.0, 30000.0), 0.0) << "above the clouds";
  const std::vector<double> between = air.deviations(level(1500.0, 30000.0));
  EXPECT_GT(std::count(between.begin(), between.end(), 0.0), 300) << "between them";
}

// Lenschow, Wyngaard and Pennell: at .3 of the layer's depth, sqrt(1.8 .3^(2/3) .76^2) = .683 w*.
TEST(Turbulence, ThermalsRiseUnderCumulusByDayOnly) {
  const DensityField field = fieldOf(cumulusHumilis());
  const double scale = std::cbrt(9.81 / 290.0 * 0.1 * 1200.0);
  EXPECT_NEAR(most(Turbulence(field), 360.0, 30000.0), 0.683 * scale, 0.1);
  EXPECT_EQ(most(Turbulence(field, {.heatFlux = 0.0f}), 360.0, 30000.0), 0.0);
}

TEST(Turbulence, GustsAreTheSameForTheSameSeed) {
  const DensityField field = fieldOf(cumulusHumilis());
  const glm::dvec3 p(3000.0, -2000.0, 700.0);
  const glm::dvec3 first = Turbulence(field).gust(p, 12.0);
  EXPECT_GT(glm::length(first), 0.0);
  EXPECT_EQ(first, Turbulence(field).gust(p, 12.0));
  EXPECT_NE(first, Turbulence(field, {.seed = 2}).gust(p, 12.0));
}

TEST(Turbulence, ThePatternHasUnitVarianceAndNoDivergence) {
  const DensityField field = fieldOf(cumulusHumilis());
  const Turbulence air(field);
  glm::dvec3 mean(0.0), square(0.0);
  double divergence = 0.0, slope = 0.0;
  constexpr int kPoints = 20000;
  constexpr double kStep = 0.5;  // m
  for (int i = 0; i < kPoints; ++i) {
    const auto unit = [&](double k) { return std::fmod(k * (i + 1), 1.0); };
    const glm::dvec3 p(2e5 * unit(0.6180339887), 2e5 * unit(0.4142135624), 1e4 * unit(0.7320508076));
    const double time = 1000.0 * unit(0.2360679775);
    const glm::dvec3 v = air.gustPattern(p, time);
    mean += v / double(kPoints);
    square += v * v / double(kPoints);
    if (i % 20 != 0) continue;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = kStep;
      const glm::dvec3 d = (air.gustPattern(p + step, time) - air.gustPattern(p - step, time)) / (2.0 * kStep);
      sum += d[axis];
      slope = std::max(slope, std::abs(d[axis]));
    }
    divergence = std::max(divergence, std::abs(sum));
  }
  std::printf("standard deviations %.3f %.3f %.3f, divergence %.5f against slopes of %.4f per s\n", std::sqrt(square.x),
              std::sqrt(square.y), std::sqrt(square.z), divergence, slope);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0.0, 0.05);
    EXPECT_NEAR(std::sqrt(square[axis]), 1.0, 0.05);
  }
  EXPECT_LT(divergence, 0.01 * slope);
}

// A walk of 1 m and 10 ms a step meets no jump: the steepest gusts are bounded by the smallest eddies.
TEST(Turbulence, IsContinuousInSpaceAndTime) {
  const DensityField field = fieldOf(cumulonimbus());
  const Turbulence air(field);
  // Through the strongest place at 5 km.
  const std::vector<glm::dvec3> points = level(5000.0, 120000.0);
  const std::vector<double> found = air.deviations(points);
  const glm::dvec3 middle =
      points[static_cast<std::size_t>(std::max_element(found.begin(), found.end()) - found.begin())];
  double largest = 0.0, strongest = 0.0;
  glm::dvec3 before = air.gust(middle - glm::dvec3(1500.0, 0.0, 0.0), 0.0);
  for (int i = 1; i < 3000; ++i) {
    const glm::dvec3 now = air.gust(middle + glm::dvec3(i - 1500.0, 0.0, 0.0), 0.01 * i);
    largest = std::max(largest, glm::length(now - before));
    strongest = std::max(strongest, glm::length(now));
    before = now;
  }
  std::printf("gusts up to %.1f m/s change by at most %.2f m/s in a metre\n", strongest, largest);
  EXPECT_GT(strongest, 3.0);
  EXPECT_LT(largest, 0.08 * strongest);
}

TEST(Turbulence, IsFiniteAtExtremes) {
  const DensityField field = fieldOf(cumulonimbus());
  const Turbulence air(field);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {0.0, 1e6, -1e9, 1e300, inf, -inf, nan})
    for (const double z : {-1e9, 0.0, 5000.0, 1e300, nan})
      for (const double time : {0.0, -1e5, 1e12, inf, nan}) {
        const glm::dvec3 v = air.gust({x, -x, z}, time);
        EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) << x << " " << z << " " << time;
      }
}

}  // namespace
}  // namespace welkin
