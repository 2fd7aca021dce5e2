#include "welkin/realtime/grid_atlas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/gl/api.hpp"

namespace welkin::realtime {

namespace {

constexpr int kBrick = VoxelGrid::kBrick, kSide = kBrick + 1;
constexpr std::size_t kTexels = std::size_t{kSide} * kSide * kSide;
constexpr int kMostAcross = 255;  // bricks on an axis that a byte can name
constexpr float kLargestHalf = 65504.0f;

using Brick = std::array<float, kTexels>;

// Bricks are of cells between voxel centres, of which there is one less than voxels.
glm::ivec3 bricksOf(const VoxelGrid& grid) { return glm::max((grid.dims() - 2) / kBrick + 1, glm::ivec3(1)); }

std::size_t slotOf(const glm::ivec3& b, const glm::ivec3& size) {
  return (std::size_t(b.z) * size.y + b.y) * size.x + b.x;
}

// The brick at b; false when nothing is in it.
bool fill(const PlacedGrid& placed, const glm::ivec3& b, Brick& brick) {
  std::size_t next = 0;
  bool any = false;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const float value = placed.voxels->at(kBrick * b + glm::ivec3(x, y, z));
        brick[next++] = std::min(placed.extinction * value, kLargestHalf);
        any = any || value > 0.0f;
      }
  return any;
}

// Number of bricks that are not empty.
std::size_t fullBricks(const PlacedGrid& placed) {
  const glm::ivec3 size = bricksOf(*placed.voxels);
  Brick brick;
  std::size_t count = 0;
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) count += fill(placed, {x, y, z}, brick);
  return count;
}

}  // namespace

VoxelGrid halved(const VoxelGrid& grid) {
  VoxelGrid coarse((grid.dims() + 1) / 2 + 2, grid.origin() - 2.0 * grid.voxel(), 2.0 * grid.voxel());
  for (int z = 0; z < coarse.dims().z; ++z)
    for (int y = 0; y < coarse.dims().y; ++y)
      for (int x = 0; x < coarse.dims().x; ++x) {
        float sum = 0.0f;
        for (int k = 0; k < 8; ++k)
          sum += grid.at(2 * (glm::ivec3(x, y, z) - 1) + glm::ivec3(k & 1, k >> 1 & 1, k >> 2));
        coarse.set({x, y, z}, 0.125f * sum);
      }
  return coarse;
}

GridPacking packGrids(std::span<const PlacedGrid> placed, const AtlasLimits& limits) {
  GridPacking packing;
  std::vector<std::size_t> counts;
  for (const PlacedGrid& grid : placed) {
    packing.grids.push_back({grid, bricksOf(*grid.voxels)});
    counts.push_back(fullBricks(grid));
  }
  const int across = std::min(kMostAcross, limits.textureSize / kSide);
  const std::size_t most = std::min(limits.bytes / (kTexels * 2), std::size_t(across) * across * across);
  for (;;) {
    std::size_t full = 1;  // the empty one
    int slices = 0, side = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      full += counts[i];
      packing.grids[i].firstSlice = slices;
      const glm::ivec3 size = packing.grids[i].bricks;
      slices += size.z;
      side = std::max({side, size.x, size.y});
    }
    packing.indexSize = {1, 1, std::max(slices, 1)};
    for (const auto& grid : packing.grids)
      packing.indexSize = glm::max(packing.indexSize, glm::ivec3(grid.bricks.x, grid.bricks.y, 1));
    packing.bricksAcross = glm::ivec3(static_cast<int>(std::ceil(std::cbrt(static_cast<double>(full)))));
    packing.bricksAcross.z =
        static_cast<int>((full + std::size_t(packing.bricksAcross.x) * packing.bricksAcross.y - 1) /
                         (std::size_t(packing.bricksAcross.x) * packing.bricksAcross.y));
    if (full <= most && std::max(slices, side) <= limits.textureSize) break;
    const auto largest = static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    GridPacking::Grid& grid = packing.grids[largest];
    grid.placed.voxels = std::make_shared<const VoxelGrid>(halved(*grid.placed.voxels));
    grid.bricks = bricksOf(*grid.placed.voxels);
    counts[largest] = fullBricks(grid.placed);
  }
  const glm::ivec3 count = packing.bricksAcross;
  packing.index.assign(4 * std::size_t(packing.indexSize.x) * packing.indexSize.y * packing.indexSize.z, 0);
  packing.bricks.assign(kTexels * count.x * count.y * count.z, 0.0f);
  int next = 1;
  Brick brick;
  for (const GridPacking::Grid& grid : packing.grids)
    for (int z = 0; z < grid.bricks.z; ++z)
      for (int y = 0; y < grid.bricks.y; ++y)
        for (int x = 0; x < grid.bricks.x; ++x) {
          if (!fill(grid.placed, {x, y, z}, brick)) continue;
          const glm::ivec3 to(next % count.x, next / count.x % count.y, next / (count.x * count.y));
          ++next;
          const std::size_t entry = 4 * slotOf({x, y, z + grid.firstSlice}, packing.indexSize);
          for (int c = 0; c < 3; ++c) packing.index[entry + std::size_t(c)] = static_cast<std::uint8_t>(to[c]);
          for (int row = 0; row < kSide * kSide; ++row)
            std::copy_n(
                brick.begin() + row * kSide, kSide,
                packing.bricks.begin() + static_cast<std::ptrdiff_t>(slotOf(
                                             kSide * to + glm::ivec3(0, row % kSide, row / kSide), kSide * count)));
        }
  return packing;
}

