// What a layer's parameters and its weather promise, in closed form or by counting.
#include "welkin/density/params.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

constexpr Population kPopulations[] = {Population::domes, Population::clusters, Population::streets,
                                       Population::cells, Population::front,    Population::uniform};
constexpr float kCloud = 20.0f;  // m, the thinnest column that shape "profile" draws

glm::vec4 weatherAt(const Layer& layer, const law::WeatherParams& w, const glm::dvec2& p) {
  return layer.cloud.shape == LayerShape::nubis ? law::nubisWeather(glm::vec2(p), w, {})
                                                : law::profileWeather(glm::vec2(p), w, {});
}

std::vector<glm::dvec2> scattered(double edge, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  std::vector<glm::dvec2> points(count);
  for (glm::dvec2& p : points) p.x = edge * unit(), p.y = edge * unit();
  return points;
}

double meanOf(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double ma = meanOf(a), mb = meanOf(b);
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}
double deviation(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += (x - meanOf(v)) * (x - meanOf(v));
  return std::sqrt(sum / static_cast<double>(v.size()));
}

TEST(Planet, AltitudeIsExactAtEveryDistance) {
  const auto altitude = [](const glm::dvec3& at) {
    return glm::length(at + glm::dvec3(0.0, 0.0, kPlanetRadius)) - kPlanetRadius;
  };
  for (const double east : {0.0, 1e5, 1e6}) {
    const glm::dvec3 anchor(east, 0.3 * east, -0.05 * east + 200.0);
    const law::PlanetParams p = planetParams(anchor);
    EXPECT_NEAR(p.altitude, altitude(anchor), 1e-6 * std::abs(altitude(anchor)) + 1e-3);
    // 1e-6 of the way: the last digits of floats of that size.
    for (const glm::dvec3 d : {glm::dvec3(10, 20, 30), glm::dvec3(-5000, 3000, 1000), glm::dvec3(60000, -40000, 2000)})
      EXPECT_NEAR(law::altitudeAt(glm::vec3(d), p), altitude(anchor + d),
                  1e-6 * (glm::length(d) + std::abs(p.altitude)) + 1e-2);
  }
  EXPECT_THROW(planetParams({0.0, 0.0, -kPlanetRadius}), Error);
}

// One point of the world has one weather, whether it is seen from near or far. Floats of 20 km resolve 2 mm, which
// changes heights by less than 0.3 % but at the rims of domes, where single points may jump.
TEST(Weather, IsTheSameFromEveryAnchor) {
  for (const glm::dvec2 far : {glm::dvec2(0, 0), glm::dvec2(1e5, -7e4), glm::dvec2(-1e6, 8e5)})
    for (const Population population : kPopulations)
      for (const LayerShape shape : {LayerShape::profile, LayerShape::nubis}) {
        Layer layer;
        layer.cloud.shape = shape;
        layer.weather.population = population;
        layer.weather.orientation = 0.9f;
        layer.weather.precipitation = 0.5f;
        const glm::dvec2 shift(7312.7, -9120.4);
        const law::WeatherParams a = weatherParams(layer, far, {}, 3), b = weatherParams(layer, far + shift, {}, 3);
        const glm::vec4 scale = shape == LayerShape::profile ? glm::vec4(1400, 40, 1, 1) : glm::vec4(1);
        int odd = 0;
        for (const glm::dvec2& p : scattered(20000.0, 1000, 1)) {
          const glm::vec4 difference = glm::abs(weatherAt(layer, a, p) - weatherAt(layer, b, p - shift)) / scale;
          odd += std::max({difference.x, difference.y, difference.z, difference.w}) > 0.003f ? 1 : 0;
        }
        EXPECT_LE(odd, 5) << static_cast<int>(population) << " " << static_cast<int>(shape) << " at " << far.x;
      }
}

