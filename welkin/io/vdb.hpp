#pragma once
// OpenVDB files (.vdb). Without the library (see hasOpenVdb) reading and writing throw Error (failed), which says what
// to install.
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <span>
#include <string>
#include <variant>

#include "welkin/density/voxel_grid.hpp"
#include "welkin/io/isolated.hpp"

namespace welkin {

// Something that a file says about its grid.
struct VolumeNote {
  std::string name;
  std::variant<double, std::int64_t, std::string> value;
};

enum class VolumePrecision { half, full };

// Writes a fog volume called `name`. A voxel of the value 0 is not active. Voxel centres stand at integer coordinates;
// grids whose origins are multiples of 8 voxels share their transform. Throws Error (badInput) for values that do not
// fit, (failed) when the file cannot be written.
void saveVdb(const std::string& path, const VoxelGrid& grid, std::span<const VolumeNote> notes,
             VolumePrecision precision, const std::string& name = "density");

struct VdbGrid {
  VoxelGrid voxels;           // the box of the active voxels, on axes of their own
  glm::dmat4 placement{1.0};  // from there to the file's world; 1 unless it turns, shears or mirrors
  std::string name;
  std::map<std::string, std::string> notes;  // its metadata as text
};

// Reads the float grid called `name`, or if that is empty the one called "density", or else the first. Inactive voxels
// are 0, negative values too; the background is not used. The file is read in a process of its own, so that a damaged
// one can do no harm. Throws Error (badInput) for files that are damaged or hold no such grid, level sets, transforms
// that are not linear, and values that are not finite. The box is `margin` voxels of 0 larger on every side.
VdbGrid loadVdb(const std::string& path, const std::string& name = "", const IsolationLimits& limits = {},
                int margin = 0);

bool hasOpenVdb();
std::string openVdbVersion();  // empty without it

}  // namespace welkin
