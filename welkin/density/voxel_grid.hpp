#pragma once
// A cloud as numbers in a box: what files hold, solvers trace and the rasteriser uploads.
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace welkin {

// Values of at least 0 (extinction in 1/m, or albedo) on a regular grid of box-shaped voxels, at their centres. Stored
// in bricks of 8^3; an empty brick takes four bytes. Safe to read from many threads.
class VoxelGrid {
 public:
  static constexpr int kBrick = 8;
  static constexpr int kBrickVoxels = kBrick * kBrick * kBrick;

  // `origin` is the lower corner of voxel (0, 0, 0) and `voxel` the size of each, both in m. Throws Error (badInput)
  // for sizes that are not positive and finite and for more than 2^26 bricks.
  VoxelGrid(const glm::ivec3& dims, const glm::dvec3& origin, const glm::dvec3& voxel);

  const glm::ivec3& dims() const { return dims_; }
  const glm::dvec3& origin() const { return origin_; }
  const glm::dvec3& voxel() const { return voxel_; }
  const glm::ivec3& brickDims() const { return brickDims_; }

  float at(const glm::ivec3& i) const;  // 0 outside
  // Throws Error (badInput) outside the grid, and for a value that is negative, infinite or no number.
  void set(const glm::ivec3& i, float value);
  // Trilinear between voxel centres; constant from the outermost centres to the sides of the box; 0 outside the box.
  float interpolate(const glm::dvec3& p) const;

  // Number of the brick in values(), for each of brickDims, x fastest. Brick 0 is all zeros and stands for all empty
  // ones, so that looking up needs no branch.
  std::span<const std::uint32_t> brickIndex() const { return index_; }
  // Bricks one after another, 512 values each, x fastest. Values beyond dims are 0.
  std::span<const float> values() const { return values_; }

  float maximum() const;
  std::size_t bytes() const { return index_.size() * sizeof(index_[0]) + values_.size() * sizeof(values_[0]); }

 private:
  bool contains(const glm::ivec3& i) const;
  std::size_t slotOf(const glm::ivec3& i) const;  // of the brick that holds a voxel, in index_
  static std::size_t placeInBrick(const glm::ivec3& i);

  glm::ivec3 dims_, brickDims_;
  glm::dvec3 origin_, voxel_;
  std::vector<std::uint32_t> index_;
  std::vector<float> values_;
};

// The most and the least that interpolation gives inside the box of every brick: its own voxels and their neighbours.
// One for each of brickDims, x fastest.
std::vector<float> brickMaxima(const VoxelGrid& grid);
std::vector<float> brickMinima(const VoxelGrid& grid);

}  // namespace welkin
