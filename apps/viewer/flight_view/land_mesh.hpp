#pragma once
// The land as nested square grids round the eye, each twice as coarse and as wide as the one inside it (F. Losasso and
// H. Hoppe, "Geometry clipmaps", 2004), drawn by blocks that may be in sight.
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "apps/viewer/flight/terrain.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::viewer {

class LandMesh {
 public:
  static constexpr int kLevels = 9, kCells = 128;  // cells a side
  static constexpr double kFinest = 16.0;          // m, a cell of the innermost grid
  static constexpr int kTexels = 2 * kCells + 1;   // a side of a level's texture: twice as fine as its mesh

  LandMesh(const gl::Api& gl, const Terrain& terrain);
  ~LandMesh();
  LandMesh(const LandMesh&) = delete;
  LandMesh& operator=(const LandMesh&) = delete;

  // Follows the eye: levels that it has moved over are made anew.
  void update(const glm::dvec3& eye);
  // Draws with a program that has the uniforms of land_shader.hpp. `clipFromEye`: of positions relative to the eye.
  void draw(const gl::Program& program, const glm::dvec3& eye, const glm::mat4& clipFromEye, int firstUnit) const;

 private:
  static constexpr int kBlocks = 8, kBlockCells = kCells / kBlocks;  // a side
  struct Level {
    gl::Texture texture;  // height, slopes to east and north, woods
    glm::dvec2 corner{0.0};
    bool made = false;
    std::array<glm::vec2, kBlocks * kBlocks> heights{};  // of each block, least and most
  };
  static double cellOf(int level) { return kFinest * (1 << level); }
  void make(int level, const glm::dvec2& corner);

  const gl::Api& gl_;
  const Terrain& terrain_;
  std::array<Level, kLevels> levels_;
  GLuint array_ = 0, indices_ = 0;
};

}  // namespace welkin::viewer
