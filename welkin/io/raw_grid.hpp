#pragma once
// Voxel grids as raw floats, which any program can write: extinction in 1/m or albedo, little-endian 32-bit floats, x
// fastest, then y, then z upward. A small JSON header may stand beside them, in `path`.json: {"width", "height",
// "depth", "voxel": [dx, dy, dz]} with voxel sizes in m, and whatever else; as saveRawVolume writes it, plus `voxel`.
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "welkin/density/voxel_grid.hpp"

namespace welkin {

struct RawGridLayout {
  std::optional<glm::ivec3> dims;
  std::optional<glm::dvec3> voxel;  // m
};

// What a header says; `where` names it in errors. Throws Error (badInput) for anything else than described above.
RawGridLayout parseRawGridHeader(std::string_view text, const std::string& where);

// Reads a grid whose lower corner is the origin. `layout` goes before the header, and both may be given as long as one
// says what is needed. Throws Error (badInput) when sizes are missing or do not fit the file, for values that are
// negative or not finite, and for more than 2^31 voxels.
VoxelGrid loadRawGrid(const std::string& path, const RawGridLayout& layout);

}  // namespace welkin
