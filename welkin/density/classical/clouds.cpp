#include "welkin/density/classical/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include "welkin/base/parallel.hpp"
#include "welkin/density/classical/automaton.hpp"
#include "welkin/density/classical/balls.hpp"
#include "welkin/density/classical/ellipsoids.hpp"
#include "welkin/density/classical/height_map.hpp"
#include "welkin/density/classical/perlin_array.hpp"
#include "welkin/noise/law.hpp"

namespace welkin {

namespace {

constexpr double kWindowSteps = 16.0;  // of a height map's window, each a share of its length
constexpr float kTaper = 0.08f;        // share of the window over which a height map sinks to nothing at its sides
constexpr int kDetailOctaves = 4;

// Density from 0 to 1 at a point in m from the middle of the base, in the cloud's own axes.
using Density = std::function<float(const glm::vec3&)>;

std::uint32_t seedOf(const Classical& cloud, int sceneSeed) {
  return law::hashCell2(sceneSeed, cloud.cloud.seed, static_cast<std::uint32_t>(cloud.cloud.kind) + 0x51ED270Bu);
}

// From the cloud's own axes to those of the world, without its position.
glm::dvec2 turned(const Classical& cloud, const glm::dvec2& own) {
  const double s = std::sin(double(cloud.cloud.heading)), c = std::cos(double(cloud.cloud.heading));
  return {s * own.x - c * own.y, c * own.x + s * own.y};
}
glm::dvec2 turnedBack(const Classical& cloud, const glm::dvec2& world) {
  const double s = std::sin(double(cloud.cloud.heading)), c = std::cos(double(cloud.cloud.heading));
  return {s * world.x + c * world.y, -c * world.x + s * world.y};
}

// From the cloud's own axes, the middle of its base the origin, to the world before wind carries it.
glm::dmat4 placementOf(const Classical& cloud) {
  glm::dmat4 world = glm::translate(glm::dmat4(1.0), cloud.cloud.position);
  world[0] = glm::dvec4(turned(cloud, {1.0, 0.0}), 0.0, 0.0);
  world[1] = glm::dvec4(turned(cloud, {0.0, 1.0}), 0.0, 0.0);
  return world;
}

Density heightMapDensity(const Classical& cloud, const ClassicalMoment& moment, std::uint32_t seed) {
  const HeightMapSettings& s = cloud.heightMap;
  auto map = std::make_shared<const HeightMap>(bakeHeightMap(s, seed));
  const float base = heightOfCover(*map, s.cover), most = *std::max_element(map->heights.begin(), map->heights.end());
  const float scale = most > base ? 1.0f / (most - base) : 0.0f;
  const glm::vec3 size = cloud.cloud.size;
  // The window lies upwind of where it began.
  const glm::dvec2 window =
      -glm::dvec2(double(moment.east) * size.x, double(moment.north) * size.y) / (kWindowSteps * double(s.element));
  const float warp = s.warp, perElement = 1.0f / s.element;
  const float cells = 1.5f / static_cast<float>(s.squares);
  const int period = std::max(static_cast<int>(std::lround(static_cast<float>(s.elements) * cells)), 1);
  const double toCells = double(period) / s.elements;
  return [=](const glm::vec3& p) {
    glm::dvec2 at = glm::dvec2(p.x, p.y) * double(perElement) + window;
    if (warp > 0.0f) {
      const glm::dvec2 u =
          (at / double(s.elements) - glm::floor(at / double(s.elements))) * double(s.elements) * toCells;
      const auto bend = [&](std::uint32_t k) {
        return double(warp * law::perlinFbm2(glm::vec2(u), period, 3, 2, 0.5f, seed + k));
      };
      at += glm::dvec2(bend(101u), bend(211u));
    }
    const auto rim = [](float x, float length) {
      return law::smoothstep(0.0f, kTaper * length, 0.5f * length - std::abs(x));
    };
    const float height = (map->at(at.x, at.y) - base) * scale * rim(p.x, size.x) * rim(p.y, size.y);
    // How far below the top, as a share of the column's height: dense inside, as the source says.
    return height > 0.0f ? std::clamp((height - p.z / size.z) / std::max(height, 1e-6f), 0.0f, 1.0f) : 0.0f;
  };
}

Density automatonDensity(const Classical& cloud, std::vector<float> shares) {
  const AutomatonSettings& s = cloud.automaton;
  const glm::ivec3 n(s.width, s.breadth, s.height);
  const glm::vec3 size = cloud.cloud.size;
  auto values = std::make_shared<const std::vector<float>>(std::move(shares));
  return [=](const glm::vec3& p) {
    const glm::vec3 u = (p / size + glm::vec3(0.5f, 0.5f, 0.0f)) * glm::vec3(n) - 0.5f, low = glm::floor(u),
                    f = u - low;
    float sum = 0.0f;
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2), i = glm::ivec3(low) + step;
      if (i.x < 0 || i.y < 0 || i.z < 0 || i.x >= n.x || i.y >= n.y || i.z >= n.z) continue;
      const glm::vec3 w(step.x ? f.x : 1.0f - f.x, step.y ? f.y : 1.0f - f.y, step.z ? f.z : 1.0f - f.z);
      sum += w.x * w.y * w.z * (*values)[(std::size_t(i.z) * n.y + i.y) * n.x + i.x];
    }
    return sum;
  };
}

