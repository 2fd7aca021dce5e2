#pragma once
// Volumes of the renderer Mitsuba (.vol, its plugin "gridvolume").
#include <string>

#include "welkin/density/voxel_grid.hpp"

namespace welkin {

// Writes all voxels, the empty ones too, as floats, with the box's corners in m. Throws Error (failed) when the file
// cannot be written. Mitsuba places a grid's outermost values on the box's sides unless the volume says otherwise;
// half a voxel of shift is part of its convention.
void saveMitsubaVolume(const std::string& path, const VoxelGrid& grid);

}  // namespace welkin
