#include "apps/viewer/flight_view/model_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/angle.hpp"

namespace welkin::viewer {

namespace {

// Closed rows of points, one behind the other; normals by the differences of neighbours, `flip` where they would point
// inward.
void addTube(ModelMesh& mesh, Part part, const std::vector<std::vector<glm::vec3>>& rows, bool flip) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t n = rows.front().size();
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < n; ++i) {
      const glm::vec3 round = rows[r][(i + 1) % n] - rows[r][(i + n - 1) % n];
      const glm::vec3 along = rows[std::min(r + 1, rows.size() - 1)][i] - rows[r > 0 ? r - 1 : 0][i];
      glm::vec3 normal = glm::cross(along, round);
      const float size = glm::length(normal);
      normal = size > 1e-9f ? normal / size : glm::vec3(0.0f, 0.0f, -1.0f);
      mesh.vertices.push_back({rows[r][i], flip ? -normal : normal, static_cast<float>(part)});
    }
  for (std::size_t r = 0; r + 1 < rows.size(); ++r)
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = first + static_cast<std::uint32_t>(r * n + i),
                 b = first + static_cast<std::uint32_t>(r * n + (i + 1) % n);
      const auto m = static_cast<std::uint32_t>(n);
      for (const std::uint32_t index : {a, b, a + m, b, b + m, a + m}) mesh.indices.push_back(index);
    }
}

// Closes an end of a tube by a fan that faces `normal`.
void addCap(ModelMesh& mesh, Part part, const std::vector<glm::vec3>& rim, const glm::vec3& normal) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const glm::vec3& p : rim) mesh.vertices.push_back({p, normal, static_cast<float>(part)});
  for (std::uint32_t i = 1; i + 1 < rim.size(); ++i)
    for (const std::uint32_t index : {first, first + i, first + i + 1}) mesh.indices.push_back(index);
}

void addFace(ModelMesh& mesh, Part part, const std::vector<glm::vec3>& corners) {
  addCap(mesh, part, corners, glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
}

// Half thickness of a NACA four-digit section at the share `x` of its chord (closed trailing edge).
float thicknessAt(float x, float thickness) {
  return 5.0f * thickness * (0.2969f * std::sqrt(x) - x * (0.126f + x * (0.3516f - x * (0.2843f - 0.1036f * x))));
}

}  // namespace

void addBody(ModelMesh& mesh, Part part, const std::vector<BodySection>& sections) {
  constexpr int kRound = 28, kBetween = 4;
  std::vector<std::vector<glm::vec3>> rows;
  const auto rowAt = [&](const BodySection& s) {
    std::vector<glm::vec3> row;
    for (int i = 0; i < kRound; ++i) {
      const float t = 2.0f * kPiFloat * static_cast<float>(i) / kRound, c = std::cos(t), d = std::sin(t);
      const float e = 2.0f / s.square;
      row.emplace_back(s.x, s.halfWidth * std::copysign(std::pow(std::abs(c), e), c),
                       s.z + s.halfHeight * std::copysign(std::pow(std::abs(d), e), d));
    }
    return row;
  };
  // Catmull-Rom between the sections.
  const auto at = [&](std::size_t i, int offset) {
    const int j = std::clamp(static_cast<int>(i) + offset, 0, static_cast<int>(sections.size()) - 1);
    return sections[static_cast<std::size_t>(j)];
  };
  const auto spline = [](float a, float b, float c, float d, float t) {
    return 0.5f * (2.0f * b + t * (c - a + t * (2.0f * a - 5.0f * b + 4.0f * c - d + t * (3.0f * (b - c) + d - a))));
  };
  for (std::size_t i = 0; i + 1 < sections.size(); ++i)
    for (int k = 0; k < kBetween; ++k) {
      const float t = static_cast<float>(k) / kBetween;
      const BodySection a = at(i, -1), b = at(i, 0), c = at(i, 1), d = at(i, 2);
      rows.push_back(rowAt({b.x + t * (c.x - b.x), spline(a.z, b.z, c.z, d.z, t),
                            std::max(spline(a.halfWidth, b.halfWidth, c.halfWidth, d.halfWidth, t), 0.01f),
                            std::max(spline(a.halfHeight, b.halfHeight, c.halfHeight, d.halfHeight, t), 0.01f),
                            spline(a.square, b.square, c.square, d.square, t)}));
    }
  rows.push_back(rowAt(sections.back()));
  addTube(mesh, part, rows, false);
  addCap(mesh, part, rows.front(), {1.0f, 0.0f, 0.0f});
  addCap(mesh, part, rows.back(), {-1.0f, 0.0f, 0.0f});
}

