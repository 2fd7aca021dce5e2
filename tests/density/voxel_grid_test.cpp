// A voxel grid keeps what it is given, interpolates trilinear fields exactly, and bounds what it interpolates.
#include "welkin/density/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

constexpr glm::ivec3 kDims(21, 9, 17);  // no axis a multiple of a brick
constexpr glm::dvec3 kOrigin(-1e5, 300.0, 700.0), kVoxel(10.0, 20.0, 5.0);

// Voxels by a hash, and one whose neighbours are in an empty brick.
VoxelGrid speckled() {
  VoxelGrid grid(kDims, kOrigin, kVoxel);
  for (int n = 0; n < 300; ++n) {
    const unsigned hash = 2654435761u * static_cast<unsigned>(n + 1);
    grid.set({int(hash >> 8) % 11, int(hash >> 16) % 9, int(hash >> 20) % 17}, float(hash % 97u) / 97.0f);
  }
  grid.set({15, 3, 3}, 0.5f);
  return grid;
}

glm::dvec3 pointIn(const VoxelGrid& grid, int n) {
  const auto unit = [&](double k) { return std::fmod(k * (n + 1), 1.0); };
  return grid.origin() + glm::dvec3(grid.dims()) * grid.voxel() *
                             glm::dvec3(unit(0.6180339887), unit(0.4142135624), unit(0.7320508076));
}

TEST(VoxelGrid, KeepsWhatItIsGiven) {
  VoxelGrid grid(kDims, kOrigin, kVoxel);
  EXPECT_EQ(grid.brickDims(), glm::ivec3(3, 2, 3));
  const auto value = [](int x, int y, int z) { return float(x + 100 * y + 10000 * z); };
  for (int z = 0; z < kDims.z; ++z)
    for (int y = 0; y < kDims.y; ++y)
      for (int x = 0; x < kDims.x; ++x) grid.set({x, y, z}, value(x, y, z));
  for (int z = 0; z < kDims.z; ++z)
    for (int y = 0; y < kDims.y; ++y)
      for (int x = 0; x < kDims.x; ++x) ASSERT_EQ(grid.at({x, y, z}), value(x, y, z));
  EXPECT_EQ(grid.maximum(), value(20, 8, 16));
  EXPECT_EQ(grid.at({-1, 0, 0}), 0.0f);
  EXPECT_EQ(grid.at({21, 0, 0}), 0.0f);
}

TEST(VoxelGrid, EmptyBricksTakeNoMemory) {
  VoxelGrid grid({800, 800, 800}, kOrigin, kVoxel);
  const std::size_t empty = grid.bytes();
  EXPECT_EQ(empty, 100 * 100 * 100 * sizeof(std::uint32_t) + 512 * sizeof(float));
  grid.set({400, 400, 400}, 0.0f);
  EXPECT_EQ(grid.bytes(), empty);
  grid.set({400, 400, 400}, 1.0f);
  EXPECT_EQ(grid.bytes(), empty + 512 * sizeof(float));
  grid.set({400, 400, 400}, 0.0f);
  EXPECT_EQ(grid.maximum(), 0.0f);
}

TEST(VoxelGrid, IndexAndValuesAreAsDescribed) {
  const VoxelGrid grid = speckled();
  const glm::ivec3 b = grid.brickDims();
  ASSERT_EQ(grid.brickIndex().size(), std::size_t(b.x * b.y * b.z));
  for (int i = 0; i < 512; ++i) ASSERT_EQ(grid.values()[std::size_t(i)], 0.0f);
  std::size_t emptyBricks = 0;
  for (const std::uint32_t brick : grid.brickIndex()) emptyBricks += brick == 0;
  EXPECT_GT(emptyBricks, 0u);
  for (int z = 0; z < kDims.z; ++z)
    for (int y = 0; y < kDims.y; ++y)
      for (int x = 0; x < kDims.x; ++x) {
        const std::uint32_t brick = grid.brickIndex()[std::size_t((z / 8 * b.y + y / 8) * b.x + x / 8)];
        ASSERT_EQ(grid.values()[brick * 512u + std::size_t((z % 8 * 8 + y % 8) * 8 + x % 8)], grid.at({x, y, z}));
      }
}

