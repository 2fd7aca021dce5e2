#include "welkin/io/nanovdb.hpp"

#include "welkin/base/error.hpp"

#if WELKIN_HAS_NANOVDB
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <ostream>

#include "welkin/io/file.hpp"
#include "welkin/io/volume_lattice.hpp"

namespace welkin {

bool hasNanoVdb() { return true; }

void saveNanoVdb(const std::string& path, const VoxelGrid& grid, const std::string& name) {
  const glm::dvec3 voxel = grid.voxel();
  if (voxel.x != voxel.y || voxel.x != voxel.z)
    throw Error(ErrorKind::badInput, path, "voxels that are no cubes cannot be written to NanoVDB");
  const VolumeLattice lattice = latticeOf(grid, path);
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto accessor = builder.getAccessor();
  const glm::ivec3 size = grid.brickDims();
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const std::uint32_t brick = grid.brickIndex()[(std::size_t(z) * size.y + y) * size.x + x];
        if (brick == 0) continue;
        const glm::ivec3 low = lattice.offset + VoxelGrid::kBrick * glm::ivec3(x, y, z);
        const float* value = grid.values().data() + std::size_t(brick) * VoxelGrid::kBrickVoxels;
        for (int k = 0; k < VoxelGrid::kBrick; ++k)
          for (int j = 0; j < VoxelGrid::kBrick; ++j)
            for (int i = 0; i < VoxelGrid::kBrick; ++i, ++value)
              if (*value != 0.0f) accessor.setValue({low.x + i, low.y + j, low.z + k}, *value);
      }
  writeStreamAtomically(path, "NanoVDB", [&](std::ostream& stream) {
    const glm::dvec3 t = lattice.translation;
    const auto handle = builder.getHandle<>(voxel.x, nanovdb::Vec3d(t.x, t.y, t.z), name);
    nanovdb::io::writeGrid(stream, handle, nanovdb::io::Codec::NONE);
  });
}

}  // namespace welkin

#else

namespace welkin {

bool hasNanoVdb() { return false; }
void saveNanoVdb(const std::string& path, const VoxelGrid&, const std::string&) {
  throw Error(ErrorKind::failed, path,
              "needs NanoVDB, which this build of Welkin is without: install libnanovdb-dev and build it again");
}

}  // namespace welkin

#endif
