// Empty space is crossed without losing cloud: what comes through is the same for the march that skips by the weather's
// bounds as for the march that samples all the way.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/stage.hpp"

namespace welkin::realtime::test {
namespace {

struct Case {
  const char* name;
  LayerShape shape;
  float anvil, shear;
  double height;  // of the camera, m
  float pitch;
};

class Clearance : public testing::TestWithParam<Case> {};

Image transmittance(const Scene& scene) {
  Stage stage(64, 36);
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  frame.output = Output::transmittance;
  frame.background = Background::sky;
  return stage.draw(stage.view, frame);
}

// Sums over the picture.
struct Loss {
  double clouded = 0.0, lost = 0.0;
};
Loss lossOf(Scene scene) {
  scene.quality.lightVolume = false;
  const Image all = transmittance(scene);
  scene.quality.lightVolume = true;
  const Image skipping = transmittance(scene);
  Loss loss;
  for (std::size_t i = 0; i < all.pixels.size(); i += 4) {
    loss.clouded += 1.0 - all.pixels[i];
    loss.lost += static_cast<double>(skipping.pixels[i]) - all.pixels[i];
  }
  return loss;
}

TEST_P(Clearance, LosesNoCloud) {
  const Case& c = GetParam();
  Scene scene = plainScene(c.shape);
  scene.quality.stepScale = 0.5f;
  scene.wind.speed = 12.0f;
  Layer& layer = scene.layers.front();
  layer.weather.anvil = c.anvil;
  layer.cloud.shear = c.shear;
  if (c.anvil > 0.0f) {
    layer.cloud.thickness = 9000.0f;
    layer.weather.cellSize = 20000.0f;
  }
  scene.camera.position.z = c.height;
  scene.camera.pitch = c.pitch;
  const auto [clouded, lost] = lossOf(scene);
  const double pixels = 64.0 * 36.0;
  std::printf("%s: clouded %.3f, lost %.4f\n", c.name, clouded / pixels, lost / clouded);
  ASSERT_GT(clouded, 0.05 * pixels);
  ASSERT_LT(clouded, 0.98 * pixels);
  // Steps fall in other places, and are longer outside of outlines: a thousandth of the cloud is lost by that.
  EXPECT_LT(std::abs(lost), 0.002 * clouded);
}

// Copies of hero clouds are met wherever a ray comes from.
TEST(Clearance, LosesNoCopy) {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers.clear();
  scene.quality.stepScale = 0.5f;
  Hero hero = heroPreset(HeroSpecies::mediocris);
  hero.scatter = {.radius = 25000.0f, .spacing = 2500.0f, .share = 0.8f, .variation = 0.4f, .turn = 0.5f};
  scene.heroes = {hero};
  for (const auto& [height, pitch] : {std::pair(100.0, 0.2f), {6000.0, -0.25f}, {1500.0, 0.02f}}) {
    scene.camera.position = {400.0, -1200.0, height};
    scene.camera.pitch = pitch;
    const auto [clouded, lost] = lossOf(scene);
    std::printf("from %.0f m: clouded %.3f, lost %.4f\n", height, clouded / (64.0 * 36.0), lost / clouded);
    ASSERT_GT(clouded, 0.05 * 64.0 * 36.0);
    // Small clouds far away are met by few steps, which fall in other places.
    EXPECT_LT(std::abs(lost), 0.01 * clouded);
  }
}

INSTANTIATE_TEST_SUITE_P(Skies, Clearance,
                         testing::Values(Case{"profile", LayerShape::profile, 0.0f, 0.0f, 100.0, 0.25f},
                                         Case{"sheared", LayerShape::profile, 0.0f, 1500.0f, 100.0, 0.25f},
                                         Case{"above", LayerShape::profile, 0.0f, 300.0f, 6000.0, -0.4f},
                                         Case{"anvil", LayerShape::profile, 1.0f, 900.0f, 100.0, 0.2f},
                                         Case{"nubis", LayerShape::nubis, 0.0f, 200.0f, 100.0, 0.25f}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace welkin::realtime::test
