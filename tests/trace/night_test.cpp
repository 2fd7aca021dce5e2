// The path tracer by night: its air against the tables of the sky, moonlit clouds against sunlit ones, the moon's disc.
#include <gtest/gtest.h>

#include <cmath>

#include "welkin/atmosphere/moon.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::trace {
namespace {

double luminanceOf(const TraceLayers& layers) {
  double sum = 0.0;
  const std::size_t n = layers.variance.pixels.size();
  for (std::size_t i = 0; i < n; ++i) {
    const float* c = layers.radiance.pixels.data() + 3 * i;
    sum += 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  }
  return sum / static_cast<double>(n);
}

double luminanceOf(const Scene& scene, const TraceSettings& settings, double* error = nullptr) {
  PathTracer tracer(scene, {}, settings);
  EXPECT_TRUE(tracer.run({}));
  EXPECT_EQ(tracer.statistics().notFinite, 0u);
  const TraceLayers layers = tracer.layers();
  double variance = 0.0;
  for (const float v : layers.variance.pixels) variance += v;
  if (error) *error = std::sqrt(variance) / static_cast<double>(layers.variance.pixels.size());
  return luminanceOf(layers);
}

Scene clearNight(double sunElevation, bool moon) {
  Scene scene;
  scene.layers.clear();
  scene.sun.elevation = static_cast<float>(sunElevation * kDegree);
  scene.sun.azimuth = static_cast<float>(300 * kDegree);
  scene.moon.mode = moon ? MoonMode::angles : MoonMode::off;
  scene.moon.elevation = static_cast<float>(40 * kDegree);
  scene.moon.azimuth = static_cast<float>(150 * kDegree);
  scene.night.stars = scene.night.milkyWay = 0.0f;
  scene.camera.heading = static_cast<float>(240 * kDegree);
  scene.camera.pitch = static_cast<float>(30 * kDegree);
  scene.camera.fov = static_cast<float>(20 * kDegree);
  return scene;
}

// Moonlight: 3 per cent, as by day. The airglow alone: the tables leave out that the air scatters it, a sixth of it.
TEST(NightPaths, AgreeWithTheTablesOfTheSky) {
  for (const bool moon : {true, false}) {
    const Scene scene = clearNight(-30, moon);
    TraceSettings settings{.width = 24, .height = 24, .samples = 512};
    const double paths = luminanceOf(scene, settings);
    settings.air = AirModel::tables;
    settings.samples = 4;
    EXPECT_NEAR(paths / luminanceOf(scene, settings), moon ? 1.0 : 1.16, moon ? 0.06 : 0.06) << moon;
  }
}

// In the dusk two lights count: the sky is the sum of what each makes alone. A brighter moon, since the paths of a
// deeper dusk are noisy.
TEST(NightPaths, AddTheLightsOfDusk) {
  const TraceSettings settings{.width = 24, .height = 24, .samples = 2048};
  Scene sun = clearNight(-5, false), moon = clearNight(-40, true), both = clearNight(-5, true);
  moon.moon.brightness = both.moon.brightness = 500.0f;
  sun.night.airglow = moon.night.airglow = both.night.airglow = 0.0f;
  double errors[3] = {};
  const double a = luminanceOf(sun, settings, &errors[0]), b = luminanceOf(moon, settings, &errors[1]);
  const double sum = luminanceOf(both, settings, &errors[2]);
  const double error = std::hypot(errors[0], errors[1], errors[2]);
  EXPECT_NEAR(sum, a + b, 4.0 * error);
  EXPECT_LT(error, 0.08 * sum) << "or else this says nothing";
  EXPECT_GT(a, 0.2 * b);
  EXPECT_GT(b, 0.2 * a);
}

// Clouds under the moon look as under a sun of the same place, as much fainter as its light.
TEST(NightPaths, MoonLightsCloudsAsTheSunDoes) {
  Scene night = clearNight(-40, true), day = night;
  night.layers = day.layers = {Layer{}};
  day.moon.mode = MoonMode::off;
  day.sun.elevation = night.moon.elevation;
  day.sun.azimuth = night.moon.azimuth;
  const TraceSettings settings{.width = 24,
                               .height = 24,
                               .samples = 64,
                               .sunDisc = SunDisc::leftOut,
                               .clouds = {.weather = {.texels = 256}, .cells = 64, .cellLayers = 32}};
  const double light = luminance(heavensOf(night.sun, night.moon, night.night).lights.light.irradiance);
  // The moon's redder light and the airglow, a thousandth of it, remain; so does noise of 2 per cent.
  EXPECT_NEAR(luminanceOf(night, settings) / luminanceOf(day, settings) / (light / 128.0), 1.0, 0.06);
}

// Half a moon: its lit side toward the sun, and its light as the disc's.
TEST(NightPaths, ShowTheMoonsPhase) {
  Scene scene = clearNight(-30, true);
  scene.moon.phase = 0.5f;
  scene.sun.azimuth = static_cast<float>(60 * kDegree);  // to the left
  scene.camera.heading = scene.moon.azimuth;
  scene.camera.pitch = scene.moon.elevation;
  scene.camera.fov = static_cast<float>(1.0 * kDegree);
  scene.night.airglow = 0.0f;
  PathTracer tracer(scene, {}, {.width = 20, .height = 20, .samples = 32});
  ASSERT_TRUE(tracer.run({}));
  const TraceLayers layers = tracer.layers();
  double left = 0.0, right = 0.0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) (x < 10 ? left : right) += layers.radiance.at(x, y)[1];
  EXPECT_GT(left, 4.0 * right);
  // The air takes a third at this height; what is seen outside the disc is a thousandth.
  const double pixel = std::pow(2.0 * std::tan(0.5 * kDegree) / 20.0, 2.0);
  const Heavens h = heavensOf(scene.sun, scene.moon, scene.night);
  EXPECT_NEAR((left + right) * pixel / h.lights.light.irradiance.y, 0.77, 0.08);
}

}  // namespace
}  // namespace welkin::trace
