#pragma once
// Small volumes for tests.
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>

#include "welkin/density/voxel_grid.hpp"

namespace welkin::test {

inline std::string temporary(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(WELKIN_BINARY_DIR) / "volumes";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

// A ball that touches the sides of its box, of a different value in every voxel.
inline VoxelGrid ball(const glm::ivec3& dims, const glm::dvec3& origin, const glm::dvec3& voxel) {
  VoxelGrid grid(dims, origin, voxel);
  for (int z = 0; z < dims.z; ++z)
    for (int y = 0; y < dims.y; ++y)
      for (int x = 0; x < dims.x; ++x) {
        const glm::dvec3 unit = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(dims) * 2.0 - 1.0;
        const double depth = 1.0 - glm::length(unit);
        if (depth > 0.0)
          grid.set({x, y, z}, static_cast<float>(0.1 * depth * (1.0 + 0.5 * std::sin(x + 2.0 * y + 3.0 * z))));
      }
  return grid;
}

}  // namespace welkin::test
