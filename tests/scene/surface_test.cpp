#include "welkin/scene/surface.hpp"

#include <gtest/gtest.h>

namespace welkin {
namespace {

TEST(SurfaceAlbedo, IsTheGroundsWithoutClouds) {
  Scene scene;
  scene.layers.clear();
  EXPECT_EQ(surfaceAlbedo(scene), scene.ground.albedo);
}

TEST(SurfaceAlbedo, NeverExceedsOne) {
  EXPECT_EQ(surfaceAlbedo(glm::vec3(1.0f), 0.4f), glm::vec3(1.0f));
  EXPECT_EQ(surfaceAlbedo(glm::vec3(0.0f), 0.4f), glm::vec3(0.4f));
}

}  // namespace
}  // namespace welkin