TEST(VoxelGrid, InterpolatesALinearFieldExactly) {
  VoxelGrid grid(kDims, kOrigin, kVoxel);
  const auto field = [](const glm::dvec3& p) { return 2e5 + p.x + 3.0 * p.y - 2.0 * p.z; };
  for (int z = 0; z < kDims.z; ++z)
    for (int y = 0; y < kDims.y; ++y)
      for (int x = 0; x < kDims.x; ++x)
        grid.set({x, y, z}, float(field(kOrigin + (glm::dvec3(x, y, z) + 0.5) * kVoxel)));
  const glm::dvec3 low = kOrigin + 0.5 * kVoxel, high = kOrigin + (glm::dvec3(kDims) - 0.5) * kVoxel;
  for (int n = 0; n < 1000; ++n) {
    // From the outermost centres outward the value stays.
    const glm::dvec3 p = pointIn(grid, n), q = glm::clamp(p, low, high);
    ASSERT_NEAR(grid.interpolate(p), field(q), 0.02);  // floats near 1e5 are .008 apart
  }
  EXPECT_EQ(grid.interpolate(kOrigin - glm::dvec3(0.01, 0.0, 0.0)), 0.0f);
  EXPECT_EQ(grid.interpolate(kOrigin + glm::dvec3(kDims) * kVoxel + glm::dvec3(0.0, 0.0, 0.01)), 0.0f);
  EXPECT_EQ(grid.interpolate(glm::dvec3(std::numeric_limits<double>::quiet_NaN())), 0.0f);
}

TEST(VoxelGrid, BricksBoundWhatTheyInterpolate) {
  const VoxelGrid grid = speckled();
  const std::vector<float> most = brickMaxima(grid), least = brickMinima(grid);
  ASSERT_EQ(most.size(), grid.brickIndex().size());
  ASSERT_EQ(least.size(), grid.brickIndex().size());
  int beyondOwnVoxels = 0;
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec3 p = pointIn(grid, n);
    const glm::ivec3 brick = glm::ivec3((p - grid.origin()) / grid.voxel()) / VoxelGrid::kBrick;
    const auto slot = std::size_t((brick.z * grid.brickDims().y + brick.y) * grid.brickDims().x + brick.x);
    ASSERT_LE(grid.interpolate(p), most[slot]);
    ASSERT_GE(grid.interpolate(p), least[slot]);
    beyondOwnVoxels += grid.interpolate(p) > 0.0f && grid.brickIndex()[slot] == 0;
  }
  EXPECT_GT(beyondOwnVoxels, 0) << "no neighbour reached into an empty brick: the test would miss a bound without them";
}

TEST(VoxelGrid, RefusesNonsense) {
  EXPECT_THROW(VoxelGrid({0, 8, 8}, kOrigin, kVoxel), Error);
  EXPECT_THROW(VoxelGrid({8, 8, 8}, kOrigin, {1.0, -1.0, 1.0}), Error);
  EXPECT_THROW(VoxelGrid({8, 8, 8}, kOrigin, {1.0, std::numeric_limits<double>::infinity(), 1.0}), Error);
  EXPECT_THROW(VoxelGrid({8, 8, 8}, {std::nan(""), 0.0, 0.0}, kVoxel), Error);
  EXPECT_THROW(VoxelGrid(glm::ivec3(2000000000), kOrigin, kVoxel), Error);
  VoxelGrid grid({8, 8, 8}, kOrigin, kVoxel);
  EXPECT_THROW(grid.set({8, 0, 0}, 1.0f), Error);
  EXPECT_THROW(grid.set({0, -1, 0}, 1.0f), Error);
  EXPECT_THROW(grid.set({0, 0, 0}, -1.0f), Error);
  EXPECT_THROW(grid.set({0, 0, 0}, std::nanf("")), Error);
}

}  // namespace
}  // namespace welkin
