// Scenes with random and extreme values in every field draw finite light in bounded time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/stage.hpp"
#include "tests/scene/random_scene.hpp"

namespace welkin::realtime::test {
namespace {

// Light is drawn in units of 10 Mcd/m^2: the sun's disc is 200 of them, the sharpest phase function towards the sun 20.
// The shaders' caps turn what is not a number into 60000, which is then seen.
constexpr float kPreExposure = 1e-4f;
constexpr double kBrightest = 1000.0;
// Samples of a ray, the mean over a picture: these skies take up to 750. Random qualities may ask for steps so short
// that rays end at the march's cap, 20000.
constexpr double kMostSamples = 2000.0, kCap = 20000.0;

// Numbers of layers by shape and of sheets: what the march is compiled for. Twenty skies share one.
struct Kind {
  int profile, nubis;
  std::size_t sheets;
};
constexpr Kind kKinds[] = {{1, 0, 0}, {0, 1, 0}, {1, 0, 2}, {0, 1, 1}, {1, 1, 1},
                           {2, 0, 0}, {0, 2, 0}, {2, 2, 4}, {0, 0, 4}, {0, 0, 0}};
constexpr unsigned kSkies = 20;

// Whether the scene's quality is random, too, and not a preset's.
bool ownQuality(unsigned seed) { return seed % 4 >= 2; }

// Every field random, a third of them or all, with a camera from below the ground to orbit. Noise keeps its settings
// (tests/noise varies them).
Scene mutated(const Kind& kind, unsigned seed) {
  std::mt19937 random(seed);
  Scene scene;
  scene.layers.resize(static_cast<std::size_t>(kind.profile + kind.nubis));
  scene.sheets.resize(kind.sheets);
  const double share = seed % 3 == 0 ? 1.0 : 0.3;
  for (const Section& section : sectionsOf(scene))
    for (const Field& f : section.fields)
      if (welkin::test::between(random, 0.0, 1.0) < share) {
        FieldValue value = welkin::test::randomValue(f, random);
        if (f.kind == FieldKind::real && random() % 8 == 0) value = f.hard.low;
        assign(scene, section, f, value);
      }
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    scene.layers[i].cloud.shape = static_cast<int>(i) < kind.profile ? LayerShape::profile : LayerShape::nubis;
  const double far = std::exp(welkin::test::between(random, 0.0, 16.0));
  scene.camera.position = {welkin::test::between(random, -far, far), welkin::test::between(random, -far, far),
                           std::exp(welkin::test::between(random, 0.0, 13.0)) - 100.0};
  scene.noise = {};
  scene.noise.profile.baseSize = scene.noise.baseShape.size = 32;
  if (!ownQuality(seed)) scene.quality = qualityPreset(seed % 2 ? QualityPreset::ultra : QualityPreset::high);
  makeSmall(scene);
  return scene;
}

class RandomScenes : public testing::TestWithParam<Kind> {};

TEST_P(RandomScenes, DrawFiniteLightInBoundedTime) {
  Stage stage(32, 18);
  stage.sky->countSamples(true);
  double most = 0.0;
  for (unsigned i = 0; i < kSkies; ++i) {
    const unsigned seed =
        1000u * static_cast<unsigned>(GetParam().profile + 3 * GetParam().nubis + 9 * GetParam().sheets) + i;
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Scene scene = mutated(GetParam(), seed);
    Statistics s;
    View view;
    stage.sky->setScene(scene);
    Frame frame = stage.frame(scene);
    frame.time = scene.time;
    frame.preExposure = kPreExposure;
    ASSERT_NO_THROW(s = statistics(stage.draw(view, frame)));
    const FrameCost cost = stage.sky->lastCost();
    if (!ownQuality(seed)) {
      EXPECT_LE(cost.densitySamples / cost.rays, kMostSamples);
    }
    EXPECT_LE(cost.mostSamples, kCap);
    most = std::max(most, cost.densitySamples / cost.rays);
    EXPECT_TRUE(s.finite);
    EXPECT_GE(s.least, 0.0);
    EXPECT_LT(s.most, kBrightest);
  }
  RecordProperty("most", std::to_string(most));
}
INSTANTIATE_TEST_SUITE_P(Kinds, RandomScenes, testing::ValuesIn(kKinds), [](const auto& kind) {
  return fmt::format("profile{}nubis{}sheets{}", kind.param.profile, kind.param.nubis, kind.param.sheets);
});

}  // namespace
}  // namespace welkin::realtime::test