// The largest seeds that a file may hold neither overflow nor repeat the smallest.
TEST(Weather, TakesEverySeed) {
  Layer layer;
  const auto seedOf = [&](int scene, int part) {
    layer.cloud.seed = part;
    return weatherParams(layer, {}, {}, scene).seed;
  };
  for (const int scene : {0, 1, 2147483647})
    for (const int part : {0, 1, 2147483647}) {
      EXPECT_GE(seedOf(scene, part), 0);
      EXPECT_LT(seedOf(scene, part), 1 << 24);
    }
  EXPECT_NE(seedOf(0, 0), seedOf(1, 0));
  EXPECT_NE(seedOf(2147483647, 0), seedOf(0, 0));
}

TEST(Weather, DriftsWithTheWindAsAWhole) {
  const Layer layer;
  const Drift still{17.0f, 0.6f, 0.0}, later{17.0f, 0.6f, 40000.0};
  const glm::dvec2 way = driftOffset(later);
  EXPECT_NEAR(glm::length(way), 680000.0, 1.0);
  EXPECT_LT(way.y, 0.0) << "a wind from the north-north-east blows southward";
  const law::WeatherParams before = weatherParams(layer, {100.0, 200.0}, still, 1);
  const law::WeatherParams after = weatherParams(layer, glm::dvec2(100.0, 200.0) + way, later, 1);
  EXPECT_EQ(before.cells.cellX, after.cells.cellX);
  EXPECT_NEAR(before.cells.fracX, after.cells.fracX, 1e-6);
  for (const glm::dvec2& p : scattered(20000.0, 500, 2))
    EXPECT_NEAR(weatherAt(layer, before, p).x, weatherAt(layer, after, p).x, 2.0);
}

double coverOf(const Layer& layer, double edge, std::size_t count) {
  const law::WeatherParams w = weatherParams(layer, {}, {}, 2);
  const std::vector<glm::dvec2> points = scattered(edge, count, 5);
  return static_cast<double>(std::count_if(points.begin(), points.end(),
                                           [&](const glm::dvec2& p) { return weatherAt(layer, w, p).x > kCloud; })) /
         static_cast<double>(count);
}

// The formula takes clouds for independent discs; gathering moves some of them from clear places to crowded ones, where
// they overlap. One disc a cell and size class leaves corners: about 0.65 is the most that domes can cover.
TEST(Coverage, IsWhatWasAskedFor) {
  for (const float coverage : {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f}) {
    Layer layer;
    layer.weather.coverage = coverage;
    layer.weather.population = Population::domes;
    const double domes = coverOf(layer, 300000.0, 10000);
    EXPECT_NEAR(domes, coverage, 0.1) << "domes";
    layer.weather.population = Population::clusters;
    const double clusters = coverOf(layer, 300000.0, 10000);
    EXPECT_NEAR(clusters, coverage, 0.12) << "clusters";
    std::printf("coverage %.1f: domes %.3f, clusters %.3f\n", coverage, domes, clusters);
  }
}

TEST(Coverage, GrowsWithItsParameterInEveryPopulation) {
  for (const Population population : kPopulations) {
    Layer layer;
    layer.weather.population = population;
    double last = -1.0;
    for (const float coverage : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      layer.weather.coverage = coverage;
      const double cover = coverOf(layer, 200000.0, 4000);
      EXPECT_GE(cover, last) << static_cast<int>(population) << " " << coverage;
      if (coverage == 0.0f) {
        // The thickest cells stay.
        EXPECT_LT(cover, population == Population::cells ? 0.2 : 0.02) << static_cast<int>(population);
      }
      last = cover;
    }
    const bool closed = population == Population::cells || population == Population::uniform;
    EXPECT_GT(last, closed ? 0.9 : 0.6) << static_cast<int>(population);
  }
}

