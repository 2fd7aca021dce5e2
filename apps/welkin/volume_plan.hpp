#pragma once
// What `welkin vdb` is going to write: which box of the sky, in which axes, units and pieces.
#include <string>
#include <vector>

#include "welkin/density/voxel_bake.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::app {

enum class VolumeUp { z, y };
enum class VolumeUnit { m, cm };
// What a value means. normalized: 1 is the largest extinction that a layer or hero cloud of the sky
// names. extinction: in 1/m. lwc:
// liquid water in g/m^3, of droplets twice as wide as their effective radius.
enum class VolumeDensity { normalized, extinction, lwc };

struct VolumeConvention {
  VolumeUp up = VolumeUp::z;
  VolumeUnit unit = VolumeUnit::m;
  VolumeDensity density = VolumeDensity::normalized;
};

// Units of the file in a metre.
inline double unitsPerMetre(VolumeUnit unit) { return unit == VolumeUnit::cm ? 100.0 : 1.0; }

// Extinction in 1/m of the value 1. Throws Error (badInput) when the sky has no clouds in volume.
double extinctionAtOne(const Scene& scene, VolumeDensity density);

// A box of the world: east, north, altitude in m.
struct Region {
  glm::dvec3 low, high;
};

// Reads "west,south,east,north[,bottom,top]"; without heights those of the sky's clouds. Empty: `kDefaultEdge` round
// the camera, or, in a sky without layers, the box round its hero clouds. Rounded outward to bricks of voxels, so that
// neighbouring files fit together.
inline constexpr double kDefaultEdge = 6000.0;  // m, by choice
Region regionOf(const std::string& text, const Scene& scene, double voxel);

// The region cut into across.x times across.y pieces, whole bricks each.
std::vector<Region> tilesOf(const Region& region, const glm::ivec2& across, double voxel);

// The voxels of a region in the file's axes, and how they are baked.
VoxelBox boxOf(const Region& region, double voxel, const VolumeConvention& convention);
VoxelBaking bakingOf(const VolumeConvention& convention, double extinctionOfOne);

// What baking is expected to take, from a few hundred bricks.
struct VolumeEstimate {
  double voxels = 0.0, activeVoxels = 0.0, activeBricks = 0.0, seconds = 0.0;
};
VolumeEstimate estimateOf(const DensityField& field, const Region& region, double voxel);

}  // namespace welkin::app
