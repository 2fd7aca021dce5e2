// The light volume against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/march_cpu.hpp"
#include "welkin/atmosphere/params.hpp"
#include "welkin/density/grid_cloud.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::realtime::test {
namespace {

constexpr double kThickness = 1200.0, kSlabWidth = 40000.0;

// A slab of droplets in a vacuum over ground of that albedo, the sun at 60 degrees; with `low` a speck of cloud far
// below and aside, so that most of the volume's height is clear.
struct Slab {
  Scene scene = plainScene(LayerShape::profile);
  CustomTextures textures;

  Slab(double opticalDepth, double albedo, bool low) {
    scene.layers.clear();
    scene.quality.earlyExit = false;
    scene.atmosphere.rayleigh = scene.atmosphere.mie = scene.atmosphere.ozone = scene.atmosphere.haze = 0.0f;
    scene.ground.albedo = glm::vec3(static_cast<float>(albedo));
    scene.sun.elevation = 1.0471976f;
    scene.camera.heading = 2.5f;
    const auto add = [&](VoxelGrid voxels, float sigma) {
      scene.grids.emplace_back().file = "slab.vdb";  // its voxels are handed over
      for (int z = 0; z < voxels.dims().z; ++z)
        for (int y = 0; y < voxels.dims().y; ++y)
          for (int x = 0; x < voxels.dims().x; ++x) voxels.set({x, y, z}, sigma);
      textures.grids.push_back(
          placed({.values = GridValues::extinction}, std::make_shared<const VoxelGrid>(std::move(voxels))));
    };
    add({{64, 64, 24},
         {-0.5 * kSlabWidth, -0.5 * kSlabWidth, 1000.0},
         {kSlabWidth / 64, kSlabWidth / 64, kThickness / 24}},
        static_cast<float>(opticalDepth / kThickness));
    if (low) add({{4, 4, 4}, {0.4 * kSlabWidth, 0.4 * kSlabWidth, 200.0}, {10.0, 10.0, 10.0}}, 1e-3f);
  }

