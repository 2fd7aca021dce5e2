#pragma once
// The clouds round a place, ready to be asked for millions of samples: parameters, cached weather and noise, and bounds
// of the extinction by which a path skips empty air. Positions are relative to the cache's anchor.
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "welkin/density/clip_levels.hpp"
#include "welkin/density/field.hpp"

namespace welkin {

// Boxes of cloud space: n x n x layers cells of `cell` x `cell` x `height` m, the first one's corner at `origin`. Cell
// (i, j, k) has its bound at bounds[offset + (k n + j) n + i]: an extinction above 0; or -d, d >= 1, in a cell without
// cloud whose neighbours less than d cells away along every axis have none either.
struct MajorantLevel {
  glm::vec3 origin{0.0f};
  float cell = 1.0f, height = 1.0f;
  int n = 0, layers = 0;
  std::size_t offset = 0;
};

// Upper bounds of the extinction (1/m) of all layers, grids and hero clouds together, in nested squares round a centre,
// finest first, each twice as wide as the one before. Outside them there is no cloud.
struct Majorants {
  glm::vec2 centre{0.0f};           // the anchor, or the middle of grids and hero clouds where there is no layer
  float bottom = 0.0f, top = 0.0f;  // altitudes that hold all cloud, m
  std::vector<MajorantLevel> levels;
  std::vector<float> bounds;
};

// A grid seen from the anchor: voxel coordinates (0 at the first voxel's centre) are rows * (point, 1).
struct CachedGrid {
  std::shared_ptr<const VoxelGrid> voxels;
  glm::vec4 rows[3];
  float extinction = 1.0f;  // 1/m, of the value 1
};

// A hero cloud seen from the anchor.
struct CachedHero {
  law::HeroParams params;
  HeroBody body;
};

struct CloudCache {
  std::vector<law::LayerParams> layers;
  std::vector<law::SheetParams> sheets;
  std::vector<CachedGrid> grids;
  std::vector<CachedHero> heroes;
  WeatherCache weather;
  DensityTextures noise;
  Majorants majorants;
};

struct CloudCacheExtent {
  WeatherExtent weather{.texels = 1536};
  int cells = 128;           // of a majorant level's edge
  int cellLayers = 64;       // from the lowest base to the highest top
  float finestCell = 40.0f;  // m
};

// The cache round `anchor`. The weather is that of the law at texel centres and bilinear in between, everything else is
// the law itself; the bounds hold for exactly that. Throws as DensityField.
CloudCache bakeCloudCache(const DensityParts& parts, const DensityTextures& textures, const glm::dvec3& anchor,
                          const CloudCacheExtent& extent = {});

// Extinction at a point of cloud space relative to the anchor, scalar (for tests; kernels use the SIMD reading).
float extinctionIn(const CloudCache& cache, const glm::vec3& point);

// The bound at a point; 0 where there is no cloud.
float majorantAt(const Majorants& majorants, const glm::vec3& point);

}  // namespace welkin
