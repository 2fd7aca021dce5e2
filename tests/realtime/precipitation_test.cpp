// Rain and snow in the frame: drops where it rains, as many as fall, behind nothing; shafts as the path tracer has
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/realtime/march_cpu.hpp"
#include "tests/realtime/stage.hpp"
#include "welkin/realtime/drops.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::realtime::test {
namespace {

// Steady rain from a closed layer, seen from the ground.
Scene rainy() {
  Scene scene = plainScene(LayerShape::profile);
  Layer& layer = scene.layers[0];
  layer.cloud.base = 900.0f;
  layer.cloud.thickness = 2000.0f;
  layer.weather.population = Population::uniform;
  layer.weather.coverage = 1.0f;
  layer.weather.precipitation = 1.0f;
  scene.precipitation.rate = 60.0f;
  scene.precipitation.evaporation = 0.0f;
  scene.precipitation.particles = 40000;
  scene.camera.position.z = 60.0;
  scene.camera.pitch = 0.3f;
  return scene;
}

double difference(const Image& a, const Image& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(a.pixels[i]) - b.pixels[i]));
  return most;
}

// How much of a white picture behind it the frame lets through.
Image through(Stage& stage, const Scene& scene) {
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  frame.background = Background::host;
  frame.output = Output::transmittance;
  View view;
  return stage.draw(view, frame, glm::vec4(1.0f));
}
double meanOf(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 1; i < image.pixels.size(); i += 4) sum += image.pixels[i];
  return sum / (image.pixels.size() / 4.0);
}

TEST(Drops, StandStillInTheAirThatCarriesThem) {
  const Scene scene = rainy();
  const FrameParams view = frameParams(frameOf(scene.camera, kWidth, kHeight), kWidth, kHeight, 1, scene.quality, 0);
  const DropLevels levels = dropLevels(scene.precipitation, view, 60.0f);
  const glm::dvec2 wind(3.0, -1.5);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const auto placeOf = [&](const glm::dvec3& eye, double time, int kind, const glm::ivec3& number) {
    const law::DropClass c = dropClasses(levels, eye, up, wind, glm::dvec3(0.0), time)[static_cast<std::size_t>(kind)];
    const glm::vec3 cell(number - glm::ivec3(c.cellX, c.cellY, c.cellZ));
    return eye + glm::dvec3(law::particlePlace(cell, glm::vec3(c.start), glm::vec3(0.25f, 0.5f, 0.75f),
                                               levels.edge[kind / kFallClasses]));
  };
  for (const double start : {0.0, 3600.0, 1e6})
    for (const int kind : {0, 17, kFallClasses * 3 + 31}) {
      SCOPED_TRACE(start);
      const glm::dvec3 eye(12000.0, -3500.0, 60.0);
      const law::DropClass c =
          dropClasses(levels, eye, up, wind, glm::dvec3(0.0), start)[static_cast<std::size_t>(kind)];
      const glm::ivec3 number = glm::ivec3(c.cellX, c.cellY, c.cellZ) + glm::ivec3(2, 1, 4);
      const glm::dvec3 before = placeOf(eye, start, kind, number);
      const double speed = levels.falling.classes[static_cast<std::size_t>(kind % kFallClasses)].speed;
      // A quarter of a second later, seen from elsewhere.
      const glm::dvec3 after = placeOf(eye + glm::dvec3(1.3, -0.4, 0.2), start + 0.25, kind, number);
      const glm::dvec3 moved = after - before - 0.25 * glm::dvec3(wind, -speed);
      EXPECT_LT(glm::length(moved), 1e-4);
    }
}

TEST(Drops, StandAsDenselyAsTheyFall) {
  Scene scene = rainy();
  const FrameParams view = frameParams(frameOf(scene.camera, 640, 360), 640, 360, 1, scene.quality, 0);
  double last = 0.0;
  for (const float rate : {1.0f, 10.0f, 100.0f}) {
    scene.precipitation.rate = rate;
    const DropLevels levels = dropLevels(scene.precipitation, view, 60.0f);
    const double each = kDropsPerCell / std::pow(static_cast<double>(levels.edge[0]), 3.0);
    EXPECT_NEAR(each / law::countAbove(law::rainIntercept(rate), law::rainSlope(rate), kLeastDrop), 1.0, 1e-3);
    EXPECT_GT(each, last) << "more rain, more drops";
    last = each;
  }
  scene.camera.fov = 0.02f;
  scene.precipitation.particles = 1000000;
  const FrameParams narrow = frameParams(frameOf(scene.camera, 640, 360), 640, 360, 1, scene.quality, 0);
  const DropLevels far = dropLevels(scene.precipitation, narrow, 60.0f);
  EXPECT_LT(far.reach[0], 41.0f * far.edge[0]) << "a telescope does not search for a million drops";
  for (const int particles : {2000, 200000}) {
    scene.precipitation.particles = particles;
    const DropLevels levels = dropLevels(scene.precipitation, view, 60.0f);
    const auto cells =
        dropCells(levels, view, glm::vec3(0, 0, 1), 60.0f, static_cast<std::size_t>(particles) / kDropsPerCell);
    const double drawn = static_cast<double>(cells.size()) * kDropsPerCell;
    EXPECT_LE(drawn, particles);
    EXPECT_GT(drawn, 0.6 * particles);
  }
}