Density densityOf(const Classical& cloud, std::uint32_t seed) {
  const glm::vec3 size = cloud.cloud.size;
  switch (cloud.cloud.kind) {
    case ClassicalKind::perlin: {
      auto array = std::make_shared<const PerlinArray>(cloud.perlin, seed);
      return [=](const glm::vec3& p) { return array->density(p / size + glm::vec3(0.5f, 0.5f, 0.0f)); };
    }
    case ClassicalKind::metaballs: {
      auto balls = std::make_shared<const Balls>(makeMetaballs(cloud.metaballs, size, seed));
      return [=, s = cloud.metaballs](const glm::vec3& p) { return metaballDensity(*balls, s, p); };
    }
    case ClassicalKind::ellipsoids: {
      auto ellipsoids = std::make_shared<const TexturedEllipsoids>(cloud.ellipsoids, size, seed);
      return [=](const glm::vec3& p) { return ellipsoids->density(p); };
    }
    default: {
      auto balls = std::make_shared<const Balls>(makeParticles(cloud.particles, size, seed));
      return [=, s = cloud.particles](const glm::vec3& p) { return particleDensity(*balls, s, p); };
    }
  }
}

// What a noise and the edge make of a model's density. Nothing and full cloud stay.
float carved(float density, const ClassicalCloud& c, const glm::vec3& p, std::uint32_t seed) {
  if (!(density > 0.0f)) return 0.0f;
  float depth = density;
  if (c.detail > 0.0f) {
    // The billows' own range, from which they reach 0 and 1 nearly.
    const float noise =
        law::smoothstep(0.3f, 0.95f, law::billowFbm3(p / c.detailSize, 0, kDetailOctaves, 2, 0.5f, seed));
    const float cut = c.detail * (1.0f - noise);
    depth = (depth - cut) / (1.0f - std::min(cut, 0.99f));
  }
  return std::clamp(depth / c.edge, 0.0f, 1.0f);
}

// Voxels over the cloud's box with a margin of zeros, in the cloud's axes.
VoxelGrid voxelsOf(const Classical& cloud, const Density& density, std::uint32_t seed) {
  const glm::dvec3 size(cloud.cloud.size);
  const double edge = std::cbrt(size.x * size.y * size.z / cloud.cloud.voxels);
  const glm::ivec3 dims = glm::ivec3(glm::ceil(size / edge)) + 2;
  VoxelGrid grid(dims, glm::dvec3(-0.5 * size.x, -0.5 * size.y, 0.0) - edge, glm::dvec3(edge));
  const glm::ivec3 inside = dims - 2;
  const std::size_t layer = std::size_t(inside.x) * inside.y;
  std::vector<float> values(layer);
  for (int z = 0; z < inside.z; ++z) {
    parallelFor(layer, 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::ivec3 v(int(i % std::size_t(inside.x)), int(i / std::size_t(inside.x)), z);
        const glm::vec3 p(grid.origin() + (glm::dvec3(v) + 1.5) * edge);
        values[i] = carved(density(p), cloud.cloud, p, seed ^ 0xC2B2AE35u);
      }
    });
    for (std::size_t i = 0; i < layer; ++i)
      if (values[i] > 0.0f)
        grid.set({int(i % std::size_t(inside.x)) + 1, int(i / std::size_t(inside.x)) + 1, z + 1}, values[i]);
  }
  return grid;
}

}  // namespace

bool sameClassical(const Classical& a, const Classical& b) {
  return sameFields(a.cloud, b.cloud) && sameFields(a.heightMap, b.heightMap) && sameFields(a.perlin, b.perlin) &&
         sameFields(a.metaballs, b.metaballs) && sameFields(a.ellipsoids, b.ellipsoids) &&
         sameFields(a.particles, b.particles) && sameFields(a.automaton, b.automaton);
}

