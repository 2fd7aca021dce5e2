#include "welkin/density/voxel_bake.hpp"

#include <glm/common.hpp>

namespace welkin {

namespace {
constexpr int kBlock = 64;  // voxels: 2^18 points, 7 MiB with their answers
}

VoxelGrid bakeVoxels(const DensityField& field, const VoxelBox& box, const VoxelBaking& baking,
                     const Progress& progress) {
  VoxelGrid grid(box.dims, box.origin, box.voxel);
  const glm::ivec3 blocks = (box.dims - 1) / kBlock + 1;
  const std::size_t count = std::size_t(blocks.x) * blocks.y * blocks.z;
  std::vector<glm::dvec3> points;
  for (std::size_t b = 0; b < count; ++b) {
    const glm::ivec3 low = kBlock * glm::ivec3(int(b % blocks.x), int(b / blocks.x % blocks.y),
                                               int(b / (std::size_t(blocks.x) * blocks.y)));
    const glm::ivec3 high = glm::min(low + kBlock, box.dims);
    const auto forVoxels = [&](const auto& visit) {
      for (int z = low.z; z < high.z; ++z)
        for (int y = low.y; y < high.y; ++y)
          for (int x = low.x; x < high.x; ++x) visit(glm::ivec3(x, y, z));
    };
    points.clear();
    forVoxels([&](const glm::ivec3& i) {
      const glm::dvec3 centre = box.origin + (glm::dvec3(i) + 0.5) * box.voxel;
      points.push_back(baking.cloudSpace ? baking.cloudSpace(centre) : centre);
    });
    const std::vector<float> extinction = field.extinction(points);
    std::size_t next = 0;
    forVoxels([&](const glm::ivec3& i) { grid.set(i, baking.scale * extinction[next++]); });
    report(progress, static_cast<double>(b + 1) / static_cast<double>(count));
  }
  return grid;
}

}  // namespace welkin