// A map that repeated would correlate to 1 with itself. 74 km hold some 30 independent clouds, so that chance alone
// gives 0.18 and, of 60 tries, hardly ever 0.6.
TEST(Weather, DoesNotRepeat) {
  const Layer layer;
  const auto line = [&](double east) {
    const law::WeatherParams w = weatherParams(layer, {east, 0.0}, {}, 4);
    std::vector<double> heights(2000);
    for (std::size_t i = 0; i < heights.size(); ++i)
      heights[i] = weatherAt(layer, w, {0.0, 37.0 * static_cast<double>(i)}).x;
    return heights;
  };
  const std::vector<double> here = line(0.0);
  EXPECT_GT(correlation(here, line(30.0)), 0.9) << "control: 30 m aside stand the same clouds";
  for (int step = 1; step <= 60; ++step) EXPECT_LT(correlation(here, line(20000.0 + 2600.0 * step)), 0.6) << step;
}

// Cover of narrow strips along `heading`, side by side.
std::vector<double> strips(const Layer& layer, double heading, int count, double width, double length) {
  const law::WeatherParams w = weatherParams(layer, {}, {}, 6);
  const glm::dvec2 along(std::sin(heading), std::cos(heading)), across(along.y, -along.x);
  std::vector<double> covers;
  for (int i = 0; i < count; ++i) {
    int covered = 0;
    for (int j = 0; j < 300; ++j) {
      const glm::dvec2 p = across * ((i - 0.5 * count) * width) + along * ((j / 300.0 - 0.5) * length);
      covered += weatherAt(layer, w, p).x > kCloud ? 1 : 0;
    }
    covers.push_back(covered / 300.0);
  }
  return covers;
}

TEST(Populations, StreetsRunAlongTheirOrientation) {
  Layer layer;
  layer.weather.population = Population::streets;
  layer.weather.orientation = 0.7f;
  layer.weather.clustering = 1.0f;
  layer.weather.cellSize = 1200.0f;
  layer.weather.clusterSize = 60000.0f;
  const double along = deviation(strips(layer, 0.7, 60, 350.0, 20000.0));
  EXPECT_GT(along, 1.5 * deviation(strips(layer, 0.7 + std::numbers::pi / 2, 60, 350.0, 20000.0)));
  layer.weather.population = Population::domes;
  EXPECT_GT(along, 1.5 * deviation(strips(layer, 0.7, 60, 350.0, 20000.0))) << "control: domes have no direction";
}

TEST(Populations, AFrontPartsTheLand) {
  Layer layer;
  layer.weather.population = Population::front;
  layer.weather.orientation = 0.4f;
  const auto sides = [&] {
    const std::vector<double> cover = strips(layer, 0.4, 80, 1000.0, 60000.0);
    const double left = std::accumulate(cover.begin(), cover.begin() + 20, 0.0);
    const double right = std::accumulate(cover.end() - 20, cover.end(), 0.0);
    return std::max(left, right) / std::min(left, right);
  };
  EXPECT_GT(sides(), 2.0);
  layer.weather.population = Population::domes;
  EXPECT_LT(sides(), 1.5) << "control";
}

// Towers ahead of a front's line stay low, and only what has grown to the tropopause spreads there.
TEST(Populations, AFrontHasAnvilsOnItsLineOnly) {
  Layer layer;
  layer.weather.population = Population::front;
  layer.weather.anvil = 1.0f;
  layer.weather.coverage = 0.7f;
  layer.weather.cellSize = 12000.0f;
  layer.weather.clusterSize = 10000.0f;
  const law::WeatherParams w = weatherParams(layer, {}, {}, 3);
  int far = 0, on = 0;
  for (int i = 0; i < 40000; ++i) {
    const glm::vec2 p(400.0f * static_cast<float>(i % 200 - 100), 400.0f * static_cast<float>(i / 200 - 100));
    if (weatherAt(layer, w, glm::dvec2(p)).z < 0.05f) continue;
    // The growth that this asks for ends .17 from the line; an anvil reaches another 6 km, .3, from its tower, and the
    // warp of outlines moves either by less than a kilometre.
    const float across = std::abs(law::acrossFront(p, w));
    (across > 0.6f ? far : on) += 1;
  }
  EXPECT_EQ(far, 0);
  EXPECT_GT(on, 100);
}