TEST(Drops, FallOnlyWhereItRains) {
  Stage stage(kWidth, kHeight);
  Scene scene = rainy(), bare = scene;
  bare.precipitation.particles = 0;
  const Image wet = stage.draw(scene), haze = stage.draw(bare);
  EXPECT_GT(difference(wet, haze), 1e-4) << "the test sees drops where there are any";
  scene.layers[0].weather.coverage = bare.layers[0].weather.coverage = 0.0f;
  EXPECT_EQ(difference(stage.draw(scene), stage.draw(bare)), 0.0) << "no cloud, no rain";
  scene = bare = rainy();
  scene.precipitation.rate = bare.precipitation.rate = 0.0f;
  bare.precipitation.particles = 0;
  EXPECT_EQ(difference(stage.draw(scene), stage.draw(bare)), 0.0);
  EXPECT_EQ(stage.sky->lastCost().particles, 0);
}

TEST(Drops, AreHiddenByWhatStandsBeforeThem) {
  Stage stage(kWidth, kHeight);
  const Scene scene = rainy();
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);  // reversed depth: near plane at 0.1 m over distance
  frame.background = Background::host;
  const auto drawn = [&](float distance) {
    const gl::Texture depth =
        stage.depth(std::vector<float>(static_cast<std::size_t>(kWidth) * kHeight, 0.1f / distance));
    frame.depthTexture = depth.id();
    View view;
    return stage.draw(view, frame, glm::vec4(1.0f));
  };
  const Image wall = drawn(0.11f), open = drawn(500.0f);
  for (std::size_t i = 0; i < wall.pixels.size(); i += 4) ASSERT_NEAR(wall.pixels[i], 1.0f, 2e-3f);
  EXPECT_GT(difference(open, wall), 0.01);
}

TEST(Drops, TakeFromLightWhatTheirHazeWouldTake) {
  Stage stage(2 * kWidth, 2 * kHeight);
  Scene scene = rainy();
  scene.precipitation.shutter = 0.05f;
  scene.layers[0].cloud.extinction = 0.0f;
  const Image drops = through(stage, scene);
  scene.precipitation.particles = 0;
  const Image haze = through(stage, scene);
  const double taken = 1.0 - meanOf(haze);
  EXPECT_GT(taken, 0.05);
  EXPECT_NEAR(meanOf(drops), meanOf(haze), 0.1 * taken);
}

TEST(Drops, DependOnNothingBeforeThem) {
  Stage stage(kWidth, kHeight);
  const Scene scene = rainy();
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  View first, second;
  frame.time = 7.0;
  const Image fresh = stage.draw(first, frame);
  for (const double time : {1.0, 3.0}) {
    frame.time = time;
    frame.position.x = 40.0 * time;
    stage.draw(second, frame);
  }
  frame.time = 7.0;
  frame.position.x = 0.0;
  second.reset();
  EXPECT_EQ(difference(stage.draw(second, frame), fresh), 0.0);
  frame.time = 7.1;
  EXPECT_GT(difference(stage.draw(second, frame), fresh), 1e-4) << "they do move";
}

TEST(Drops, AreDrawnInEveryKindOfContextAndMapping) {
  for (const gl::ContextKind kind : {gl::ContextKind::desktop, gl::ContextKind::es})
    for (const Projection projection : {Projection::perspective, Projection::equirectangular}) {
      Stage stage(kWidth, kHeight, kind);
      Scene scene = rainy(), bare = scene;
      scene.camera.projection = bare.camera.projection = projection;
      bare.precipitation.particles = 0;
      const Image wet = stage.draw(scene);
      EXPECT_GT(difference(wet, stage.draw(bare)), 1e-4);
      EXPECT_TRUE(statistics(wet).finite);
    }
}

