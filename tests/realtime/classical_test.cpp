// Classical clouds in the real-time renderer: the clouds of the CPU, at the frame's time.
#include <gtest/gtest.h>

#include "tests/realtime/march_cpu.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/classical/clouds.hpp"

namespace welkin::realtime::test {
namespace {

// One of each kind, small, side by side before the camera.
Scene classicalScene() {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers.clear();
  scene.quality.lightVolume = false;
  scene.camera.position = {0.0, -3500.0, 100.0};
  scene.camera.pitch = 0.3f;
  scene.wind.speed = 20.0f;
  for (int kind = 0; kind < 6; ++kind) {
    Classical cloud;
    cloud.cloud.kind = static_cast<ClassicalKind>(kind);
    cloud.cloud.position = {1300.0 * (kind % 3) - 1300.0, 1200.0 * (kind / 3), 700.0 + 700.0 * (kind / 3)};
    cloud.cloud.size = {1200.0f, 1000.0f, 700.0f};
    cloud.cloud.heading = 0.4f * static_cast<float>(kind);
    cloud.cloud.voxels = 50000;
    cloud.heightMap.elements = 256;
    cloud.heightMap.squares = 40;
    cloud.automaton = {.width = 64, .breadth = 64, .height = 24, .start = 30};
    scene.classical.push_back(cloud);
  }
  return scene;
}

std::vector<PlacedGrid> cloudsAt(const Scene& scene, double time) {
  ClassicalClouds clouds;
  clouds.update(scene.classical, {scene.wind.speed, scene.wind.from, time}, scene.seed);
  return clouds.placed();
}

TEST(ClassicalFrameParity, TheFrameShowsTheCloudsOfTheCpuAtItsTime) {
  Stage stage(128, 72);
  const Scene scene = classicalScene();
  stage.sky->setScene(scene);
  // 40 s on: the automaton has taken 8 steps, the height map's window 10, and the wind has carried the others by 800 m.
  for (const double time : {0.0, 40.0}) {
    Frame frame = stage.frame(scene);
    frame.time = time;
    stage.view.reset();
    const Image gpu = stage.draw(stage.view, frame);
    const Image cpu = marchOnCpu(scene, frame, cloudsAt(scene, time));
    const Statistics s = statistics(cpu);
    EXPECT_GT(s.deviation, 0.05 * s.mean) << "the picture shows nothing";
    EXPECT_GT(displayedPsnr(gpu, cpu), 45.0) << time;
    // Negative control: clouds of three seconds later.
    EXPECT_LT(displayedPsnr(gpu, marchOnCpu(scene, frame, cloudsAt(scene, time + 3.0))), 40.0) << time;
  }
}

TEST(ClassicalFrameParity, TooManyAreRefused) {
  Stage stage(16, 16);
  Scene scene = classicalScene();
  scene.classical.resize(6);
  scene.heroes.resize(3);
  try {
    stage.sky->setScene(scene);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("at most 8 grids, classical and hero clouds together, and this sky has 9"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace welkin::realtime::test