// Each pair differs by a tenth of the mean height or of the number of edges along a line.
TEST(Populations, AreDifferentSkies) {
  std::vector<double> heights, edges;
  for (const Population population : kPopulations) {
    Layer layer;
    layer.weather.population = population;
    layer.weather.coverage = 0.6f;
    const law::WeatherParams w = weatherParams(layer, {}, {}, 8);
    double sum = 0.0, count = 0.0;
    bool last = false;
    for (int i = 0; i < 6000; ++i) {
      const float h = weatherAt(layer, w, {25.0 * (i % 1500), 9000.0 * (i / 1500)}).x;
      sum += h / 6000.0;
      count += (h > kCloud) != last ? 1.0 : 0.0;
      last = h > kCloud;
    }
    heights.push_back(sum);
    edges.push_back(count);
  }
  const auto apart = [](double a, double b) { return std::abs(a - b) > 0.1 * std::max(a, b); };
  for (std::size_t i = 0; i < heights.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(apart(heights[i], heights[j]) || apart(edges[i], edges[j])) << i << " " << j;
}

// A volume of one texel.
struct OneTexel {
  std::vector<float> texels;
  TextureView view() const {
    return {texels.data(), 1, 1, 1, static_cast<int>(texels.size()), Wrap::clamp, Wrap::clamp};
  }
};

glm::vec3 profileAt(const glm::vec3& q, const law::LayerParams& c, const glm::vec4& weather, float noise,
                    float detail) {
  const OneTexel base{{noise, noise}}, fine{{detail, detail}};
  return law::profileExtinctionIn(weather, q, 10.0f, c, base.view(), fine.view());
}

// With the law's own cut at the shell moved away, no weather and no noise makes cloud outside.
TEST(Shell, HoldsAllCloud) {
  for (const Population population : kPopulations)
    for (const bool extreme : {false, true}) {
      Layer layer;
      layer.weather.population = population;
      if (extreme) {
        layer.weather.type = layer.weather.coverage = layer.weather.anvil = 1.0f;
        layer.weather.clustering = 1.5f;
        layer.profile.erosion = 0.0f;
        layer.profile.baseVariation = 200.0f;
        layer.profile.baseRagged = 100.0f;
        layer.cloud.thickness = 6000.0f;
      }
      const law::WeatherParams w = weatherParams(layer, {}, {}, 9);
      law::LayerParams c = layerParams(layer, {}, {});
      const Shell shell = shellOf(layer);
      c.bottom = -1e9f;
      c.top = 1e9f;
      float lowest = 1e9f, highest = -1e9f;
      for (const glm::dvec2& p : scattered(100000.0, 600, 10)) {
        const glm::vec4 weather = weatherAt(layer, w, p);
        for (const float noise : {0.5f, 1.0f})
          for (float z = shell.bottom - 300.0f; z < shell.top + 2000.0f; z += 20.0f)
            if (profileAt({p.x, p.y, z}, c, weather, noise, 1.0f).x > 0.0f) {
              lowest = std::min(lowest, z);
              highest = std::max(highest, z);
            }
      }
      EXPECT_LT(lowest, highest) << "there is cloud";
      EXPECT_GE(lowest, shell.bottom) << static_cast<int>(population) << extreme;
      EXPECT_LE(highest, shell.top) << static_cast<int>(population) << extreme;
    }
}

TEST(Extinction, NeverExceedsTheLayers) {
  const Layer layer;
  const law::LayerParams c = layerParams(layer, {}, {});
  std::mt19937 random(3);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  float most = 0.0f;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec4 weather(1500.0f * unit(), 80.0f * unit() - 40.0f, unit(), unit());
    const float sigma = profileAt({0.0f, 0.0f, 1000.0f + 1500.0f * unit()}, c, weather, unit(), unit()).x;
    ASSERT_GE(sigma, 0.0f);
    ASSERT_LE(sigma, layer.cloud.extinction);
    most = std::max(most, sigma);
  }
  EXPECT_GT(most, 0.8f * layer.cloud.extinction);
}

}  // namespace
}  // namespace welkin
