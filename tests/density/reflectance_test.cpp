#include "welkin/density/reflectance.hpp"

#include <gtest/gtest.h>

#include <array>

namespace welkin {
namespace {

Layer deck(float thickness, float extinction) {
  Layer layer;
  layer.weather.population = Population::uniform;
  layer.weather.coverage = 1.0f;
  layer.cloud.thickness = thickness;
  layer.cloud.extinction = extinction;
  return layer;
}

TEST(CloudReflectance, NothingReflectsNothing) {
  EXPECT_EQ(cloudReflectance({}, 1), 0.0f);
  const std::array thin{deck(500.0f, 0.0f)};
  EXPECT_EQ(cloudReflectance(thin, 1), 0.0f);
}

TEST(CloudReflectance, GrowsWithDepthAndStaysBelowOne) {
  float before = 0.0f;
  for (const float extinction : {0.005f, 0.02f, 0.1f, 1.0f}) {
    const std::array layers{deck(1000.0f, extinction)};
    const float now = cloudReflectance(layers, 1);
    EXPECT_GT(now, before);
    EXPECT_LT(now, 1.0f);
    before = now;
  }
}

TEST(CloudReflectance, LayersAddAsSlabsDo) {
  const std::array one{deck(500.0f, 0.05f)};
  const std::array two{one[0], one[0]};
  const float a = cloudReflectance(one, 1);
  EXPECT_NEAR(cloudReflectance(two, 1), 2.0f * a / (1.0f + a), 1e-5f);
}

TEST(CloudReflectance, CountsNubisAndPicturesOfWeather) {
  std::array layers{deck(1500.0f, 0.05f)};
  layers[0].cloud.shape = LayerShape::nubis;
  EXPECT_GT(cloudReflectance(layers, 1), 0.05f);
  layers[0] = deck(1500.0f, 0.05f);
  const float plain = cloudReflectance(layers, 1);
  layers[0].weather.map = "a_picture.png";
  EXPECT_FLOAT_EQ(cloudReflectance(layers, 1), plain);
}

}  // namespace
}  // namespace welkin
