#pragma once
// The land as nested square grids round the eye, each twice as coarse and as wide as the one inside it (F. Losasso and
// H. Hoppe, "Geometry clipmaps", 2004), drawn by blocks that may be in sight.
#include <array>
#include <future>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "apps/viewer/flight/terrain.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::viewer {

// What a block shows. The software driver runs all of a shader, so each kind has a program of its own
// (land_shader.hpp); `close` are blocks that the runway or the aircraft's shadow may touch.
enum class LandKind { land, sea, shore, closeLand, closeShore };
inline constexpr int kLandKinds = 5;

class LandMesh {
 public:
  static constexpr int kLevels = 9, kCells = 128;  // cells a side
  static constexpr double kFinest = 16.0;          // m, a cell of the innermost grid
  static constexpr int kTexels = 2 * kCells + 1;   // a side of a level's texture: twice as fine as its mesh

  // Begins at once, beside what else the program does, with the land round `eye`.
  LandMesh(const gl::Api& gl, const Terrain& terrain, const glm::dvec3& eye);
  ~LandMesh();
  LandMesh(const LandMesh&) = delete;
  LandMesh& operator=(const LandMesh&) = delete;

  // Part of a level, as indices.
  struct Block {
    int level;
    std::size_t offset;  // bytes
    GLsizei count;
  };
  using Blocks = std::array<std::vector<Block>, kLandKinds>;

  // Follows the eye: levels that it has moved over get what is new. `width` of the picture in pixels: small ones are
  // drawn with every second vertex alone.
  void update(const glm::dvec3& eye, int width);
  // What may be in sight, by kind, the nearest level first. `clipFromEye`: of positions relative to the eye;
  // `aircraft`: its place.
  Blocks inSight(const glm::dvec3& eye, const glm::mat4& clipFromEye, const glm::dvec3& aircraft) const;
  // Draws blocks with a program of kShapeVertex, the textures of the levels on this unit.
  void draw(const gl::Program& program, const glm::dvec3& eye, std::span<const Block> blocks, int unit) const;
  // Gives a program of kLandFragment what the levels hold.
  void bind(const gl::Program& program, const glm::dvec3& eye, int unit) const;

 private:
  static constexpr int kBlocks = 8, kBlockCells = kCells / kBlocks;  // a side
  static constexpr int kWide = kTexels + 2;                          // heights a side: with a border for slopes
  // Indices of a level round the finer one inside it, which stands in its middle or two cells aside.
  struct Ring {
    std::array<Block, kBlocks * kBlocks> blocks{};
  };
  struct Heights {
    glm::dvec2 corner{0.0};
    std::vector<float> heights, woods;
  };
  struct Level : Heights {
    std::array<glm::vec2, kBlocks * kBlocks> range{};  // of the heights in and next to each block
  };
  static double cellOf(int level) { return kFinest * (1 << level); }
  static glm::dvec2 cornerAt(int level, const glm::dvec3& eye);
  // Of a level, what `known` of it holds taken over.
  Heights heightsAt(int level, const glm::dvec2& corner, const Heights& known) const;
  void upload(int level);
  static std::size_t stepIndex(int step) { return step == 1 ? 0 : 1; }
  const Ring& ringOf(int level) const;
  glm::vec4 cornerOf(int level, const glm::dvec3& eye) const;
  LandKind kindOf(const glm::dvec2& low, const glm::dvec2& high, const glm::vec2& range,
                  const glm::dvec3& aircraft) const;

  const gl::Api& gl_;
  const Terrain& terrain_;
  std::array<Level, kLevels> levels_;
  std::future<std::array<Heights, kLevels>> begun_;
  gl::Texture texture_;  // height, slopes to east and north, woods; a layer for each level
  int first_ = 0;        // the finest level that is drawn: from high up the finest ones show nothing
  float sunken_ = 0.0f;  // how far that one has taken the shape of the next
  int step_ = 1;         // from vertex to vertex, in cells
  std::array<std::array<Ring, 10>, 2> rings_;  // for every vertex and every second: whole, then by the hole's place
  GLuint array_ = 0, indices_ = 0;
};

}  // namespace welkin::viewer
