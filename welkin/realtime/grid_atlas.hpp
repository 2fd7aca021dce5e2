#pragma once
// Volumes as the march samples them (grid.glsl).
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/params.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/law.hpp"

namespace welkin::realtime {

// What the two textures hold, and where each grid is in them.
struct GridPacking {
  glm::ivec3 indexSize{0}, bricksAcross{0};
  std::vector<std::uint8_t> index;  // RGBA
  std::vector<float> bricks;        // extinction in 1/m, 9^3 texels a brick
  struct Grid {
    PlacedGrid placed;  // a coarser one where the finer did not fit
    glm::ivec3 bricks{0};
    int firstSlice = 0;
  };
  std::vector<Grid> grids;
};

struct AtlasLimits {
  std::size_t bytes = std::size_t{128} << 20;  // of half floats, by choice
  int textureSize = 2048;                      // most texels on an axis
};

// Halves the resolution of the largest grids until all fit.
GridPacking packGrids(std::span<const PlacedGrid> grids, const AtlasLimits& limits);

// The grid with voxels twice as large, each the mean of eight, and a margin of zeros.
VoxelGrid halved(const VoxelGrid& grid);

class GridAtlas {
 public:
  GridAtlas() = default;
  GridAtlas(const gl::Api& gl, std::span<const PlacedGrid> grids);

  std::size_t count() const { return grids_.size(); }
  bool scattered(std::size_t grid) const { return grids_[grid].placed.scatter.any(); }
  // For points of cloud space whose plane is relative to `anchor`.
  law::GridParams params(std::size_t grid, const glm::dvec2& anchor) const;
  // Lowest and highest altitude of a grid's box, m.
  Shell shell(std::size_t grid) const;
  const gl::Texture& index() const { return index_; }
  const gl::Texture& bricks() const { return bricks_; }

 private:
  gl::Texture index_, bricks_;
  std::vector<GridPacking::Grid> grids_;
};

}  // namespace welkin::realtime