GridAtlas::GridAtlas(const gl::Api& gl, std::span<const PlacedGrid> grids) {
  if (grids.empty()) return;
  AtlasLimits limits;
  gl.GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limits.textureSize);
  const GridPacking packing = packGrids(grids, limits);
  const glm::ivec3 i = packing.indexSize, b = kSide * packing.bricksAcross;
  index_ = gl::Texture(gl, gl::Texture::Kind::volume, gl::kRgba8, i.x, i.y, i.z, gl::Filter::nearest,
                       gl::Addressing::clamp, packing.index.data());
  bricks_ = gl::Texture(gl, gl::Texture::Kind::volume, gl::kR16F, b.x, b.y, b.z, gl::Filter::linear,
                        gl::Addressing::clamp, packing.bricks.data());
  grids_ = packing.grids;
}

law::GridParams GridAtlas::params(std::size_t which, const glm::dvec2& anchor) const {
  const GridPacking::Grid& grid = grids_[which];
  const VoxelGrid& v = *grid.placed.voxels;
  const glm::dvec3 moved = glm::dvec3(grid.placed.fromWorld * glm::dvec4(anchor.x, anchor.y, 0.0, 1.0));
  law::GridParams p{};
  glm::vec4* const rows[] = {&p.rowX, &p.rowY, &p.rowZ};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) (*rows[r])[c] = static_cast<float>(grid.placed.fromWorld[c][r] / v.voxel()[r]);
    rows[r]->w = static_cast<float>((moved[r] - v.origin()[r]) / v.voxel()[r] - 0.5);
  }
  p.voxels = glm::vec4(glm::vec3(v.dims() - 1), static_cast<float>(grid.firstSlice));
  p.bricks = glm::vec4(glm::vec3(grid.bricks), 0.0f);
  p.index = {1.0f / static_cast<float>(index_.width()), 1.0f / static_cast<float>(index_.height()),
             1.0f / static_cast<float>(index_.depth()), 0.0f};
  p.atlas = {1.0f / static_cast<float>(bricks_.width()), 1.0f / static_cast<float>(bricks_.height()),
             1.0f / static_cast<float>(bricks_.depth()), 0.0f};
  p.scatter = grid.placed.scatter.paramsAt(anchor);
  return p;
}

Shell GridAtlas::shell(std::size_t which) const {
  const WorldBox box = boundsOf(grids_[which].placed);
  return {static_cast<float>(std::max(box.low.z, 0.0)), static_cast<float>(box.high.z)};
}

}  // namespace welkin::realtime
