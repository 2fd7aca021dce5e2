#pragma once
// How grids of files with integer voxel coordinates name the voxels of a VoxelGrid.
#include <glm/vec3.hpp>
#include <string>

#include "welkin/density/voxel_grid.hpp"

namespace welkin {

// World of the integer coordinate c is translation + voxel c, the centre of a voxel.
struct VolumeLattice {
  glm::ivec3 offset;       // coordinate of voxel (0, 0, 0), a multiple of a brick
  glm::dvec3 translation;  // the same for all grids whose origins are multiples of a brick
};

// Throws Error (badInput, at `path`) when the grid is too far from the origin for such coordinates.
VolumeLattice latticeOf(const VoxelGrid& grid, const std::string& path);

}  // namespace welkin
