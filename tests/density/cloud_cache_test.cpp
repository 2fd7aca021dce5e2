// The cache of the clouds and its bounds.
#include <gtest/gtest.h>

#include <random>

#include "welkin/density/bounds.hpp"
#include "welkin/density/cloud_cache.hpp"

namespace welkin {
namespace {

const CloudCacheExtent kSmallCache{.weather = {.texels = 256}, .cells = 32, .cellLayers = 24};

TEST(TexelBounds, HoldEveryFilteredLookup) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit;
  for (const int size : {16, 12}) {
    Volume v(size, size, size, 1);
    for (float& x : v.texels) x = unit(random);
    const TexelBounds bounds(v.view(), 0, TexelBounds::Kind::volume);
    float widestGap = 0.0f;
    for (int i = 0; i < 2000; ++i) {
      const float edge = std::exp2(6.0f * unit(random) - 2.0f);
      const glm::vec3 low = glm::vec3(unit(random), unit(random), unit(random)) * 60.0f - 30.0f;
      const Interval range = bounds.between(low, low + edge);
      for (int k = 0; k < 20; ++k) {
        const glm::vec3 p = low + glm::vec3(unit(random), unit(random), unit(random)) * edge;
        const float x = law::sample3(v.view(), p / static_cast<float>(size)).x;
        ASSERT_GE(x, range.low - 1e-5f);
        ASSERT_LE(x, range.high + 1e-5f);
      }
      if (edge < 1.0f) widestGap = std::max(widestGap, range.high - range.low);
    }
    EXPECT_LE(widestGap, 1.0f);
  }
}

class CloudCaches : public testing::TestWithParam<int> {};

std::vector<Layer> layersOf(int kind) {
  Layer layer;
  if (kind == 1) {
    layer.cloud.thickness = 9000.0f;
    layer.weather.anvil = 0.9f;
    layer.cloud.shear = 2000.0f;
  } else if (kind == 2) {
    layer.cloud.shape = LayerShape::nubis;
  } else if (kind == 3) {
    layer.weather.population = Population::cells;
    layer.cloud.thickness = 400.0f;
    layer.weather.coverage = 0.7f;
    Layer high;
    high.cloud.base = 4000.0f;
    return {layer, high};
  }
  return {layer};
}

TEST_P(CloudCaches, BoundsHoldEverySample) {
  const std::vector<Layer> layers = layersOf(GetParam());
  const CloudCache cache = bakeCloudCache({.layers = layers, .drift = {8.0f, 1.0f, 300.0}, .seed = 5}, {},
                                          {1234.0, -777.0, 150.0}, kSmallCache);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit;
  const Majorants& m = cache.majorants;
  std::size_t inCloud = 0, empty = 0;
  double sum = 0.0, bound = 0.0;
  for (int i = 0; i < 400000; ++i) {
    const float reach = 500.0f * std::exp2(7.0f * unit(random));
    const glm::vec3 p((2.0f * unit(random) - 1.0f) * reach, (2.0f * unit(random) - 1.0f) * reach,
                      m.bottom + unit(random) * (m.top - m.bottom));
    const float sigma = extinctionIn(cache, p), most = majorantAt(m, p);
    ASSERT_LE(sigma, most) << p.x << " " << p.y << " " << p.z;
    inCloud += sigma > 0.0f;
    empty += most == 0.0f;
    sum += sigma;
    bound += most;
  }
  EXPECT_GT(inCloud, 1000u);
  // A tenth of the shell, else nothing is skipped; "nubis" has some cloud almost everywhere below its tops.
  EXPECT_GT(empty, GetParam() == 2 ? 12000u : 40000u);
  RecordProperty("tightness", std::to_string(sum / bound));
  std::printf("tightness %.3f empty %.3f in cloud %.4f\n", sum / bound, empty / 4e5, inCloud / 4e5);
}

INSTANTIATE_TEST_SUITE_P(Skies, CloudCaches, testing::Values(0, 1, 2, 3));

// Nearby, the cached weather differs from the function itself only by its filtering.
TEST(CloudCache, IsTheFieldItself) {
  const std::vector<Layer> layers(1);
  const DensityParts parts{.layers = layers, .seed = 5};
  const CloudCache cache = bakeCloudCache(
      parts, {}, {0.0, 0.0, 0.0}, {.weather = {.texels = 1024, .finest = 5000.0}, .cells = 32, .cellLayers = 24});
  const DensityField field(parts);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  double difference = 0.0, sum = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p(4000.0 * unit(random) - 2000.0, 4000.0 * unit(random) - 2000.0, 1150.0 + 1700.0 * unit(random));
    const float exact = field.extinction(p), cached = extinctionIn(cache, glm::vec3(p));
    difference += std::abs(exact - cached);
    sum += exact;
  }
  ASSERT_GT(sum, 0.0);
  EXPECT_LT(difference / sum, 0.02);  // texels of 5 m; the height field has kinks that filtering rounds off
}

}  // namespace
}  // namespace welkin
