// Flashes: when, where, how bright.
#include "welkin/scene/lightning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "welkin/scene/features.hpp"

namespace welkin {
namespace {

Scene storm() {
  Scene scene;
  Layer& layer = scene.layers.front();
  layer.cloud.thickness = 12000.0f;
  layer.weather.coverage = 0.3f;
  layer.weather.cellSize = 20000.0f;
  layer.weather.precipitation = 0.7f;
  layer.weather.anvil = 1.0f;
  scene.lightning.rate = 10.0f;
  return scene;
}

TEST(Lightning, IsOffUnlessAskedFor) {
  Scene scene = storm();
  scene.lightning.rate = 0.0f;
  for (double t = 0.0; t < 60.0; t += 0.1) EXPECT_FALSE(flashAt(scene, {0, 0}, t));
  EXPECT_EQ(featuresOf(scene), "clouds");
}

// Over a minute as many flashes as asked for, each with the light of a fifth of a second of the mean intensity; the
// number of strokes and their strengths are drawn, which leaves 10 per cent to the mean of 200.
TEST(Lightning, FlashesAtItsRate) {
  const Lightning lightning{.rate = 10.0f};
  std::set<long> numbers;
  double light = 0.0;
  constexpr double kStep = 0.001, kEnd = 1200.0;
  for (double t = 0.0; t < kEnd; t += kStep) {
    const FlashTime f = flashTime(lightning, t);
    if (f.share > 0.0) numbers.insert(f.number);
    light += f.share * kStep;
  }
  EXPECT_EQ(numbers.size(), 200u);
  EXPECT_NEAR(light / 200.0, 0.2, 0.02);
  EXPECT_EQ(flashTime(lightning, 7.5).share, flashTime(lightning, 7.5).share);
}

TEST(Lightning, StandsInsideATowerNearby) {
  Scene scene = storm();
  scene.lightning.freeze = true;
  std::set<double> places;
  for (int k = 0; k < 12; ++k) {
    const glm::dvec2 eye(1000.0, -3000.0);
    const auto flash = flashAt(scene, eye, 6.0 * k + 0.1);
    ASSERT_TRUE(flash);
    EXPECT_LT(glm::length(glm::dvec2(flash->position) - eye), 60e3);
    EXPECT_GT(flash->position.z, scene.layers.front().cloud.base);
    EXPECT_LT(flash->position.z, scene.layers.front().cloud.base + 0.6 * 12000.0);
    EXPECT_GT(flash->intensity, 1e4);
    places.insert(flash->position.x);
    const auto again = flashAt(scene, eye, 6.0 * k + 0.1);
    EXPECT_EQ(again->position, flash->position);
  }
  EXPECT_GT(places.size(), 6u);
  // Fair weather does not thunder.
  Scene fair;
  fair.lightning = scene.lightning;
  EXPECT_FALSE(flashAt(fair, {0, 0}, 0.0));
}

TEST(Lightning, IsNamedAsWhatThePathTracerLacks) {
  EXPECT_EQ(featuresOf(storm()), "clouds,lightning");
  EXPECT_EQ(tracedFeaturesOf(storm()), "clouds");
}

}  // namespace
}  // namespace welkin
