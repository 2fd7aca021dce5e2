#include "welkin/io/grids.hpp"

#include <charconv>
#include <map>

#include "welkin/base/error.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {

namespace {

struct Loaded {
  std::shared_ptr<const VoxelGrid> voxels;
  glm::dmat4 placement;
  double stated = 0.0;  // extinction of the value 1
};

Loaded load(const GridCloud& cloud) {
  if (!cloud.file.ends_with(".vdb"))
    throw Error(ErrorKind::badInput, cloud.file,
                "a grid is an OpenVDB file (.vdb); `nanovdb_convert` turns NanoVDB files into such");
  VdbGrid grid = loadVdb(cloud.file, cloud.grid, {}, 1);
  Loaded loaded{std::make_shared<const VoxelGrid>(std::move(grid.voxels)), grid.placement};
  if (const auto note = grid.notes.find("extinction_per_metre_at_1"); note != grid.notes.end()) {
    const std::string& text = note->second;
    double value = 0.0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc() && value > 0.0 && value < 1e6)
      loaded.stated = value;
  }
  return loaded;
}

}  // namespace

std::vector<PlacedGrid> loadGrids(const Scene& scene) {
  std::map<std::pair<std::string, std::string>, Loaded> files;
  std::vector<PlacedGrid> grids;
  for (const GridCloud& cloud : scene.grids) {
    if (cloud.file.empty()) continue;
    auto known = files.find({cloud.file, cloud.grid});
    if (known == files.end()) known = files.emplace(std::pair(cloud.file, cloud.grid), load(cloud)).first;
    const Loaded& loaded = known->second;
    grids.push_back(placed(cloud, loaded.voxels, loaded.placement, loaded.stated));
  }
  return grids;
}

}  // namespace welkin
