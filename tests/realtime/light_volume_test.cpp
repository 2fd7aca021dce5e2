// The light volume against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/realtime/march_cpu.hpp"
#include "welkin/atmosphere/params.hpp"
#include "welkin/density/grid_cloud.hpp"

namespace welkin::realtime::test {
namespace {

constexpr double kThickness = 1200.0, kWidth = 40000.0;

// A slab of droplets in a vacuum over black ground, seen from below; the sun at 60 degrees.
double radianceBelow(double opticalDepth) {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers.clear();
  scene.quality.earlyExit = false;
  scene.atmosphere.rayleigh = scene.atmosphere.mie = scene.atmosphere.ozone = scene.atmosphere.haze = 0.0f;
  scene.ground.albedo = glm::vec3(0.0f);
  scene.sun.elevation = 1.0471976f;
  scene.camera.pitch = 1.5f;
  scene.camera.heading = 2.5f;
  scene.grids.resize(1);
  scene.grids[0].file = "slab.vdb";  // its voxels are handed over
  VoxelGrid voxels({64, 64, 24}, {-0.5 * kWidth, -0.5 * kWidth, 1000.0}, {kWidth / 64, kWidth / 64, kThickness / 24});
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) voxels.set({x, y, z}, static_cast<float>(opticalDepth / kThickness));
  CustomTextures textures;
  textures.grids = {placed({.values = GridValues::extinction}, std::make_shared<const VoxelGrid>(std::move(voxels)))};
  Stage stage(16, 16);
  stage.sky->setScene(scene, textures);
  Frame frame = stage.frame(scene);
  frame.background = Background::host;
  return statistics(stage.draw(stage.view, frame)).mean;
}

// Share of the light that a conservative slab lets through, the direct beam of similarity theory counted in:
// Eddington's approximation with (1 - g) tau, g = .86 (Joseph, Wiscombe and Weinman 1976 with albedo 1).
double transmittance(double opticalDepth, double cosine) {
  const double t = 0.14 * opticalDepth;
  return (2.0 / 3.0 + cosine + (2.0 / 3.0 - cosine) * std::exp(-t / cosine)) / (4.0 / 3.0 + t);
}

// Light from below a thick slab: in the P1 approximation the radiance at the nadir is that of the fluence a transport
// mean free path inside, 0.5 + 0.75 g of the flux over pi there; march_params.cpp looks 4/3 as deep, since clouds are
// thinner than their greatest extinction. Cells and the share of the beam that was fitted to cumulus bring 1.2 times
// that at an optical depth of 30 and 1.4 times at 90; light that fell off exponentially would be 1e-3 of it.
TEST(LightVolume, ASlabLetsThroughWhatTwoStreamTheorySays) {
  const double cosine = std::sin(1.0471976);
  for (const double opticalDepth : {30.0, 90.0}) {
    const double flux = 128.0 * cosine * transmittance(opticalDepth, cosine);
    const double expected = flux / 3.14159265 * (0.5 + 0.75 * 0.86 * 4.0 / 3.0);
    const double found = radianceBelow(opticalDepth);
    std::printf("tau %g: %.3f kcd/m^2, theory %.3f\n", opticalDepth, found, expected);
    EXPECT_GT(found, 0.9 * expected);
    EXPECT_LT(found, 1.45 * expected);
  }
}

}  // namespace
}  // namespace welkin::realtime::test