ClassicalMoment momentOf(const Classical& cloud, const Drift& drift) {
  ClassicalMoment moment;
  moment.carried = double(cloud.cloud.drift) * driftOffset(drift);
  if (cloud.cloud.kind == ClassicalKind::automaton)
    moment.step = static_cast<std::int64_t>(std::floor(std::max(drift.time, 0.0) / double(cloud.automaton.step)));
  if (cloud.cloud.kind == ClassicalKind::height_map) {
    // The window stands still but for a step of its own, while the map moves through it.
    const glm::dvec2 step = glm::dvec2(cloud.cloud.size) / kWindowSteps, own = turnedBack(cloud, moment.carried);
    const glm::dvec2 steps = glm::floor(own / step + 0.5);
    moment.east = static_cast<std::int64_t>(steps.x);
    moment.north = static_cast<std::int64_t>(steps.y);
    moment.carried -= turned(cloud, steps * step);
  }
  return moment;
}

WorldBox boxOf(const Classical& cloud, const Drift& drift) {
  const glm::dvec3 half = 0.5 * glm::dvec3(cloud.cloud.size);
  const double s = std::abs(std::sin(double(cloud.cloud.heading))), c = std::abs(std::cos(double(cloud.cloud.heading)));
  const glm::dvec3 reach(s * half.x + c * half.y, c * half.x + s * half.y, 0.0);
  const glm::dvec3 base = cloud.cloud.position + glm::dvec3(momentOf(cloud, drift).carried, 0.0);
  return {base - reach, base + reach + glm::dvec3(0.0, 0.0, 2.0 * half.z)};
}

struct ClassicalClouds::Entry {
  Classical cloud;
  int seed = 0;
  ClassicalMoment moment;
  PlacedGrid grid;
  std::unique_ptr<Automaton> automaton;
  std::vector<std::vector<std::uint64_t>> last;  // its clouds in the last steps, newest first

  std::vector<float> sharesAt(std::int64_t step);
};

// An automaton is the same function of time whichever way it has come there: it begins anew where it cannot go on.
std::vector<float> ClassicalClouds::Entry::sharesAt(std::int64_t step) {
  const AutomatonSettings& s = cloud.automaton;
  const std::int64_t goal = step + s.start;
  const std::size_t kept = std::size_t(s.memory) + 1;
  const auto keep = [&] {
    if (goal - automaton->steps() < static_cast<std::int64_t>(kept)) last.insert(last.begin(), automaton->clouds());
    if (last.size() > kept) last.resize(kept);
  };
  if (!automaton || automaton->steps() > goal) {
    automaton = std::make_unique<Automaton>(s, seedOf(cloud, seed));
    last.clear();
    keep();
  }
  while (automaton->steps() < goal) {
    automaton->advance();
    keep();
  }
  return smoothCloud(s, last);
}

ClassicalClouds::ClassicalClouds() = default;
ClassicalClouds::~ClassicalClouds() = default;
ClassicalClouds::ClassicalClouds(ClassicalClouds&&) noexcept = default;
ClassicalClouds& ClassicalClouds::operator=(ClassicalClouds&&) noexcept = default;

bool ClassicalClouds::update(std::span<const Classical> clouds, const Drift& drift, int seed) {
  bool changed = entries_.size() != clouds.size();
  entries_.resize(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    Entry& e = entries_[i];
    const Classical& cloud = clouds[i];
    const ClassicalMoment moment = momentOf(cloud, drift);
    const bool same = e.grid.voxels && e.seed == seed && sameClassical(e.cloud, cloud);
    if (!same) e = Entry{cloud, seed, {}, {}, nullptr, {}};
    const bool baked = same && e.moment.sameVoxels(moment);
    e.moment = moment;
    if (baked) continue;
    changed = true;
    const std::uint32_t own = seedOf(cloud, seed);
    const Density density = cloud.cloud.kind == ClassicalKind::automaton
                                ? automatonDensity(cloud, e.sharesAt(moment.step))
                            : cloud.cloud.kind == ClassicalKind::height_map ? heightMapDensity(cloud, moment, own)
                                                                            : densityOf(cloud, own);
    e.grid.voxels = std::make_shared<const VoxelGrid>(voxelsOf(cloud, density, own));
    e.grid.fromWorld = glm::inverse(placementOf(cloud));
    e.grid.extinction = cloud.cloud.extinction;
  }
  return changed;
}

const PlacedGrid& ClassicalClouds::still(std::size_t cloud) const { return entries_.at(cloud).grid; }
const glm::dvec2& ClassicalClouds::carried(std::size_t cloud) const { return entries_.at(cloud).moment.carried; }

std::size_t ClassicalClouds::count() const { return entries_.size(); }

std::vector<PlacedGrid> ClassicalClouds::placed() const {
  std::vector<PlacedGrid> grids;
  for (const Entry& e : entries_) {
    PlacedGrid grid = e.grid;
    grid.fromWorld = glm::translate(grid.fromWorld, -glm::dvec3(e.moment.carried, 0.0));
    grids.push_back(std::move(grid));
  }
  return grids;
}

}  // namespace welkin
