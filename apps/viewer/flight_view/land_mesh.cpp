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
// From so many cells of a level up, over the ground, the next one begins to take its place, and has it.
constexpr double kHigh = 60.0, kHighest = 80.0;
constexpr double kShadeReach = 500.0;   // m from the aircraft to its shadow: land_shader.hpp
constexpr double kRunwayReach = 260.0;  // m beyond the runway's edges that are evened: the same
constexpr int kCoarseWidth = 480;       // pixels of a picture below which half of the vertices will do
constexpr float kShore = 0.4f;          // m about the sea's level between which there is both: the same

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

LandMesh::LandMesh(const gl::Api& gl, const Terrain& terrain, const glm::dvec3& eye)
    : gl_(gl), terrain_(terrain), texture_(gl, gl::Texture::Kind::array, gl::kRgba32F, kTexels, kTexels, kLevels,
                                           gl::Filter::linear, gl::Addressing::clamp, nullptr) {
  begun_ = std::async(std::launch::async, [this, eye] {
    std::array<Heights, kLevels> all;
    for (int l = 0; l < kLevels; ++l) all[static_cast<std::size_t>(l)] = heightsAt(l, cornerAt(l, eye), {});
    return all;
  });
  std::vector<std::uint16_t> indices;
  // A hole leaves its outermost cells to both, against gaps.
  const auto add = [&](Ring& ring, int step, const glm::ivec2& low, const glm::ivec2& high) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      Block& b = ring.blocks[static_cast<std::size_t>(block)];
      b.offset = indices.size() * sizeof(std::uint16_t);
      for (int y = 0; y < kBlockCells; y += step)
        for (int x = 0; x < kBlockCells; x += step) {
          const int i = block % kBlocks * kBlockCells + x, j = block / kBlocks * kBlockCells + y;
          if (i > low.x && j > low.y && i < high.x - step && j < high.y - step) continue;
          const int at = j * (kCells + 1) + i, up = at + step * (kCells + 1);
          // The diagonal runs from lower right to upper left, as the vertex shader's morph has it.
          for (const int index : {at, at + step, up, at + step, up + step, up})
            indices.push_back(static_cast<std::uint16_t>(index));
        }
      b.count = static_cast<GLsizei>(indices.size() - b.offset / sizeof(std::uint16_t));
    }
  };
  for (const int step : {1, 2}) {
    std::array<Ring, 10>& rings = rings_[stepIndex(step)];
    add(rings[0], step, glm::ivec2(0), glm::ivec2(0));
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const glm::ivec2 low = glm::ivec2(kCells / 4) + 2 * (glm::ivec2(x, y) - 1);
        const int ring = 1 + 3 * y + x;
        add(rings[static_cast<std::size_t>(ring)], step, low, low + kCells / 2);
      }
  }
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.GenBuffers(1, &indices_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                indices.data(), GL_STATIC_DRAW);
  gl.BindVertexArray(0);
}

LandMesh::~LandMesh() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(1, &indices_);
}

void LandMesh::update(const glm::dvec3& eye, int width) {
  step_ = width < kCoarseWidth ? 2 : 1;
  const double above = eye.z - std::max(terrain_.height(eye.x, eye.y), 0.0);
  first_ = 0;
  while (first_ + 2 < kLevels && above > kHighest * cellOf(first_)) ++first_;
  sunken_ = static_cast<float>(std::clamp((above / cellOf(first_) - kHigh) / (kHighest - kHigh), 0.0, 1.0));
  if (begun_.valid()) {
    std::array<Heights, kLevels> begun = begun_.get();
    for (int l = 0; l < kLevels; ++l) {
      static_cast<Heights&>(levels_[static_cast<std::size_t>(l)]) = std::move(begun[static_cast<std::size_t>(l)]);
      upload(l);
    }
  }
  for (int l = first_; l < kLevels; ++l) {
    Level& level = levels_[static_cast<std::size_t>(l)];
    const glm::dvec2 corner = cornerAt(l, eye);
    if (level.corner == corner) continue;
    static_cast<Heights&>(level) = heightsAt(l, corner, level);
    upload(l);
  }
}

