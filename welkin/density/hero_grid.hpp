#pragma once
// Hero clouds as voxels, for renderers that sample grids.
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/hero.hpp"

namespace welkin {

constexpr double kHeroGridVoxels = 16e6;  // in the box of one cloud, by choice

// The cloud as it is at `time` (s), in still air: the wind has not moved it. Voxels are cubes, about `voxels` of them
// in its box. `seed` is the scene's.
PlacedGrid heroGrid(const Hero& hero, double time, int seed, double voxels = kHeroGridVoxels);

}  // namespace welkin
