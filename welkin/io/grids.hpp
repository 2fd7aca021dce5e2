#pragma once
// The volumes that a sky names.
#include <vector>

#include "welkin/density/grid_cloud.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// Reads the files of a scene's grids and puts them where they stand; a file that several name is read once. Throws
// Error (badInput) for files that loadVdb refuses, (failed) without OpenVDB.
std::vector<PlacedGrid> loadGrids(const Scene& scene);

}  // namespace welkin
