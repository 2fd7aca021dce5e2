#pragma once
// NanoVDB files (.nvdb), for renderers that read no other. Without the library (see hasNanoVdb) writing throws Error
// (failed), which says what to install.
#include <string>

#include "welkin/density/voxel_grid.hpp"

namespace welkin {

// Writes an uncompressed fog volume of floats (the kind that every build of NanoVDB reads) called `name`. Throws Error
// (badInput) for voxels that are no cubes, (failed) when the file cannot be written.
void saveNanoVdb(const std::string& path, const VoxelGrid& grid, const std::string& name = "density");

bool hasNanoVdb();

}  // namespace welkin
