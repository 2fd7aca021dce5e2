// From a scene's values to what falls.
#include "welkin/scene/rain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/scene/features.hpp"

namespace welkin {
namespace {

Scene rainy() {
  Scene scene;
  scene.layers[0].weather.precipitation = 0.8f;
  scene.precipitation.rate = 20.0f;
  return scene;
}

TEST(RainParams, NothingFallsUnlessAskedForAndCloudsHaveIt) {
  Scene scene = rainy();
  EXPECT_TRUE(rains(scene));
  EXPECT_EQ(featuresOf(scene), "clouds,drops,rain");
  EXPECT_EQ(tracedFeaturesOf(scene), "clouds,rain") << "the path tracer has no drops";
  scene.precipitation.rate = 0.0f;
  EXPECT_FALSE(rains(scene));
  EXPECT_EQ(featuresOf(scene), "clouds");
  scene = rainy();
  scene.layers[0].weather.precipitation = 0.0f;
  EXPECT_FALSE(rains(scene));
  EXPECT_EQ(rainParams(scene, scene.layers[0]).rate, 0.0f);
  EXPECT_EQ(rainBound(scene, scene.layers[0]), 0.0f);
}

TEST(RainParams, ItFreezesWhereTheStandardAtmosphereSays) {
  Scene scene = rainy();
  scene.precipitation.temperature = 6.5f;
  EXPECT_NEAR(freezingLevel(scene.precipitation), 1000.0f, 0.1f);
  EXPECT_GT(fallingAt(scene.precipitation, 1500.0f).snow, 0.99f);
  EXPECT_EQ(fallingAt(scene.precipitation, 0.0f).snow, 0.0f);
}

TEST(RainParams, ShaftsStayBehindTheirCloudAndSnowMoreThanRain) {
  Scene scene = rainy();
  scene.wind.speed = 10.0f;
  scene.layers[0].cloud.base = 1500.0f;
  const law::RainParams rain = rainParams(scene, scene.layers[0]);
  scene.precipitation.temperature = -10.0f;
  const law::RainParams snow = rainParams(scene, scene.layers[0]);
  EXPECT_EQ(law::rainBehind(1500.0f, rain), 0.0f);
  // Half of the wind's shortfall at the ground, over half of the way, for the time of the fall.
  const float speed = law::rainSpeed(4.0f / law::rainSlope(20.0f));
  EXPECT_NEAR(law::rainBehind(0.0f, rain), 0.25f * 10.0f * 1500.0f / speed, 1.0f);
  EXPECT_GT(law::rainBehind(0.0f, snow), 4.0f * law::rainBehind(0.0f, rain));
  EXPECT_GT(law::rainBehind(200.0f, rain), law::rainBehind(900.0f, rain));
}

TEST(RainParams, ClassesHaveTheCrossSectionOfTheirDistribution) {
  for (const float temperature : {15.0f, -15.0f}) {
    Scene scene = rainy();
    scene.precipitation.temperature = temperature;
    scene.precipitation.rate = 5.0f;
    const Falling f = fallingAt(scene.precipitation, 0.0f);
    double area = 0.0;
    for (const FallClass& c : f.classes) {
      area += 0.25e-6 * M_PI * c.diameter * c.diameter * f.count / kFallClasses;
      EXPECT_GT(c.speed, 0.3f);
      EXPECT_EQ(c.snow, temperature < 0.0f ? 1.0f : 0.0f);
    }
    const double wanted = f.share * law::fallingExtinction(5.0f, temperature < 0.0f ? 1.0f : 0.0f);
    EXPECT_NEAR(area / wanted, 1.0, 0.06) << "32 classes cut the tail";
  }
}

}  // namespace
}  // namespace welkin