void addWing(ModelMesh& mesh, Part part, const std::vector<WingSection>& sections, bool upright) {
  constexpr int kHalf = 11;
  std::vector<std::vector<glm::vec3>> rows;
  for (const WingSection& s : sections) {
    std::vector<glm::vec3> row;
    for (int i = 0; i < 2 * kHalf; ++i) {
      // From the trailing edge along one side to the leading edge and back, closer together in front.
      const float share = static_cast<float>(i) / kHalf;
      const float x = 0.5f + 0.5f * std::cos(kPiFloat * share);
      const float half = std::copysign(thicknessAt(x, s.thickness), i <= kHalf ? 1.0f : -1.0f);
      const glm::vec3 side = upright ? glm::vec3(0.0f, half, 0.0f) : glm::vec3(0.0f, 0.0f, half);
      row.push_back(s.leadingEdge + s.chord * (glm::vec3(-x, 0.0f, 0.0f) - side));
    }
    rows.push_back(row);
  }
  const glm::vec3 span = sections.back().leadingEdge - sections.front().leadingEdge;
  const bool flip = upright ? span.z > 0.0f : span.y < 0.0f;
  addTube(mesh, part, rows, flip);
  const glm::vec3 outward = glm::normalize(upright ? glm::vec3(0.0f, 0.0f, span.z) : glm::vec3(0.0f, span.y, 0.0f));
  addCap(mesh, part, rows.front(), -outward);
  addCap(mesh, part, rows.back(), outward);
}