TEST(RainShafts, LetThroughWhatThePathTracerLetsThrough) {
  Scene scene = rainy();
  scene.precipitation.particles = 0;
  scene.precipitation.evaporation = 4.0f;
  scene.wind.speed = 12.0f;
  scene.layers[0].cloud.extinction = 0.0f;
  scene.camera.position.z = 300.0;
  scene.camera.pitch = 0.35f;
  for (const float temperature : {15.0f, 3.0f}) {
    SCOPED_TRACE(temperature);
    scene.precipitation.temperature = temperature;
    if (temperature < 10.0f) scene.precipitation.rate = 0.6f, scene.precipitation.evaporation = 0.05f;
    Stage stage(kWidth, kHeight);
    const double drawn = meanOf(through(stage, scene));
    trace::PathTracer tracer(scene, {},
                             {.width = kWidth,
                              .height = kHeight,
                              .samples = 24,
                              .scatterings = 1,
                              .clouds = {.weather = {.texels = 512}, .cells = 32, .cellLayers = 16}});
    ASSERT_TRUE(tracer.run({}));
    EXPECT_EQ(tracer.statistics().overBound, 0u);
    const trace::TraceLayers layers = tracer.layers();
    double traced = 0.0;
    for (const float t : layers.transmittance.pixels) traced += t / layers.transmittance.pixels.size();
    EXPECT_LT(drawn, 0.9);
    EXPECT_GT(drawn, 0.05);
    EXPECT_NEAR(drawn, traced, 0.03);
  }
}

TEST(RainShafts, AreTheSameInCppAndGlsl) {
  Scene scene = rainy();
  scene.precipitation.particles = 0;
  scene.quality.lightVolume = false;
  scene.layers[0].weather.coverage = 0.7f;
  Stage stage(32, 18);
  EXPECT_GT(displayedPsnr(stage.draw(scene), marchOnCpu(scene, stage.frame(scene))), 45.0);
}

// Curtains that broken clouds light and shade, against the sun: samples of each ray's own showed as grain.
TEST(RainShafts, DoNotDependOnTheJitter) {
  Scene scene = rainy();
  scene.precipitation.particles = 0;
  scene.quality.lightVolume = true;
  scene.layers[0].weather.coverage = 0.6f;
  scene.layers[0].cloud.extinction = 1e-6f;
  scene.sun.elevation = 0.5f;
  scene.sun.azimuth = scene.camera.heading;
  scene.camera.pitch = 0.05f;
  Stage stage(48, 27);
  const Image even = stage.draw(scene);
  scene.quality.jitter = true;
  const Image jittered = stage.draw(scene);
  scene.precipitation.rate = 0.0f;
  const Image dry = stage.draw(scene);
  const double mean = statistics(even).mean;
  EXPECT_GT(difference(even, dry), 0.1 * mean);
  EXPECT_LT(difference(even, jittered), 5e-3 * mean);  // half floats
}

// Coarse histories of a flight toward rain that the sun shines through: what is old may be held to the range of what is
// new, but not to another hue.
TEST(RainShafts, TurnNoCloudPinkInFlight) {
  Scene scene = rainy();
  scene.precipitation.particles = 0;
  scene.quality = qualityPreset(QualityPreset::high);
  scene.quality.historyScale = 4;
  scene.layers[0].weather.coverage = 0.5f;
  scene.sun.elevation = 0.5f;
  scene.camera.pitch = 0.1f;
  makeSmall(scene);
  Stage stage(160, 90);
  stage.sky->setScene(scene);
  double pink = 0.0;
  for (int i = 0; i < 48; ++i) {
    scene.camera.position.y = 1.2 * i;
    const Image shown = displayed(stage.draw(stage.view, stage.frame(scene)));
    for (int y = 0; y < shown.height; ++y)
      for (int x = 0; x < shown.width; ++x) {
        const float* c = shown.at(x, y);
        pink = std::max(pink, double(std::min(c[0], c[2]) - c[1]));
      }
  }
  std::printf("pink: %.4f\n", pink);
  EXPECT_LT(pink, 0.02);
}

TEST(RainMap, TellsTheHostWhatFallsAndWhereItIsWet) {
  Stage stage(kWidth, kHeight);
  Scene scene = rainy();
  stage.draw(scene);
  Outputs outputs = stage.sky->outputs(stage.view);
  ASSERT_NE(outputs.rain.name, 0u);
  std::vector<float> texels(static_cast<std::size_t>(outputs.rain.width) * outputs.rain.height * 2);
  stage.gl.BindTexture(GL_TEXTURE_2D, outputs.rain.name);
  ASSERT_NE(stage.gl.GetTexImage, nullptr);
  stage.gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RG, GL_FLOAT, texels.data());
  stage.gl.BindTexture(GL_TEXTURE_2D, 0);
  float most = 0.0f, wettest = 0.0f;
  for (std::size_t i = 0; i < texels.size(); i += 2) {
    ASSERT_GE(texels[i], 0.0f);
    most = std::max(most, texels[i]);
    wettest = std::max(wettest, texels[i + 1]);
  }
  EXPECT_GT(most, 0.2f * scene.precipitation.rate);
  EXPECT_LE(most, scene.precipitation.rate);
  EXPECT_GT(wettest, 0.9f);
  EXPECT_LE(wettest, 1.0f);
  EXPECT_EQ(outputs.snow, 0.0f);
  scene.precipitation.rate = 0.0f;
  stage.draw(scene);
  EXPECT_EQ(stage.sky->outputs(stage.view).rain.name, 0u);
}

}  // namespace
}  // namespace welkin::realtime::test
