#include "welkin/density/voxel_bake.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "welkin/base/parallel.hpp"
#include "welkin/density/clear_air.hpp"

namespace welkin {

namespace {

constexpr std::size_t kBricksAtATime = 1024;  // 2^19 points, 14 MiB with their answers
constexpr int kSide = VoxelGrid::kBrick, kVoxels = VoxelGrid::kBrickVoxels;

struct Baker {
  const VoxelBox& box;
  const VoxelBaking& baking;
  const ClearAir& clear;

  glm::dvec3 place(const glm::dvec3& voxel) const {
    const glm::dvec3 p = box.origin + voxel * box.voxel;
    return baking.cloudSpace ? baking.cloudSpace(p) : p;
  }
  // The centres of a brick's voxels lie between the images of its corners.
  bool isClear(const glm::ivec3& brick) const {
    glm::dvec3 low(1e300), high(-1e300);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p = place(kSide * (brick + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2)));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    return clear.holds(low, high);
  }
  void addCentres(const glm::ivec3& brick, glm::dvec3* points) const {
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) *points++ = place(glm::dvec3(kSide * brick + glm::ivec3(x, y, z)) + 0.5);
  }
};

}  // namespace

VoxelGrid bakeVoxels(const DensityField& field, const VoxelBox& box, const VoxelBaking& baking,
                     const Progress& progress) {
  VoxelGrid grid(box.dims, box.origin, box.voxel);
  const ClearAir clear(field);
  const Baker baker{box, baking, clear};
  const glm::ivec3 dims = grid.brickDims();
  const std::size_t all = grid.brickIndex().size();
  const auto brickAt = [&](std::size_t i) {
    return glm::ivec3(int(i % dims.x), int(i / dims.x % dims.y), int(i / (std::size_t(dims.x) * dims.y)));
  };
  std::vector<char> cloudy;
  std::vector<glm::ivec3> bricks;
  std::vector<glm::dvec3> points;
  for (std::size_t first = 0; first < all; first += kBricksAtATime) {
    cloudy.assign(std::min(kBricksAtATime, all - first), 0);
    parallelFor(cloudy.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) cloudy[i] = !baker.isClear(brickAt(first + i));
    });
    bricks.clear();
    for (std::size_t i = 0; i < cloudy.size(); ++i)
      if (cloudy[i]) bricks.push_back(brickAt(first + i));
    points.resize(bricks.size() * kVoxels);
    parallelFor(bricks.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) baker.addCentres(bricks[i], points.data() + i * kVoxels);
    });
    const std::vector<float> extinction = field.extinction(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (extinction[i] == 0.0f) continue;
      const int v = static_cast<int>(i % kVoxels);
      const glm::ivec3 at = kSide * bricks[i / kVoxels] + glm::ivec3(v % kSide, v / kSide % kSide, v / (kSide * kSide));
      if (glm::all(glm::lessThan(at, box.dims))) grid.set(at, baking.scale * extinction[i]);
    }
    report(progress, static_cast<double>(first + cloudy.size()) / static_cast<double>(all));
  }
  return grid;
}

}  // namespace welkin