void addRod(ModelMesh& mesh, Part part, const glm::vec3& from, const glm::vec3& to, float radius) {
  const glm::vec3 along = glm::normalize(to - from);
  const glm::vec3 side =
      glm::normalize(glm::cross(along, std::abs(along.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
  const glm::vec3 other = glm::cross(along, side);
  constexpr int kRound = 16;
  std::vector<std::vector<glm::vec3>> rows(2);
  for (int i = 0; i < kRound; ++i) {
    const float t = 2.0f * kPiFloat * static_cast<float>(i) / kRound;
    const glm::vec3 out = radius * (std::cos(t) * side + std::sin(t) * other);
    rows[0].push_back(from + out);
    rows[1].push_back(to + out);
  }
  addTube(mesh, part, rows, true);
  addCap(mesh, part, rows[0], -along);
  addCap(mesh, part, rows[1], along);
}

void addHouse(ModelMesh& mesh, const glm::vec3& floor, const glm::vec3& size, float ridge) {
  const glm::vec3 h(0.5f * size.x, 0.5f * size.y, 0.0f);
  const auto at = [&](float x, float y, float z) { return floor + glm::vec3(x * h.x, y * h.y, z); };
  const float eaves = size.z, top = size.z + ridge, foot = -3.0f;
  addFace(mesh, Part::wall, {at(-1, -1, foot), at(1, -1, foot), at(1, -1, eaves), at(-1, -1, eaves)});
  addFace(mesh, Part::wall, {at(1, 1, foot), at(-1, 1, foot), at(-1, 1, eaves), at(1, 1, eaves)});
  addFace(mesh, Part::wall, {at(1, -1, foot), at(1, 1, foot), at(1, 1, eaves), at(1, 0, top), at(1, -1, eaves)});
  addFace(mesh, Part::wall, {at(-1, 1, foot), at(-1, -1, foot), at(-1, -1, eaves), at(-1, 0, top), at(-1, 1, eaves)});
  addFace(mesh, Part::roof, {at(-1, -1, eaves), at(1, -1, eaves), at(1, 0, top), at(-1, 0, top)});
  addFace(mesh, Part::roof, {at(1, 1, eaves), at(-1, 1, eaves), at(-1, 0, top), at(1, 0, top)});
}

ModelMesh aircraftMesh() {
  ModelMesh mesh;
  addBody(mesh, Part::fuselage,
          {{2.3f, 0.1f, 0.3f, 0.3f, 2.2f},
           {2.1f, 0.1f, 0.43f, 0.43f, 2.4f},
           {1.3f, 0.09f, 0.54f, 0.5f, 2.7f},
           {0.95f, 0.03f, 0.57f, 0.56f, 2.9f},
           {0.4f, -0.22f, 0.59f, 0.81f, 3.2f},
           {-0.6f, -0.23f, 0.59f, 0.8f, 3.2f},
           {-1.4f, -0.22f, 0.52f, 0.7f, 3.0f},
           {-2.4f, -0.22f, 0.37f, 0.48f, 2.6f},
           {-3.8f, -0.26f, 0.2f, 0.28f, 2.2f},
           {-5.2f, -0.32f, 0.06f, 0.12f, 2.0f}});
  addBody(mesh, Part::spinner,
          {{2.72f, 0.1f, 0.03f, 0.03f, 2.0f}, {2.6f, 0.1f, 0.13f, 0.13f, 2.0f}, {2.3f, 0.1f, 0.21f, 0.21f, 2.0f}});
  for (const float side : {-1.0f, 1.0f}) {
    addWing(mesh, Part::wing,
            {{{0.75f, 0.0f, -1.0f}, 1.65f, 0.14f},
             {{0.75f, side * 2.6f, -1.06f}, 1.65f, 0.14f},
             {{0.70f, side * 3.2f, -1.08f}, 1.52f, 0.13f},
             {{0.69f, side * 3.22f, -1.08f}, 1.52f, 0.13f},
             {{0.56f, side * 5.2f, -1.14f}, 1.18f, 0.12f},
             {{0.50f, side * 5.45f, -1.15f}, 1.0f, 0.09f},
             {{0.40f, side * 5.5f, -1.15f}, 0.75f, 0.04f}},
            false);
    addWing(mesh, Part::tail,
            {{{-4.25f, 0.0f, -0.34f}, 1.0f, 0.1f},
             {{-4.45f, side * 1.6f, -0.34f}, 0.72f, 0.09f},
             {{-4.55f, side * 1.7f, -0.34f}, 0.5f, 0.05f}},
            false);
    addRod(mesh, Part::dark, {0.12f, side * 0.57f, 0.42f}, {0.2f, side * 2.6f, -1.0f}, 0.045f);
    addRod(mesh, Part::dark, {0.98f, side * 0.53f, -0.42f}, {0.5f, side * 0.56f, -0.98f}, 0.03f);
    addRod(mesh, Part::dark, {-0.3f, side * 0.45f, 0.5f}, {-0.42f, side * 1.2f, 1.05f}, 0.045f);
    addRod(mesh, Part::wheel, {-0.42f, side * 1.16f, 1.06f}, {-0.42f, side * 1.34f, 1.06f}, 0.22f);
  }
  addRod(mesh, Part::dark, {1.4f, 0.0f, 0.5f}, {1.35f, 0.0f, 1.05f}, 0.05f);
  addRod(mesh, Part::wheel, {1.35f, -0.07f, 1.08f}, {1.35f, 0.07f, 1.08f}, 0.2f);
  addWing(mesh, Part::fin,
          {{{-3.7f, 0.0f, -0.4f}, 1.65f, 0.09f},
           {{-4.35f, 0.0f, -0.9f}, 1.05f, 0.09f},
           {{-4.75f, 0.0f, -1.85f}, 0.62f, 0.08f}},
          true);
  return mesh;
}

ModelMesh airfieldMesh() {
  ModelMesh mesh;
  addHouse(mesh, {-120.0f, 165.0f, 0.0f}, {38.0f, 26.0f, 7.0f}, 3.0f);
  addHouse(mesh, {-70.0f, 165.0f, 0.0f}, {38.0f, 26.0f, 7.0f}, 3.0f);
  addHouse(mesh, {-10.0f, 172.0f, 0.0f}, {46.0f, 14.0f, 5.0f}, 2.2f);
  addHouse(mesh, {45.0f, 168.0f, 0.0f}, {7.0f, 7.0f, 14.0f}, 0.1f);
  addHouse(mesh, {45.0f, 168.0f, 14.0f}, {10.0f, 10.0f, 3.4f}, 1.2f);
  addHouse(mesh, {110.0f, 190.0f, 0.0f}, {16.0f, 9.0f, 4.0f}, 2.5f);
  return mesh;
}

}  // namespace welkin::viewer
