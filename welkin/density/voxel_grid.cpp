#include "welkin/density/voxel_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"

namespace welkin {

namespace {

constexpr double kMostBricks = 0x1p26;  // 256 MiB of index; 3.4e10 voxels

void check(const glm::ivec3& dims, const glm::dvec3& origin, const glm::dvec3& voxel) {
  for (int c = 0; c < 3; ++c) {
    if (dims[c] <= 0)
      throw Error(
          ErrorKind::badInput, "",
          fmt::format("a voxel grid needs at least one voxel on every axis, not {} x {} x {}", dims.x, dims.y, dims.z));
    if (!(voxel[c] > 0.0 && std::isfinite(voxel[c]) && std::isfinite(origin[c])))
      throw Error(
          ErrorKind::badInput, "",
          fmt::format("a voxel grid needs voxels of positive size at a finite place, not {} x {} x {} m at ({}, "
                      "{}, {})",
                      voxel.x, voxel.y, voxel.z, origin.x, origin.y, origin.z));
  }
  const glm::dvec3 bricks = glm::ceil(glm::dvec3(dims) / double(VoxelGrid::kBrick));
  if (bricks.x * bricks.y * bricks.z > kMostBricks)
    throw Error(ErrorKind::badInput, "",
                fmt::format("a voxel grid of {} x {} x {} voxels is too large (the most is 2^26 bricks of 8^3): choose "
                            "larger voxels or a smaller region",
                            dims.x, dims.y, dims.z));
}

// The best value of the voxels that interpolation reads inside each brick, where better(a, b) prefers a to b.
template <class Better>
std::vector<float> brickExtremes(const VoxelGrid& grid, const Better& better) {
  const glm::ivec3 bricks = grid.brickDims();
  std::vector<float> best(grid.brickIndex().size());
  parallelFor(static_cast<std::size_t>(bricks.z), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin * bricks.y; row < end * bricks.y; ++row)
      for (int x = 0; x < bricks.x; ++x) {
        const glm::ivec3 first =
            VoxelGrid::kBrick * glm::ivec3(x, static_cast<int>(row) % bricks.y, static_cast<int>(row) / bricks.y);
        const glm::ivec3 low = glm::max(first - 1, glm::ivec3(0));
        const glm::ivec3 high = glm::min(first + VoxelGrid::kBrick, grid.dims() - 1);
        float value = grid.at(low);
        for (int k = low.z; k <= high.z; ++k)
          for (int j = low.y; j <= high.y; ++j)
            for (int i = low.x; i <= high.x; ++i) value = better(value, grid.at({i, j, k}));
        best[row * bricks.x + x] = value;
      }
  });
  return best;
}

}  // namespace

VoxelGrid::VoxelGrid(const glm::ivec3& dims, const glm::dvec3& origin, const glm::dvec3& voxel)
    : dims_(dims), brickDims_(0), origin_(origin), voxel_(voxel) {
  check(dims, origin, voxel);
  brickDims_ = (dims - 1) / kBrick + 1;
  index_.resize(std::size_t(brickDims_.x) * brickDims_.y * brickDims_.z);
  values_.resize(kBrickVoxels);
}

bool VoxelGrid::contains(const glm::ivec3& i) const {
  return glm::all(glm::greaterThanEqual(i, glm::ivec3(0))) && glm::all(glm::lessThan(i, dims_));
}

std::size_t VoxelGrid::slotOf(const glm::ivec3& i) const {
  const glm::ivec3 b = i / kBrick;
  return (std::size_t(b.z) * brickDims_.y + b.y) * brickDims_.x + b.x;
}

std::size_t VoxelGrid::placeInBrick(const glm::ivec3& i) {
  const glm::ivec3 v = i % kBrick;
  return (std::size_t(v.z) * kBrick + v.y) * kBrick + v.x;
}

float VoxelGrid::at(const glm::ivec3& i) const {
  return contains(i) ? values_[std::size_t(index_[slotOf(i)]) * kBrickVoxels + placeInBrick(i)] : 0.0f;
}

void VoxelGrid::set(const glm::ivec3& i, float value) {
  if (!contains(i))
    throw Error(
        ErrorKind::badInput, "",
        fmt::format("voxel ({}, {}, {}) is outside a grid of {} x {} x {}", i.x, i.y, i.z, dims_.x, dims_.y, dims_.z));
  if (!(value >= 0.0f && std::isfinite(value)))
    throw Error(ErrorKind::badInput, "",
                fmt::format("voxel ({}, {}, {}) cannot have the value {}: values are 0 or more, and finite", i.x, i.y,
                            i.z, value));
  std::uint32_t& brick = index_[slotOf(i)];
  if (brick == 0) {
    if (value == 0.0f) return;
    brick = static_cast<std::uint32_t>(values_.size() / kBrickVoxels);
    values_.resize(values_.size() + kBrickVoxels);
  }
  values_[std::size_t(brick) * kBrickVoxels + placeInBrick(i)] = value;
}

float VoxelGrid::interpolate(const glm::dvec3& p) const {
  const glm::dvec3 u = (p - origin_) / voxel_;
  const glm::dvec3 size(dims_);
  if (!(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, size)))) return 0.0f;
  const glm::dvec3 v = glm::clamp(u - 0.5, glm::dvec3(0.0), size - 1.0);
  const glm::ivec3 low(v), high = glm::min(low + 1, dims_ - 1);
  const glm::dvec3 f = v - glm::dvec3(low);
  const auto alongX = [&](int y, int z) {
    const double a = at({low.x, y, z}), b = at({high.x, y, z});
    return a + f.x * (b - a);
  };
  const auto alongY = [&](int z) {
    const double a = alongX(low.y, z), b = alongX(high.y, z);
    return a + f.y * (b - a);
  };
  const double a = alongY(low.z), b = alongY(high.z);
  return static_cast<float>(a + f.z * (b - a));
}

float VoxelGrid::maximum() const { return *std::max_element(values_.begin(), values_.end()); }

std::vector<float> brickMaxima(const VoxelGrid& grid) {
  return brickExtremes(grid, [](float a, float b) { return std::max(a, b); });
}
std::vector<float> brickMinima(const VoxelGrid& grid) {
  return brickExtremes(grid, [](float a, float b) { return std::min(a, b); });
}

}  // namespace welkin
