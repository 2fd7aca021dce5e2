// Baked voxels hold the field at their centres, turned and scaled as asked.
#include "welkin/density/voxel_bake.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/density/clear_air.hpp"

namespace welkin {
namespace {

DensityField smallField() {
  static const std::vector<Layer> layers = [] {
    std::vector<Layer> l(1);
    l[0].weather.coverage = 0.9f;
    l[0].cloud.thickness = 600.0f;
    return l;
  }();
  NoiseSettings noise;
  noise.profile.baseSize = noise.profile.detailSize = 32;
  noise.profile.warpSize = 16;
  return DensityField({.layers = layers, .noise = noise});
}

TEST(VoxelBake, HoldsTheFieldAtTheCentres) {
  const DensityField field = smallField();
  // 70 voxels are more than one block of work.
  const VoxelBox box{{70, 33, 20}, {-700.0, 200.0, 1200.0}, glm::dvec3(25.0, 30.0, 35.0)};
  const VoxelGrid grid = bakeVoxels(field, box, {.scale = 4.0f});
  int cloud = 0;
  for (int n = 0; n < 2000; ++n) {
    const glm::ivec3 i(n * 31 % 70, n * 17 % 33, n * 7 % 20);
    const glm::dvec3 centre = box.origin + (glm::dvec3(i) + 0.5) * box.voxel;
    // Anchors differ, floats of 1 km from one are 6e-5 m apart: 2e-6 of an edge of 30 m.
    const float expected = 4.0f * field.extinction(centre);
    ASSERT_NEAR(grid.at(i), expected, 1e-4f * 0.4f);
    cloud += expected > 0.0f;
  }
  EXPECT_GT(cloud, 50);
}

// Bricks that are passed over hold nothing, and most of what is clear is passed over.
TEST(VoxelBake, PassesOverClearAirOnly) {
  for (const HeroSpecies species : {HeroSpecies::mediocris, HeroSpecies::incus, HeroSpecies::cirrus_uncinus}) {
    Hero hero = heroPreset(species);
    hero.cloud.position = {3.0e5, -2.0e5, 1500.0};
    hero.cloud.heading = 0.6f;
    const DensityField field({.seed = 3, .heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    const glm::dvec3 size = body.highest() - body.lowest();
    const VoxelBox box{{66, 50, 59}, body.lowest() - 0.02 * size, 1.04 * size / glm::dvec3(66.0, 50.0, 59.0)};
    const VoxelGrid grid = bakeVoxels(field, box, {});
    std::vector<glm::dvec3> centres;
    for (int z = 0; z < box.dims.z; ++z)
      for (int y = 0; y < box.dims.y; ++y)
        for (int x = 0; x < box.dims.x; ++x) centres.push_back(box.origin + (glm::dvec3(x, y, z) + 0.5) * box.voxel);
    const std::vector<float> expected = field.extinction(centres);
    double sum = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const glm::ivec3 at(i % 66, i / 66 % 50, i / (66 * 50));
      sum += expected[i];
      difference += std::abs(grid.at(at) - expected[i]);
    }
    EXPECT_GT(sum, 1.0);
    EXPECT_LT(difference / sum, 1e-4);  // anchors differ
    const ClearAir clear(field);
    EXPECT_FALSE(clear.holds(body.lowest(), body.highest()));
    EXPECT_TRUE(clear.holds(body.highest() + 1.0, body.highest() + 100.0));
  }
}

TEST(VoxelBake, KeepsTheOpticalDepthOfTheSky) {
  const DensityField field = smallField();
  const auto meanDepth = [&](int voxels) {
    const double size = 1280.0 / voxels;
    const VoxelGrid grid = bakeVoxels(field, {glm::ivec3(voxels), {0.0, 0.0, 1000.0}, glm::dvec3(size)}, {});
    double sum = 0.0;
    for (const float v : grid.values()) sum += v;
    return sum * size / (voxels * voxels);
  };
  const double fine = meanDepth(128), coarse = meanDepth(32);
  EXPECT_GT(fine, 1.0);
  EXPECT_NEAR(coarse / fine, 1.0, 0.03);  // measured: 2 %; detail filtered to 40 m would lose 12 %
}

TEST(VoxelBake, AsksWhereItIsTold) {
  const DensityField field = smallField();
  const VoxelBox plain{{24, 16, 32}, {320.0, 480.0, 1200.0}, glm::dvec3(20.0)};
  const VoxelGrid upright = bakeVoxels(field, plain, {});
  // The same box lying on its side: y up, in centimetres.
  const VoxelBox turned{{24, 32, 16}, {32000.0, 120000.0, -80000.0}, glm::dvec3(2000.0)};
  const VoxelGrid lying =
      bakeVoxels(field, turned, {.cloudSpace = [](const glm::dvec3& p) { return 0.01 * glm::dvec3(p.x, -p.z, p.y); }});
  EXPECT_GT(upright.maximum(), 0.01f);
  for (int z = 0; z < 32; ++z)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 24; ++x) ASSERT_NEAR(lying.at({x, z, 15 - y}), upright.at({x, y, z}), 1e-5f);
}

}  // namespace
}  // namespace welkin
