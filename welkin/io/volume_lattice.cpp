#include "welkin/io/volume_lattice.hpp"

#include <cmath>

#include "welkin/base/error.hpp"

namespace welkin {

namespace {
constexpr double kFarthest = 0x1p30;   // voxels from the origin, half of what 32-bit coordinates reach
constexpr double kRoundingOff = 1e-5;  // voxels; decimal sizes such as 12.1 m are not exact in binary
}  // namespace

VolumeLattice latticeOf(const VoxelGrid& grid, const std::string& path) {
  VolumeLattice lattice{};
  for (int c = 0; c < 3; ++c) {
    const double brick = VoxelGrid::kBrick * grid.voxel()[c];
    const double bricks = std::floor(grid.origin()[c] / brick + kRoundingOff / VoxelGrid::kBrick);
    if (std::abs(bricks) * VoxelGrid::kBrick > kFarthest)
      throw Error(ErrorKind::badInput, path, "the region is too many voxels away from the origin");
    lattice.offset[c] = static_cast<int>(bricks) * VoxelGrid::kBrick;
    const double rest = grid.origin()[c] - bricks * brick;
    lattice.translation[c] = 0.5 * grid.voxel()[c] + (std::abs(rest) < kRoundingOff * grid.voxel()[c] ? 0.0 : rest);
  }
  return lattice;
}

}  // namespace welkin