glm::dvec2 LandMesh::cornerAt(int level, const glm::dvec3& eye) {
  const double snap = 4.0 * cellOf(level);  // every second vertex falls on one of the next level
  const glm::dvec2 centre(std::round(eye.x / snap) * snap, std::round(eye.y / snap) * snap);
  return centre - 0.5 * kCells * cellOf(level);
}

LandMesh::Heights LandMesh::heightsAt(int level, const glm::dvec2& corner, const Heights& known) const {
  const double spacing = 0.5 * cellOf(level);
  // So many texels aside.
  const glm::dvec2 aside = (corner - known.corner) / spacing;
  const bool some = !known.heights.empty() && std::max(std::abs(aside.x), std::abs(aside.y)) < kWide;
  const int right = some ? static_cast<int>(std::lround(aside.x)) : kWide,
            up = some ? static_cast<int>(std::lround(aside.y)) : kWide;
  constexpr std::size_t kCount = static_cast<std::size_t>(kWide) * kWide;
  Heights now{corner, std::vector<float>(kCount), std::vector<float>(kCount)};
  const auto place = [](int x, int y) { return static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x); };
  parallelFor(kWide, 4, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < kWide; ++x) {
        const int fromX = x + right, fromY = y + up;
        if (fromX >= 0 && fromX < kWide && fromY >= 0 && fromY < kWide) {
          now.heights[place(x, y)] = known.heights[place(fromX, fromY)];
          now.woods[place(x, y)] = known.woods[place(fromX, fromY)];
        } else {
          const double east = corner.x + spacing * (x - 1), north = corner.y + spacing * (y - 1);
          now.heights[place(x, y)] = static_cast<float>(terrain_.height(east, north));
          now.woods[place(x, y)] = static_cast<float>(terrain_.woods(east, north));
        }
      }
  });
  return now;
}

void LandMesh::upload(int index) {
  Level& level = levels_[static_cast<std::size_t>(index)];
  const auto place = [](int x, int y) { return static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x); };
  const auto at = [&](int x, int y) { return level.heights[place(x + 1, y + 1)]; };
  std::vector<float> texels(static_cast<std::size_t>(kTexels) * kTexels * 4);
  const auto twice = static_cast<float>(cellOf(index));  // m between every second texel
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      float* t = &texels[(static_cast<std::size_t>(y) * kTexels + static_cast<std::size_t>(x)) * 4];
      t[0] = at(x, y);
      t[1] = (at(x + 1, y) - at(x - 1, y)) / twice;
      t[2] = (at(x, y + 1) - at(x, y - 1)) / twice;
      t[3] = level.woods[place(x + 1, y + 1)];
    }
  // The next level, which shows through towards the edge, may have its texels four aside.
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    glm::vec2 range(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());
    const int x0 = block % kBlocks * 2 * kBlockCells, y0 = block / kBlocks * 2 * kBlockCells;
    for (int y = std::max(y0 - 4, -1); y <= std::min(y0 + 2 * kBlockCells + 4, kTexels); ++y)
      for (int x = std::max(x0 - 4, -1); x <= std::min(x0 + 2 * kBlockCells + 4, kTexels); ++x) {
        range.x = std::min(range.x, at(x, y));
        range.y = std::max(range.y, at(x, y));
      }
    level.range[static_cast<std::size_t>(block)] = range;
  }
  gl_.BindTexture(texture_.target(), texture_.id());
  gl_.TexSubImage3D(texture_.target(), 0, 0, 0, index, kTexels, kTexels, 1, GL_RGBA, GL_FLOAT, texels.data());
}

const LandMesh::Ring& LandMesh::ringOf(int index) const {
  const std::array<Ring, 10>& rings = rings_[stepIndex(step_)];
  if (index == first_) return rings[0];
  const Level &level = levels_[static_cast<std::size_t>(index)], &finer = levels_[static_cast<std::size_t>(index) - 1];
  const glm::dvec2 hole = 0.5 * ((finer.corner - level.corner) / cellOf(index) - kCells / 4.0) + 1.0;
  return rings[static_cast<std::size_t>(1 + 3 * std::lround(hole.y) + std::lround(hole.x))];
}

