// The whole frame, GLSL against C++: one law, one picture.
#include <gtest/gtest.h>

#include "tests/realtime/march_cpu.hpp"

namespace welkin::realtime::test {
namespace {

// Half floats of tables, weather and history, and samples that fall on the other side of a cloud's edge, leave isolated
// pixels different; anything systematic in a law, a table or a parameter costs more than this (see the control below).
constexpr double kSamePicture = 45.0;  // dB, after tone mapping

Scene profileSky() { return plainScene(LayerShape::profile); }
Scene nubisSky() {
  Scene scene = plainScene(LayerShape::nubis);
  scene.lighting.model = LightingModel::nubis;
  scene.layers[0].cloud.extinction = 0.02f;  // opaque cloud would hide a change of its extinction
  scene.sheets = {Sheet{.kind = SheetKind::cirrus}, Sheet{.kind = SheetKind::cirrocumulus, .height = 7000.0f}};
  return scene;
}
// Two layers, rain, an anvil, wind at work, a camera far away above the clouds.
Scene mixedSky() {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers[0].weather.anvil = 0.6f;
  scene.layers[0].weather.precipitation = 0.5f;
  scene.layers[0].cloud.thickness = 6000.0f;
  scene.layers[0].weather.cellSize = 9000.0f;
  scene.layers.push_back(Layer{});
  scene.layers[1].cloud.shape = LayerShape::nubis;
  scene.layers[1].cloud.base = 4000.0f;
  scene.camera.position = {52000.0, -31000.0, 2500.0};
  scene.camera.heading = 2.0f;
  scene.camera.pitch = 0.0f;
  scene.sun.elevation = 0.25f;
  return scene;
}

class FrameParity : public testing::TestWithParam<Scene (*)()> {};

TEST_P(FrameParity, GlslDrawsWhatTheLawSaysInCpp) {
  Scene scene = GetParam()();
  scene.quality.lightVolume = false;
  Stage stage(160, 90);
  const Image gpu = stage.draw(scene, 1, 600.0);
  Frame frame = stage.frame(scene);
  frame.time = 600.0;
  const Image cpu = marchOnCpu(scene, frame);
  const Statistics s = statistics(cpu);
  EXPECT_TRUE(s.finite);
  EXPECT_GT(s.deviation, 0.05 * s.mean) << "the picture shows nothing";
  const double same = displayedPsnr(gpu, cpu);
  RecordProperty("psnr", std::to_string(same));
  EXPECT_GT(same, kSamePicture);

  // Negative control: a tenth more extinction; half as much again where little of the first layer is in sight.
  Scene other = scene;
  other.layers[0].cloud.extinction *= GetParam() == &profileSky ? 1.1f : 1.5f;
  EXPECT_LT(displayedPsnr(gpu, marchOnCpu(other, frame)), kSamePicture);
}

INSTANTIATE_TEST_SUITE_P(Skies, FrameParity, testing::Values(&profileSky, &nubisSky, &mixedSky), [](const auto& sky) {
  return std::string(sky.param == &profileSky ? "profile" : sky.param == &nubisSky ? "nubis" : "mixed");
});

}  // namespace
}  // namespace welkin::realtime::test
