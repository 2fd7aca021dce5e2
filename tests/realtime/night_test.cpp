// Night in real time: moonlit clouds against sunlit ones, the light of the stars at every resolution, and a day that
// knows nothing of it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/stage.hpp"
#include "welkin/atmosphere/moon.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/scene/lightning.hpp"

namespace welkin::realtime {
namespace {

using test::plainScene, test::Stage;

Scene night() {
  Scene scene = plainScene(LayerShape::profile);
  scene.sun.elevation = static_cast<float>(-35 * kDegree);
  scene.moon.mode = MoonMode::angles;
  scene.moon.elevation = static_cast<float>(35 * kDegree);
  scene.moon.azimuth = static_cast<float>(110 * kDegree);
  scene.night.stars = scene.night.milkyWay = 0.0f;
  return scene;
}

double luminanceOf(const Image& light) {
  double sum = 0.0;
  const std::size_t n = light.pixels.size() / static_cast<std::size_t>(light.channels);
  for (std::size_t i = 0; i < n; ++i) {
    const float* c = light.pixels.data() + i * static_cast<std::size_t>(light.channels);
    sum += luminance({c[0], c[1], c[2]});
  }
  return sum / static_cast<double>(n);
}

// Moonlight is sunlight 400,000 times fainter: the picture is the same down to the airglow, a hundredth of the sky, and
// the moon's redder light. Half floats without the history's factor would lose it.
TEST(Night, MoonlitCloudsLookAsSunlitOnes) {
  Scene dark = night(), day = dark;
  day.moon.mode = MoonMode::off;
  day.sun.elevation = dark.moon.elevation;
  day.sun.azimuth = dark.moon.azimuth;
  Stage stage(96, 54);
  const Image a = stage.draw(dark), b = stage.draw(day);
  const double light = luminance(heavensOf(dark.sun, dark.moon, dark.night).lights.light.irradiance) / 128.0;
  EXPECT_NEAR(luminanceOf(a) / luminanceOf(b) / light, 1.0, 0.05);
  double error = 0.0;
  for (std::size_t i = 1; i < a.pixels.size(); i += 4) error += std::abs(a.pixels[i] / (light * b.pixels[i]) - 1.0);
  EXPECT_LT(4.0 * error / static_cast<double>(a.pixels.size()), 0.06);
}

// The stars' light over the sky that a picture shows does not hang on its pixels.
TEST(Night, StarsKeepTheirLightAtEveryResolution) {
  const auto starlight = [](int width) {
    Scene scene = night();
    scene.layers.clear();
    scene.moon.mode = MoonMode::off;
    scene.camera.pitch = static_cast<float>(60 * kDegree);
    scene.camera.fov = static_cast<float>(50 * kDegree);
    Stage stage(width, width);
    const double without = luminanceOf(stage.draw(scene));
    scene.night.stars = 1.0f;
    return luminanceOf(stage.draw(scene)) - without;
  };
  const double coarse = starlight(256), fine = starlight(768);
  EXPECT_NEAR(coarse / fine, 1.0, 0.1);
  EXPECT_GT(fine, 0.3 * 2.4e-7 / (4.0 * kPi)) << "a third of the mean of the sphere, at least";
}

TEST(Night, DayIsTheSameWithAndWithoutStars) {
  Scene scene = plainScene(LayerShape::profile);
  Stage stage(64, 36);
  const Image with = stage.draw(scene);
  scene.night.stars = scene.night.milkyWay = 0.0f;
  EXPECT_EQ(stage.draw(scene).pixels, with.pixels);
}

// Clouds cover the stars, and the moon's disc is where the scene puts it.
TEST(Night, MoonStandsInThePicture) {
  Scene scene = night();
  scene.layers.clear();
  scene.camera.heading = scene.moon.azimuth;
  scene.camera.pitch = scene.moon.elevation;
  scene.camera.fov = static_cast<float>(4 * kDegree);
  Stage stage(64, 64);
  const Image picture = stage.draw(scene);
  EXPECT_GT(picture.at(32, 32)[1], 1.0f);  // kcd/m^2
  EXPECT_LT(picture.at(48, 32)[1], 0.01f);
  double sum = 0.0;
  const double pixel = std::pow(2.0 * std::tan(2.0 * kDegree) / 64.0, 2.0);
  for (int y = 24; y < 40; ++y)
    for (int x = 24; x < 40; ++x) sum += picture.at(x, y)[1] * pixel;
  const double outside = heavensOf(scene.sun, scene.moon, scene.night).lights.light.irradiance.y;
  EXPECT_NEAR(sum / outside, 0.78, 0.08) << "the air takes a fifth";
}

// A flash lights its tower; without light it leaves the sky alone, up to the rounding of another shader.
TEST(Night, LightningLightsItsTower) {
  Scene scene = night();
  Layer& layer = scene.layers.front();
  layer.cloud.thickness = 10000.0f;
  layer.weather.coverage = 0.5f;
  layer.weather.precipitation = 0.8f;
  layer.weather.cellSize = 15000.0f;
  Stage stage(96, 54);
  scene.lightning.rate = 10.0f;
  scene.lightning.freeze = true;
  const auto flash = flashAt(scene, glm::dvec2(scene.camera.position), 0.0);
  ASSERT_TRUE(flash);
  const glm::dvec3 way = flash->position - scene.camera.position;
  scene.camera.heading = static_cast<float>(std::atan2(way.x, way.y));
  const double lit = luminanceOf(stage.draw(scene));
  scene.lightning.brightness = 0.0f;
  const double dark = luminanceOf(stage.draw(scene));
  EXPECT_GT(lit, 2.0 * dark) << "other clouds stand before its tower";
  scene.lightning.rate = 0.0f;
  EXPECT_NEAR(luminanceOf(stage.draw(scene)) / dark, 1.0, 1e-4);
}

}  // namespace
}  // namespace welkin::realtime
