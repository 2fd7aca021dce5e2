// Shade in the air between the eye and what it sees.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/stage.hpp"
#include "welkin/density/params.hpp"
#include "welkin/realtime/law.hpp"

namespace welkin::realtime::test {
namespace {

const glm::vec2 kAll(0.0f, 1e9f);  // the way in shade

TEST(AirShade, EvenShadeIsTheSameAtAnyDistance) {
  const law::AirShade even{glm::vec4(0.3f), glm::vec4(0.3f)};
  for (const float distance : {1.0f, 400.0f, 3000.0f, 50000.0f, 200000.0f})
    for (const float loss : {1e-6f, 3e-5f, 1e-3f})
      EXPECT_NEAR(law::shadeBefore(even, distance, loss, kAll), 0.3f, loss * distance < 1e-4f ? 0.05f : 1e-3f)
          << distance << " m, " << loss;  // single precision, where next to nothing is scattered
}

TEST(AirShade, CountsSegmentsByTheLightThatComesFromThem) {
  // Shade from 4 km on.
  const law::AirShade far{glm::vec4(0.0f), glm::vec4(1.0f)};
  EXPECT_EQ(law::shadeBefore(far, 3900.0f, 1e-4f, kAll), 0.0f);
  for (const float distance : {6000.0f, 30000.0f}) {
    const double kept = std::exp(-0.4), end = std::exp(-1e-4 * distance);
    EXPECT_NEAR(law::shadeBefore(far, distance, 1e-4f, kAll), (kept - end) / (1.0 - end), 1e-4);
  }
}

// Of far air that part alone which lies below the clouds: of a ray that leaves them after 20 km, 16 to 20 km.
TEST(AirShade, FarSegmentsEndAtTheClouds) {
  const law::AirShade far{glm::vec4(0.0f), glm::vec4(0.0f, 0.0f, 1.0f, 1.0f)};
  const double loss = 2e-5, whole = 1.0 - std::exp(-loss * 1e5);
  EXPECT_NEAR(law::shadeBefore(far, 1e5f, static_cast<float>(loss), {0.0f, 20e3f}),
              (std::exp(-loss * 16e3) - std::exp(-loss * 20e3)) / whole, 1e-4);
  EXPECT_EQ(law::shadeBefore(far, 1e5f, static_cast<float>(loss), {0.0f, 9e3f}), 0.0f);

  const glm::vec2 level = law::wayInShade({1.0f, 0.0f, 0.0f}, 1000.0f, 3000.0f, planetParams(glm::dvec3(0.0)));
  EXPECT_EQ(level.x, 0.0f);
  const double rise = static_cast<double>(law::shadeAltitude(1000.0f, 3000.0f));
  EXPECT_NEAR(level.y, std::sqrt(2.0 * 6360e3 * rise), 300.0);
}

// Black ground under broken clouds, toward the horizon: all that is seen is air.
TEST(AirShade, DoesNotDependOnTheJitter) {
  Scene scene = plainScene(LayerShape::profile);
  scene.quality.lightVolume = true;
  scene.layers[0].weather.coverage = 0.5f;
  scene.ground.albedo = glm::vec3(0.0f);
  scene.atmosphere.haze = 1e-4f;
  scene.atmosphere.hazeHeight = 2000.0f;
  scene.camera.pitch = -0.06f;
  scene.camera.fov = 0.1f;
  Stage stage(48, 27);
  const Image even = stage.draw(scene);
  scene.quality.jitter = true;
  const Image jittered = stage.draw(scene);
  scene.layers.clear();
  const Image clear = stage.draw(scene);
  // Clouds whiten near air and take the sun from far air: path-traced (256 paths of a pixel) the blue is .80 of that of
  // the same air without clouds, the luminance 1.00. A volume that holds no shade leaves 1 or more.
  const auto blue = [](const Image& image) {
    double sum = 0.0;
    for (std::size_t i = 2; i < image.pixels.size(); i += 3) sum += static_cast<double>(image.pixels[i]);
    return sum;
  };
  EXPECT_LT(blue(even), 0.95 * blue(clear));
  const double mean = statistics(even).mean;
  double most = 0.0;
  for (std::size_t i = 0; i < even.pixels.size(); ++i)
    most = std::max(most, std::abs(double(even.pixels[i]) - jittered.pixels[i]));
  EXPECT_LT(most, 2e-3 * mean);  // half floats; grain of four samples was a hundred times that
}

}  // namespace
}  // namespace welkin::realtime::test
