// The weather that the CPU bakes is the scalar law's, moves with the wind and refuses what it cannot use.
#include "welkin/density/weather_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

Layer layerWith(LayerShape shape, Population population) {
  Layer layer;
  layer.cloud.shape = shape;
  layer.weather.population = population;
  layer.weather.precipitation = 0.4f;
  layer.weather.anvil = population == Population::front ? 0.8f : 0.0f;
  return layer;
}

Volume testMap() {
  Volume map(4, 4, 1, 4);
  for (std::size_t i = 0; i < map.texels.size(); ++i) map.texels[i] = static_cast<float>((i * 7) % 11) / 10.0f;
  return map;
}

glm::vec4 lawAt(const Layer& layer, const glm::dvec2& anchor, const glm::vec2& p, const Drift& drift, int seed,
                const Volume* map) {
  const law::WeatherParams params = weatherParams(layer, anchor, drift, seed);
  const TextureView view = authoringMap(layer, map);
  return layer.cloud.shape == LayerShape::profile ? law::profileWeather(p, params, view)
                                                  : law::nubisWeather(p, params, view);
}

using Case = std::tuple<LayerShape, Population, bool>;
class WeatherMap : public testing::TestWithParam<Case> {
 protected:
  Layer layer() const {
    Layer l = layerWith(std::get<0>(GetParam()), std::get<1>(GetParam()));
    if (std::get<2>(GetParam())) l.weather.map = "picture.png";
    return l;
  }
};

// Domes rise steeply at their rims, where SIMD's exp, log and sine differ in the last place: 2e-3 of the thickness, as
// the parity cases say.
TEST_P(WeatherMap, IsTheScalarLaw) {
  const Layer l = layer();
  const Volume map = testMap();
  const Drift drift{12.0f, 3.9f, 500.0};
  const glm::dvec2 centre(31000.0, -8000.0);
  const double edge = 24000.0;
  const int texels = 61;  // no multiple of any number of lanes
  const Volume weather = bakeWeather(l, centre, edge, texels, drift, 7, &map);
  ASSERT_EQ(weather.width, texels);
  ASSERT_EQ(weather.height, texels);
  ASSERT_EQ(weather.channels, 4);
  float most = 0.0f, spread = 0.0f;
  for (int j = 0; j < texels; ++j)
    for (int i = 0; i < texels; ++i) {
      const glm::vec2 p((static_cast<float>(i) + 0.5f) / texels - 0.5f, (static_cast<float>(j) + 0.5f) / texels - 0.5f);
      const glm::vec4 expected = lawAt(l, centre, p * static_cast<float>(edge), drift, 7, &map);
      const float* found = weather.at(i, j, 0);
      for (int c = 0; c < 4; ++c) {
        const bool metres = l.cloud.shape == LayerShape::profile ? c < 2 : c == 3;
        most = std::max(most, std::abs(found[c] - expected[c]) / (metres ? l.cloud.thickness : 1.0f));
      }
      spread = std::max(spread, std::abs(found[0] - weather.at(0, 0, 0)[0]));
    }
  EXPECT_LE(most, 2e-3f);
  EXPECT_GT(spread, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Layers, WeatherMap,
                         testing::Values(Case{LayerShape::profile, Population::domes, false},
                                         Case{LayerShape::profile, Population::clusters, true},
                                         Case{LayerShape::profile, Population::streets, false},
                                         Case{LayerShape::profile, Population::cells, true},
                                         Case{LayerShape::profile, Population::front, false},
                                         Case{LayerShape::profile, Population::uniform, true},
                                         Case{LayerShape::nubis, Population::clusters, false},
                                         Case{LayerShape::nubis, Population::clusters, true}));

// Moved by exactly what the wind has carried, the map is the same to the rounding of the anchor's fractions.
TEST(WeatherMaps, TravelWithTheWind) {
  const Layer l = layerWith(LayerShape::profile, Population::uniform);
  const Drift still{10.0f, 4.0f, 0.0}, later{10.0f, 4.0f, 3600.0};
  const Volume before = bakeWeather(l, {500.0, 900.0}, 20000.0, 48, still, 1);
  const Volume after = bakeWeather(l, glm::dvec2(500.0, 900.0) + driftOffset(later), 20000.0, 48, later, 1);
  for (std::size_t i = 0; i < before.texels.size(); ++i) EXPECT_NEAR(before.texels[i], after.texels[i], 0.5f);
}

TEST(WeatherMaps, RefuseWhatTheyCannotUse) {
  Layer l;
  EXPECT_THROW(bakeWeather(l, {}, 1000.0, 0, {}, 1), Error);
  EXPECT_THROW(bakeWeather(l, {}, 0.0, 8, {}, 1), Error);
  l.weather.map = "picture.png";
  EXPECT_THROW(bakeWeather(l, {}, 1000.0, 8, {}, 1), Error);
  const Volume three(4, 4, 1, 3);
  EXPECT_THROW(bakeWeather(l, {}, 1000.0, 8, {}, 1, &three), Error);
}

}  // namespace
}  // namespace welkin
