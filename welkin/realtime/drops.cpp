#include "welkin/realtime/drops.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace welkin::realtime {

namespace {

constexpr float kMostCells = 40.0f;  // from the eye outward: a narrow picture does not reach for all of its particles
constexpr float kSeen = 0.6f;        // share of the drawn particles that the picture shows; cells at its rim stick out

struct Pyramid {
  std::array<glm::vec3, 4> inward{};  // normals of its sides
  int sides = 0;                      // 0 for a panorama
  float solidAngle = 12.566371f;      // sr
};

Pyramid pyramidOf(const FrameParams& view) {
  Pyramid p;
  if (view.camera.forward.w > 0.5f) return p;
  const glm::vec3 forward(view.camera.forward), right(view.camera.right), above(view.camera.above);
  p.sides = 4;
  const std::array<glm::vec3, 4> normals{glm::cross(above, forward - right), glm::cross(forward + right, above),
                                         glm::cross(forward - above, right), glm::cross(right, forward + above)};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::vec3 n = glm::normalize(normals[i]);
    p.inward[i] = glm::dot(n, forward) < 0.0f ? -n : n;
  }
  const float x = glm::length(right), y = glm::length(above);
  p.solidAngle = 4.0f * std::atan(x * y / std::sqrt(1.0f + x * x + y * y));
  return p;
}

}  // namespace

DropLevels dropLevels(const Precipitation& precipitation, const FrameParams& view, float altitude) {
  DropLevels l;
  l.falling = fallingAt(precipitation, altitude);
  const float each = kSeen * static_cast<float>(precipitation.particles) / kDropLevels;
  if (each < 1.0f) return l;
  const float edge = std::cbrt(kDropsPerCell / l.falling.count);
  const float reach =
      std::min(std::cbrt(3.0f * each / (l.falling.count * pyramidOf(view).solidAngle)), kMostCells * edge);
  for (int k = 0; k < kDropLevels; ++k) {
    l.reach[k] = std::ldexp(reach, k);
    l.edge[k] = std::ldexp(edge, k);
  }
  return l;
}

std::vector<glm::vec4> dropCells(const DropLevels& levels, const FrameParams& view, const glm::vec3& up, float altitude,
                                 std::size_t most) {
  std::vector<glm::vec4> cells;
  const Pyramid pyramid = pyramidOf(view);
  for (int k = 0; k < kDropLevels && levels.reach[k] > 0.0f; ++k) {
    const float edge = levels.edge[k], far = levels.reach[k],
                near = k > 0 ? law::kRainFade * levels.reach[k - 1] : 0.0f;
    const int n = static_cast<int>(std::ceil(far / edge)) + 1;
    const std::size_t first = cells.size();
    for (int z = -n; z <= n; ++z)
      for (int y = -n; y <= n; ++y) {
        // Of a row, what the sides of the picture leave; particles stand within an edge of the cell's corner, and that
        // up to an edge before this point.
        float low = static_cast<float>(-n), high = static_cast<float>(n);
        for (int side = 0; side < pyramid.sides; ++side) {
          const glm::vec3& normal = pyramid.inward[static_cast<std::size_t>(side)];
          const float rest = normal.y * static_cast<float>(y) + normal.z * static_cast<float>(z) + std::abs(normal.x) +
                             std::abs(normal.y) + std::abs(normal.z);
          if (normal.x > 0.0f)
            low = std::max(low, -rest / normal.x);
          else if (normal.x < 0.0f)
            high = std::min(high, -rest / normal.x);
          else if (rest < 0.0f)
            high = low - 1.0f;
        }
        for (int x = static_cast<int>(std::ceil(low)); static_cast<float>(x) <= high; ++x) {
          const glm::vec3 middle = edge * glm::vec3(x, y, z), away = glm::abs(middle);
          if (glm::length(glm::max(away - edge, 0.0f)) > far || glm::length(away + edge) < near) continue;
          if (altitude + glm::dot(up, middle) + 1.8f * edge > 0.0f) cells.emplace_back(x, y, z, k);
        }
      }
    std::sort(cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end(), [](const auto& a, const auto& b) {
      const glm::vec3 p(a), q(b);
      return glm::dot(p, p) != glm::dot(q, q) ? glm::dot(p, p) < glm::dot(q, q)
                                              : std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
    });
  }
  if (cells.size() > most) cells.resize(most);
  return cells;
}

std::array<law::DropClass, kDropLevels * kFallClasses> dropClasses(const DropLevels& levels, const glm::dvec3& eye,
                                                                   const glm::dvec3& up, const glm::dvec2& wind,
                                                                   const glm::dvec3& velocity, double time) {
  std::array<law::DropClass, kDropLevels * kFallClasses> all{};
  for (int i = 0; i < kFallClasses; ++i) {
    const FallClass& fall = levels.falling.classes[static_cast<std::size_t>(i)];
    const glm::dvec3 own = glm::dvec3(wind, 0.0) - up * static_cast<double>(fall.speed);
    for (int k = 0; k < kDropLevels && levels.edge[k] > 0.0f; ++k) {
      law::DropClass& c = all[static_cast<std::size_t>(k) * kFallClasses + static_cast<std::size_t>(i)];
      const glm::dvec3 inAir = (eye - own * time) / static_cast<double>(levels.edge[k]), cell = glm::floor(inAir);
      const auto number = [](double x) { return static_cast<int>(std::fmod(x, 2147483648.0)); };
      c.start = glm::vec4(glm::vec3(cell - inAir), fall.diameter * 0.001f);
      c.velocity = glm::vec4(glm::vec3(own - velocity), 0.0f);
      c.cellX = number(cell.x);
      c.cellY = number(cell.y);
      c.cellZ = number(cell.z);
      c.flake = fall.snow > 0.5f ? 1 : 0;
    }
  }
  return all;
}

}  // namespace welkin::realtime
