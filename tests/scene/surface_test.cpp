#include "welkin/scene/surface.hpp"

#include <gtest/gtest.h>

namespace welkin {
namespace {

TEST(AirSurface, IsTheGroundsWithoutClouds) {
  Scene scene;
  scene.layers.clear();
  const AirSurface surface = airSurface(scene);
  EXPECT_EQ(surface.ground, scene.ground.albedo);
  EXPECT_EQ(surface.clouds, 0.0f);
}

TEST(AirSurface, SpansAllLayers) {
  Scene scene;
  scene.layers.resize(2);
  scene.layers[0].cloud.base = 800.0f;
  scene.layers[0].cloud.thickness = 400.0f;
  scene.layers[1].cloud.base = 2000.0f;
  scene.layers[1].cloud.thickness = 500.0f;
  const AirSurface surface = airSurface(scene);
  EXPECT_EQ(surface.cloudBottom, 800.0f);
  EXPECT_EQ(surface.cloudTop, 2500.0f);
  EXPECT_GT(surface.clouds, 0.0f);
}

}  // namespace
}  // namespace welkin