LandKind LandMesh::kindOf(const glm::dvec2& low, const glm::dvec2& high, const glm::vec2& range,
                          const glm::dvec3& aircraft) const {
  // The runway, which may lie aslant: by the circle round it.
  const Runway& runway = terrain_.runway();
  const glm::dvec2 toRunway = glm::clamp(glm::dvec2(0.0), low, high),
                   toAircraft = glm::clamp(glm::dvec2(aircraft), low, high) - glm::dvec2(aircraft);
  const double above = std::max(aircraft.z - static_cast<double>(std::max(range.y, 0.0f)), 0.0);
  const bool close = glm::length(toRunway) < std::hypot(0.5 * runway.length, 0.5 * runway.width) + kRunwayReach ||
                     std::hypot(toAircraft.x, toAircraft.y, above) < kShadeReach;
  if (range.x > kShore) return close ? LandKind::closeLand : LandKind::land;
  if (close) return LandKind::closeShore;
  return range.y < -kShore ? LandKind::sea : LandKind::shore;
}

LandMesh::Blocks LandMesh::inSight(const glm::dvec3& eye, const glm::mat4& clip, const glm::dvec3& aircraft) const {
  Blocks blocks;
  for (int l = first_; l < kLevels; ++l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    const Ring& ring = ringOf(l);
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      Block b = ring.blocks[static_cast<std::size_t>(block)];
      if (b.count == 0) continue;
      b.level = l;
      const double side = kBlockCells * cellOf(l);
      const glm::dvec2 low = level.corner + side * glm::dvec2(block % kBlocks, block / kBlocks), high = low + side;
      const glm::vec2 range = level.range[static_cast<std::size_t>(block)], from(low - glm::dvec2(eye)),
                      to(high - glm::dvec2(eye));
      const glm::vec2 farthest = glm::max(glm::abs(from), glm::abs(to));
      const double sunk = static_cast<double>(farthest.x * farthest.x + farthest.y * farthest.y) / (2.0 * kEarth);
      if (maySee(clip, glm::vec3(from, std::max(range.x, 0.0f) - static_cast<float>(eye.z + sunk)),
                 glm::vec3(to, std::max(range.y, 0.0f) - static_cast<float>(eye.z))))
        blocks[static_cast<std::size_t>(kindOf(low, high, range, aircraft))].push_back(b);
    }
  }
  return blocks;
}

// From the eye; the size of a cell; how far the level has taken the shape of the next one throughout.
glm::vec4 LandMesh::cornerOf(int level, const glm::dvec3& eye) const {
  const glm::vec2 corner(levels_[static_cast<std::size_t>(level)].corner - glm::dvec2(eye));
  return {corner, static_cast<float>(cellOf(level)), level == first_ ? sunken_ : 0.0f};
}

void LandMesh::draw(const gl::Program& program, const glm::dvec3& eye, std::span<const Block> blocks, int unit) const {
  gl_.BindVertexArray(array_);
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(texture_.target(), texture_.id());
  gl_.Uniform1i(program.uniform("uLand"), unit);
  gl_.Uniform1i(program.uniform("uStep"), step_);
  int now = -1;
  for (const Block& block : blocks) {
    if (block.level != now) {
      now = block.level;
      const glm::vec4 corner = cornerOf(now, eye);
      gl_.Uniform4f(program.uniform("uCorner"), corner.x, corner.y, corner.z, corner.w);
      gl_.Uniform2f(program.uniform("uLevel"), static_cast<float>(now), now + 1 < kLevels ? 1.0f : 0.0f);
    }
    gl_.DrawElements(GL_TRIANGLES, block.count, GL_UNSIGNED_SHORT, bufferOffset(block.offset));
  }
}

void LandMesh::bind(const gl::Program& program, const glm::dvec3& eye, int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(texture_.target(), texture_.id());
  gl_.Uniform1i(program.uniform("uLand"), unit);
  std::array<glm::vec4, kLevels> corners;
  for (int l = 0; l < kLevels; ++l) corners[static_cast<std::size_t>(l)] = cornerOf(l, eye);
  gl_.Uniform4fv(program.uniform("uCorners"), kLevels, &corners.front().x);
  gl_.Uniform3f(program.uniform("uFirst"), static_cast<float>(first_), static_cast<float>(kLevels - 1),
                static_cast<float>(kFinest));
}

}  // namespace welkin::viewer
