#include "apps/viewer/flight_view/land_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

#include "apps/viewer/flight_view/buffer_offset.hpp"
#include "welkin/base/parallel.hpp"

namespace welkin::viewer {

namespace {

constexpr double kEarth = 6360e3;  // m

// Whether a box that is given by its corners may show.
bool maySee(const glm::mat4& clip, const glm::vec3& low, const glm::vec3& high) {
  int out[5] = {};
  for (int i = 0; i < 8; ++i) {
    const glm::vec4 p = clip * glm::vec4(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z, 1.0f);
    out[0] += p.x < -p.w;
    out[1] += p.x > p.w;
    out[2] += p.y < -p.w;
    out[3] += p.y > p.w;
    out[4] += p.w <= 0.0f;
  }
  return std::none_of(std::begin(out), std::end(out), [](int n) { return n == 8; });
}

}  // namespace

LandMesh::LandMesh(const gl::Api& gl, const Terrain& terrain) : gl_(gl), terrain_(terrain) {
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(kCells) * kCells * 6);
  for (int block = 0; block < kBlocks * kBlocks; ++block)
    for (int y = 0; y < kBlockCells; ++y)
      for (int x = 0; x < kBlockCells; ++x) {
        const int i = block % kBlocks * kBlockCells + x, j = block / kBlocks * kBlockCells + y;
        const auto at = static_cast<std::uint32_t>(j * (kCells + 1) + i), up = at + kCells + 1;
        // The diagonal runs from lower right to upper left, as the vertex shader's morph has it.
        for (const std::uint32_t index : {at, at + 1, up, at + 1, up + 1, up}) indices.push_back(index);
      }
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.GenBuffers(1, &indices_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                indices.data(), GL_STATIC_DRAW);
  gl.BindVertexArray(0);
}

LandMesh::~LandMesh() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(1, &indices_);
}

void LandMesh::update(const glm::dvec3& eye) {
  for (int l = 0; l < kLevels; ++l) {
    const double snap = 2.0 * cellOf(l);
    const glm::dvec2 centre(std::round(eye.x / snap) * snap, std::round(eye.y / snap) * snap);
    const glm::dvec2 corner = centre - 0.5 * kCells * cellOf(l);
    Level& level = levels_[static_cast<std::size_t>(l)];
    if (!level.made || level.corner != corner) make(l, corner);
  }
}

void LandMesh::make(int index, const glm::dvec2& corner) {
  Level& level = levels_[static_cast<std::size_t>(index)];
  level.corner = corner;
  level.made = true;
  const double spacing = 0.5 * cellOf(index);
  constexpr int kWide = kTexels + 2;  // with a border for slopes
  std::vector<float> heights(static_cast<std::size_t>(kWide) * kWide);
  std::vector<float> texels(static_cast<std::size_t>(kTexels) * kTexels * 4);
  const auto at = [&](int x, int y) -> float& { return heights[static_cast<std::size_t>(y + 1) * kWide + x + 1]; };
  parallelFor(kWide, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int x = -1; x <= kTexels; ++x) {
        const int y = static_cast<int>(row) - 1;
        const double east = corner.x + spacing * x, north = corner.y + spacing * y;
        at(x, y) = static_cast<float>(terrain_.height(east, north));
        if (x >= 0 && x < kTexels && y >= 0 && y < kTexels)
          texels[(static_cast<std::size_t>(y) * kTexels + x) * 4 + 3] = static_cast<float>(terrain_.woods(east, north));
      }
  });
  const auto twice = static_cast<float>(2.0 * spacing);
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      float* t = &texels[(static_cast<std::size_t>(y) * kTexels + x) * 4];
      t[0] = at(x, y);
      t[1] = (at(x + 1, y) - at(x - 1, y)) / twice;
      t[2] = (at(x, y + 1) - at(x, y - 1)) / twice;
    }
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    glm::vec2 range(std::numeric_limits<float>::max(), 0.0f);
    const int x0 = block % kBlocks * 2 * kBlockCells, y0 = block / kBlocks * 2 * kBlockCells;
    for (int y = y0; y <= y0 + 2 * kBlockCells; ++y)
      for (int x = x0; x <= x0 + 2 * kBlockCells; ++x) {
        range.x = std::min(range.x, std::max(at(x, y), 0.0f));
        range.y = std::max(range.y, at(x, y));
      }
    level.heights[static_cast<std::size_t>(block)] = range;
  }
  level.texture = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba32F, kTexels, kTexels, 0, gl::Filter::linear,
                              gl::Addressing::clamp, texels.data());
}

void LandMesh::draw(const gl::Program& program, const glm::dvec3& eye, const glm::mat4& clip, int firstUnit) const {
  gl_.BindVertexArray(array_);
  gl_.Uniform1i(program.uniform("uLevel"), firstUnit);
  gl_.Uniform1i(program.uniform("uCoarser"), firstUnit + 1);
  for (int l = 0; l < kLevels; ++l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    const Level& coarser = levels_[static_cast<std::size_t>(std::min(l + 1, kLevels - 1))];
    const double cell = cellOf(l);
    const glm::vec2 corner(level.corner - glm::dvec2(eye)), coarseCorner(coarser.corner - glm::dvec2(eye));
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(firstUnit));
    gl_.BindTexture(GL_TEXTURE_2D, level.texture.id());
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(firstUnit + 1));
    gl_.BindTexture(GL_TEXTURE_2D, coarser.texture.id());
    gl_.Uniform4f(program.uniform("uCorner"), corner.x, corner.y, static_cast<float>(cell),
                  l + 1 < kLevels ? 1.0f : 0.0f);
    gl_.Uniform3f(program.uniform("uCoarseCorner"), coarseCorner.x, coarseCorner.y,
                  static_cast<float>(l + 1 < kLevels ? 2.0 * cell : cell));
    // What the finer level covers, but for a hair's breadth against gaps.
    glm::vec4 hole(1.0f, 1.0f, -1.0f, -1.0f);
    if (l > 0) {
      const double inside = 0.01 * cell, width = kCells * cellOf(l - 1);
      const glm::dvec2 low = levels_[static_cast<std::size_t>(l - 1)].corner - glm::dvec2(eye) + inside;
      hole = glm::vec4(glm::vec2(low), glm::vec2(low + width - 2.0 * inside));
    }
    gl_.Uniform4f(program.uniform("uHole"), hole.x, hole.y, hole.z, hole.w);
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      const double side = kBlockCells * cell;
      const glm::vec2 low = corner + glm::vec2(static_cast<float>(side * (block % kBlocks)),
                                               static_cast<float>(side * (block / kBlocks)));
      const glm::vec2 high = low + static_cast<float>(side);
      if (low.x > hole.x && low.y > hole.y && high.x < hole.z && high.y < hole.w) continue;
      const glm::vec2 range = level.heights[static_cast<std::size_t>(block)];
      const glm::vec2 farthest = glm::max(glm::abs(low), glm::abs(high));
      const double sunk = static_cast<double>(farthest.x * farthest.x + farthest.y * farthest.y) / (2.0 * kEarth);
      const auto under = static_cast<float>(eye.z + sunk);
      if (!maySee(clip, glm::vec3(low, range.x - under), glm::vec3(high, range.y - static_cast<float>(eye.z))))
        continue;
      constexpr std::size_t kCount = static_cast<std::size_t>(kBlockCells) * kBlockCells * 6;
      const std::size_t offset = static_cast<std::size_t>(block) * kCount * sizeof(std::uint32_t);
      gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(kCount), GL_UNSIGNED_INT, bufferOffset(offset));
    }
  }
}

}  // namespace welkin::viewer