  // What the camera below it sees.
  double radiance() const {
    Stage stage(16, 16);
    stage.sky->setScene(scene, textures);
    Frame frame = stage.frame(scene);
    frame.background = scene.camera.pitch > 0.0f ? Background::host : Background::skyAndGround;
    return statistics(stage.draw(stage.view, frame)).mean;
  }
};

double radianceBelow(double opticalDepth, double albedo, double pitch, bool low) {
  Slab slab(opticalDepth, albedo, low);
  slab.scene.camera.pitch = static_cast<float>(pitch);
  return slab.radiance();
}

// Share of the light that a conservative slab lets through, the direct beam of similarity theory counted in:
// Eddington's approximation with (1 - g) tau, g = .86 (Joseph, Wiscombe and Weinman 1976 with albedo 1).
double transmittance(double opticalDepth, double cosine) {
  const double t = 0.14 * opticalDepth;
  return (2.0 / 3.0 + cosine + (2.0 / 3.0 - cosine) * std::exp(-t / cosine)) / (4.0 / 3.0 + t);
}

// Light from below a thick slab: in the P1 approximation the radiance at the nadir is that of the fluence a transport
// mean free path inside, 0.5 + 0.75 g of the flux over pi there; march_params.cpp looks 4/3 as deep, since clouds are
// thinner than their greatest extinction. Cells bring .95 times that at an optical depth
// of 30 and 1.4 times at 90; light that fell off exponentially would be 1e-3 of it.
TEST(LightVolume, ASlabLetsThroughWhatTwoStreamTheorySays) {
  const double cosine = std::sin(1.0471976);
  for (const double opticalDepth : {30.0, 90.0}) {
    const double flux = 128.0 * cosine * transmittance(opticalDepth, cosine);
    const double expected = flux / 3.14159265 * (0.5 + 0.75 * 0.86 * 4.0 / 3.0);
    const double found = radianceBelow(opticalDepth, 0.0, 1.5, false);
    std::printf("tau %g: %.3f kcd/m^2, theory %.3f\n", opticalDepth, found, expected);
    EXPECT_GT(found, 0.9 * expected);
    EXPECT_LT(found, 1.45 * expected);
  }
}

// The ground sends on its share of what the slab lets through, with what goes to and fro between both; clear cells of
// the volume between slab and ground once gave it no sunlight at all.
TEST(LightVolume, GroundUnderASlabIsLitByWhatItLetsThrough) {
  constexpr double kDepth = 30.0, kAlbedo = 0.3;
  const double cosine = std::sin(1.0471976), reflected = 1.0 - 1.0 / (1.0 + 0.75 * 0.14 * kDepth);
  const double flux = 128.0 * cosine * transmittance(kDepth, cosine) / (1.0 - kAlbedo * reflected);
  const double expected = kAlbedo * flux / 3.14159265;
  const double found = radianceBelow(kDepth, kAlbedo, -1.0, true);
  std::printf("ground %.3f kcd/m^2, theory %.3f\n", found, expected);
  EXPECT_NEAR(found, expected, 0.15 * expected);  // cells of 1.8 km
}

// Of what a thin cloud takes out of a ray, a seventh has lost its direction: taken for all of it, and with two lobes in
// place of the droplets' phase function (a sky without layers had no droplets), thin clouds away from the sun were 2.5
// to 4.5 times as bright as traced.
TEST(LightVolume, ThinCloudsSendAsMuchAsThePathTracerSays) {
  for (const double opticalDepth : {0.25, 0.5, 1.0}) {
    Slab slab(opticalDepth, 0.0, false);
    slab.scene.camera.heading = slab.scene.sun.azimuth + 3.14159265f;
    slab.scene.camera.pitch = 0.6f;
    slab.scene.camera.fov = 0.4f;
    const double drawn = slab.radiance();
    trace::PathTracer tracer(slab.scene, {.grids = slab.textures.grids}, {.width = 16, .height = 16, .samples = 256});
    ASSERT_TRUE(tracer.run({}));
    const double traced = statistics(tracer.layers().radiance).mean;
    std::printf("tau %g: %.3f kcd/m^2, traced %.3f\n", opticalDepth, drawn, traced);
    EXPECT_NEAR(drawn, traced, 0.3 * traced);  // the thinner, the more: 1.2 to .92
  }
}

// Ground in the shade of the default sky's cumulus sees their sunlit sides and the sky between them: it is a fifth as
// bright as in the sun. The mean of wide squares over its head alone made it .7 of what the path tracer finds, even
// with the sky's mean radiance, which makes clear ground under a low sun half as bright again as traced.
TEST(LightVolume, GroundInTheShadeOfACloudSeesTheOthers) {
  Scene scene;
  scene.camera.position.z = 300.0;
  scene.camera.heading = 6.16f;
  scene.camera.pitch = -0.35f;
  scene.camera.fov = 0.05f;
  Stage stage(16, 9);
  const double drawn = statistics(stage.draw(scene, 17)).mean;
  trace::PathTracer tracer(scene, {}, {.width = 16, .height = 9, .samples = 256});
  ASSERT_TRUE(tracer.run({}));
  const double traced = statistics(tracer.layers().radiance).mean;
  std::printf("shaded ground %.3f kcd/m^2, traced %.3f\n", drawn, traced);
  EXPECT_NEAR(drawn, traced, 0.25 * traced);  // .79: what the sunlit air below the clouds sends is not counted
}

// A small sky of cumulus whose picture needs no history.
Scene litCumulus() {
  Scene scene = plainScene(LayerShape::profile);
  scene.quality.lightFrames = 8;
  scene.quality.reprojection = false;
  scene.camera.pitch = 0.35f;
  return scene;
}

bool same(const Image& a, const Image& b) { return a.pixels == b.pixels; }

// Frames until the picture is `end`; 0 when it never is.
int framesUntil(Stage& stage, const Frame& frame, const Image& end, int most) {
  for (int i = 1; i <= most; ++i)
    if (same(stage.draw(stage.view, frame), end)) return i;
  return 0;
}

// Thinner clouds, the sun elsewhere: the light changes over several frames, and ends as if it had been made at once.
TEST(LightVolume, ChangesByAndByAndEndsWhereItWouldAtOnce) {
  Stage stage(48, 27);
  const Scene before = litCumulus();
  const Frame frame = stage.frame(before);
  Scene thinner = before, turned = before;
  thinner.layers[0].cloud.extinction *= 0.3f;
  turned.sun.azimuth += 1.0f;
  for (const Scene& after : {thinner, turned}) {
    stage.draw(after);
    const Image end = stage.draw(after);
    stage.draw(before);
    stage.sky->setScene(after);
    const int frames = framesUntil(stage, frame, end, 60);
    std::printf("%d frames\n", frames);
    EXPECT_GT(frames, 8);  // three levels
    EXPECT_GT(framesUntil(stage, frame, end, 1), 0) << "and stays there";
    // A cut wants all of it in the first frame; so does a quality that says so.
    stage.draw(before);
    stage.sky->setScene(after);
    stage.view.reset();
    EXPECT_EQ(framesUntil(stage, frame, end, 1), 1);
    Scene atOnce = after;
    atOnce.quality.lightFrames = 1;
    stage.draw(before);
    stage.sky->setScene(atOnce);
    EXPECT_EQ(framesUntil(stage, frame, end, 1), 1);
  }
}

// A view that does not wait: coarse light first, the same as at once in the end, and it says when.
TEST(LightVolume, BeginsCoarseWhereItMayNotWait) {
  Stage stage(48, 27), waits(48, 27);
  const Scene scene = litCumulus();
  const Image end = waits.draw(scene);
  EXPECT_TRUE(waits.sky->outputs(waits.view).complete);
  Frame frame = stage.frame(scene);
  frame.waitForLight = false;
  stage.sky->setScene(scene);
  const Image first = stage.draw(stage.view, frame);
  EXPECT_FALSE(stage.sky->outputs(stage.view).complete);
  EXPECT_FALSE(same(first, end));
  // Clouds in a light of their own kind: measured 24.5 dB; without any they are at 17.
  EXPECT_GT(displayedPsnr(first, end), 23.0);
  int frames = 1;
  Image last = first;
  for (; !stage.sky->outputs(stage.view).complete && frames < 60; ++frames) last = stage.draw(stage.view, frame);
  std::printf("%d frames, the first at %.1f dB\n", frames, displayedPsnr(first, end));
  EXPECT_GT(frames, 8);
  EXPECT_LT(frames, 60);
  EXPECT_TRUE(same(last, end));
}

// Pixels of two lights side by side would show as a pattern: the first round begins anew when light comes into it.
TEST(LightVolume, NoPictureMixesTwoLightsInItsFirstRound) {
  Stage stage(48, 27), waits(48, 27);
  Scene scene = litCumulus();
  scene.quality.reprojection = true;
  scene.quality.interleave = 4;
  scene.quality.lightFrames = 2;
  constexpr int kRound = 16;
  Frame frame = stage.frame(scene);
  waits.sky->setScene(scene);
  Image end;
  for (int i = 0; i < kRound; ++i) end = waits.draw(waits.view, frame);
  frame.waitForLight = false;
  stage.sky->setScene(scene);
  int frames = 0;
  do stage.draw(stage.view, frame);
  while (!stage.sky->outputs(stage.view).complete && ++frames < 60);
  Image last;
  for (int i = 1; i < kRound; ++i) last = stage.draw(stage.view, frame);
  std::printf("%.1f dB after %d frames\n", displayedPsnr(last, end), frames);
  EXPECT_TRUE(same(last, end));
}

// Sliders that move all the time: every level gets its turn, so that the light is never older than a round.
TEST(LightVolume, KeepsUpWithASunThatNeverStands) {
  Stage stage(48, 27);
  Scene scene = litCumulus();
  stage.draw(scene);
  const double start = scene.sun.azimuth;
  Image last;
  for (int i = 0; i < 90; ++i) {
    scene.sun.azimuth = static_cast<float>(start + 0.01 * i);
    stage.sky->setScene(scene);
    last = stage.draw(stage.view, stage.frame(scene));
  }
  const Image now = stage.draw(scene);
  scene.sun.azimuth = static_cast<float>(start);
  const Image then = stage.draw(scene);
  const double lag = displayedPsnr(last, now), change = displayedPsnr(then, now);
  std::printf("%.1f dB off, the sun's way is %.1f dB\n", lag, change);
  EXPECT_GT(lag, change + 6.0);
}

// Clouds that change all the time: weather and light come after, and stand still soon after them.
TEST(LightVolume, KeepsUpWithCloudsThatNeverStand) {
  Stage stage(48, 27);
  Scene scene = litCumulus();
  const Image then = stage.draw(scene);
  const float start = scene.layers[0].weather.coverage;
  Image last;
  for (int i = 1; i <= 60; ++i) {
    scene.layers[0].weather.coverage = start + 0.002f * static_cast<float>(i);
    stage.sky->setScene(scene);
    last = stage.draw(stage.view, stage.frame(scene));
  }
  const Frame frame = stage.frame(scene);
  scene.quality.lightFrames = 1;
  Stage other(48, 27);
  const Image now = other.draw(scene);
  const double lag = displayedPsnr(last, now), change = displayedPsnr(then, now);
  std::printf("%.1f dB off, the whole change is %.1f dB\n", lag, change);
  EXPECT_GT(lag, change + 3.0);
  EXPECT_GT(framesUntil(stage, frame, now, 90), 0);
}

double lightMilliseconds(Renderer& sky) {
  for (const PassCost& pass : sky.lastCost().passes)
    if (pass.name == "light volume") return pass.milliseconds;
  return 0.0;
}

// Eyes 20 km apart, each with light of its own; eyes 500 m apart share it.
TEST(LightVolume, EveryEyeKeepsItsOwnAndNeighboursShare) {
  Stage stage(48, 27);
  Scene scene = litCumulus();
  stage.sky->setScene(scene);
  View near, beside, far;
  Frame here = stage.frame(scene), there = here, next = here;
  next.position.x += 500.0;
  there.position.x += 20000.0;
  double first = 0.0, later = 0.0;
  unsigned names[3] = {};
  Image pictures[3];
  View* const views[] = {&near, &beside, &far};
  const Frame* const frames[] = {&here, &next, &there};
  for (int turn = 0; turn < 3; ++turn)
    for (std::size_t i = 0; i < 3; ++i) {
      const Image picture = stage.draw(*views[i], *frames[i]);
      (turn == 0 ? first : later) += lightMilliseconds(*stage.sky);
      const unsigned name = stage.sky->outputs(*views[i]).sunDepth.name;
      if (turn > 0) {
        EXPECT_EQ(name, names[i]);
        EXPECT_TRUE(same(picture, pictures[i])) << turn << ", " << i;
      }
      names[i] = name;
      pictures[i] = picture;
    }
  EXPECT_EQ(names[0], names[1]);
  EXPECT_NE(names[0], names[2]);
  std::printf("light volume: %.1f ms in the first turn, %.1f in two more\n", first, later);
  EXPECT_LT(later, 0.1 * first + 1.0);
  // As a renderer that has only that eye.
  Stage other(48, 27);
  other.sky->setScene(scene);
  EXPECT_TRUE(same(other.draw(other.view, there), pictures[2]));
}

// An eye that flies off takes its own along, and one that has been left alone flies on with what there was.
TEST(LightVolume, EyesThatPartStayTrue) {
  Stage stage(48, 27);
  Scene scene = litCumulus();
  stage.sky->setScene(scene);
  View still, moving;
  const Frame here = stage.frame(scene);
  Frame away = here;
  const Image before = stage.draw(still, here);
  Image after;
  for (int i = 0; i < 30; ++i) {
    away.position.y = here.position.y + 200.0 * i;
    stage.draw(moving, away);
    after = stage.draw(still, here);
  }
  EXPECT_TRUE(same(before, after));
}

}  // namespace
}  // namespace welkin::realtime::test
