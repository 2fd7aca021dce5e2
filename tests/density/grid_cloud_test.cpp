// Volumes stand where the sky file puts them and mean what it says.
#include "welkin/density/grid_cloud.hpp"

#include <gtest/gtest.h>

#include "welkin/density/field.hpp"

namespace welkin {
namespace {

constexpr float kRight = 1.57079633f;

// One voxel of 10 units with the value 2, its centre at (105, 205, 305) of the file; a margin of zeros round it.
std::shared_ptr<const VoxelGrid> voxel() {
  auto grid = std::make_shared<VoxelGrid>(glm::ivec3(3), glm::dvec3(90.0, 190.0, 290.0), glm::dvec3(10.0));
  grid->set({1, 1, 1}, 2.0f);
  return grid;
}

TEST(GridCloud, StandsWhereItIsPut) {
  const glm::dvec3 centre(105.0, 205.0, 305.0);
  const auto found = [&](const GridCloud& cloud, const glm::dvec3& at) {
    return placed(cloud, voxel()).at(at) / placed(cloud, voxel()).extinction;
  };
  EXPECT_NEAR(found({}, centre), 2.0, 1e-5);
  EXPECT_NEAR(found({.position = {1000.0, 0.0, -5.0}}, centre + glm::dvec3(1000.0, 0.0, -5.0)), 2.0, 1e-5);
  EXPECT_NEAR(found({.scale = 0.01f}, 0.01 * centre), 2.0, 1e-4);
  // A quarter turn about up takes east to north; about east, north to up.
  EXPECT_NEAR(found({.rotation = {0.0f, 0.0f, kRight}}, {-205.0, 105.0, 305.0}), 2.0, 1e-4);
  EXPECT_NEAR(found({.rotation = {kRight, 0.0f, 0.0f}}, {105.0, -305.0, 205.0}), 2.0, 1e-4);
  // Both: first about east, then about up.
  EXPECT_NEAR(found({.rotation = {kRight, 0.0f, kRight}}, {305.0, 105.0, 205.0}), 2.0, 1e-4);
  EXPECT_NEAR(found({.up = GridUp::y}, {105.0, -305.0, 205.0}), 2.0, 1e-5);
  const WorldBox box = boundsOf(placed({.up = GridUp::y}, voxel()));
  EXPECT_NEAR(box.low.y, -320.0, 1e-9);
  EXPECT_NEAR(box.high.z, 220.0, 1e-9);
}

TEST(GridCloud, ValuesMeanWhatTheSkyFileSays) {
  const auto one = [](const GridCloud& cloud, double stated) {
    return placed(cloud, voxel(), glm::dmat4(1.0), stated).extinction;
  };
  EXPECT_FLOAT_EQ(one({.extinction = 0.2f}, 0.0), 0.2f);
  EXPECT_FLOAT_EQ(one({.extinction = 0.2f}, 0.05), 0.05f);
  EXPECT_FLOAT_EQ(one({.values = GridValues::normalized, .extinction = 0.2f}, 0.05), 0.2f);
  EXPECT_FLOAT_EQ(one({.values = GridValues::extinction, .extinction = 0.2f}, 0.05), 1.0f);
  EXPECT_FLOAT_EQ(one({.values = GridValues::extinction, .density = 3.0f}, 0.0), 3.0f);
  // 1 g/m^3 of droplets of 10 um radius: 3 / (2 x 10 um x 1 t/m^3) = 0.15 1/m.
  EXPECT_FLOAT_EQ(one({.values = GridValues::water, .dropletDiameter = 20.0f}, 0.0), 0.15f);
}

TEST(GridCloud, AddsToTheFieldOfTheLayers) {
  const PlacedGrid grids[] = {placed({.values = GridValues::extinction}, voxel()),
                              placed({.position = {0.0, 0.0, 4.0}, .values = GridValues::extinction}, voxel())};
  const DensityField field({.grids = grids});
  EXPECT_NEAR(field.extinction({105.0, 205.0, 305.0}), 2.0f + 2.0f * 0.6f, 1e-5f);
  EXPECT_EQ(field.extinction({105.0, 205.0, 500.0}), 0.0f);
  EXPECT_NEAR(field.opticalDepth({105.0, 205.0}, 200.0, 400.0, 0.5), 2.0 * 2.0 * 10.0, 0.01);
}

}  // namespace
}  // namespace welkin
