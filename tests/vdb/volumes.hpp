#pragma once
// Small volumes for tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>

#include "welkin/density/voxel_grid.hpp"

namespace welkin::test {

// Under a sanitizer a process maps terabytes of shadow memory, and a limit on address space kills whoever obeys it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kShadowMemory = true;
#else
inline constexpr bool kShadowMemory = false;
#endif

// A file of the running test's own, since tests run at the same time.
inline std::string temporary(const std::string& name) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string own = std::string(test.test_suite_name()) + "." + test.name();
  std::replace(own.begin(), own.end(), '/', '_');
  const std::filesystem::path folder = std::filesystem::path(WELKIN_BINARY_DIR) / "volumes" / own;
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
