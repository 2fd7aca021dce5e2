#include "apps/welkin/volume_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "apps/welkin/usage_error.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/clear_air.hpp"
#include "welkin/scene/scatterers.hpp"

namespace welkin::app {

namespace {

constexpr double kWaterDensity = 1e6;  // g/m^3
// Of large droplets (Bohren and Huffman 1983, ch. 4.4.3): twice their cross section.
constexpr double kExtinctionEfficiency = 2.0;
constexpr double kFarthest = 1e7;  // m
constexpr int kFewCells = 1000;    // of a hero cloud's shape, where its box alone is asked for

std::vector<double> numbersOf(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  for (;;) {
    double value = 0.0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !(std::abs(value) <= kFarthest)) return {};
    numbers.push_back(value);
    if (rest == end) return numbers;
    if (*rest != ',') return {};
    at = rest + 1;
  }
}

}  // namespace

double extinctionAtOne(const Scene& scene, VolumeDensity density) {
  double most = 0.0;
  for (const Layer& layer : scene.layers) most = std::max(most, static_cast<double>(layer.cloud.extinction));
  for (const Classical& cloud : scene.classical) most = std::max(most, static_cast<double>(cloud.cloud.extinction));
  for (const Hero& hero : scene.heroes) {
    const bool classic = hero.form.shape == HeroShape::classic;
    most = std::max(most, static_cast<double>(hero.cloud.extinction * (classic ? hero.classic.density : 1.0f)));
  }
  if (most == 0.0)
    throw Error(
        ErrorKind::badInput, "",
        "this sky has no layers, classical or hero clouds with extinction: there is nothing to put into a volume");
  if (density == VolumeDensity::normalized) return most;
  if (density == VolumeDensity::extinction) return 1.0;
  // Extinction of droplets: Q 3 LWC / (4 density r).
  const double radius = 0.5e-6 * leadingScatterers(scene)->dropletDiameter;
  return 0.75 * kExtinctionEfficiency / (kWaterDensity * radius);
}

Region regionOf(const std::string& text, const Scene& scene, double voxel) {
  Region region{glm::dvec3(-0.5 * kDefaultEdge), glm::dvec3(0.5 * kDefaultEdge)};
  region.low += glm::dvec3(scene.camera.position.x, scene.camera.position.y, 0.0);
  region.high += glm::dvec3(scene.camera.position.x, scene.camera.position.y, 0.0);
  region.low.z = 1e9, region.high.z = -1e9;
  for (const Layer& layer : scene.layers) {
    const Shell shell = shellOf(layer);
    region.low.z = std::min(region.low.z, static_cast<double>(shell.bottom));
    region.high.z = std::max(region.high.z, static_cast<double>(shell.top));
  }
  // Clouds without end, or nearly, are cut off round the camera; others are taken whole.
  const bool endless = !scene.layers.empty() || std::any_of(scene.heroes.begin(), scene.heroes.end(),
                                                            [](const Hero& h) { return h.scatter.radius > 0.0f; });
  if (!endless && !(scene.classical.empty() && scene.heroes.empty())) region = {glm::dvec3(1e9), glm::dvec3(-1e9)};
  const auto include = [&](const glm::dvec3& low, const glm::dvec3& high) {
    if (!endless) {
      region.low = glm::min(region.low, low);
      region.high = glm::max(region.high, high);
    }
    region.low.z = std::min(region.low.z, low.z);
    region.high.z = std::max(region.high.z, high.z);
  };
  const Drift drift{scene.wind.speed, scene.wind.from, scene.time};
  for (const Classical& cloud : scene.classical) include(boxOf(cloud, drift).low, boxOf(cloud, drift).high);
  for (const Hero& hero : scene.heroes) {
    const HeroBody body = bakeHero(hero, drift, scene.seed, kFewCells);
    include(body.lowest(), body.highest());
  }
  if (!text.empty()) {
    const std::vector<double> n = numbersOf(text);
    if (n.size() != 4 && n.size() != 6)
      throw UsageError(fmt::format("--region {}: write west,south,east,north[,bottom,top] in metres", text));
    region = {{n[0], n[1], n.size() == 6 ? n[4] : region.low.z}, {n[2], n[3], n.size() == 6 ? n[5] : region.high.z}};
  }
  const double brick = VoxelGrid::kBrick * voxel;
  for (int c = 0; c < 3; ++c) {
    if (!(region.low[c] < region.high[c]))
      throw UsageError(fmt::format("--region {}: west, south and bottom are less than east, north and top", text));
    // Decimal sizes are not exact in binary: an edge on a brick's side stays there.
    region.low[c] = std::floor(region.low[c] / brick + 1e-6) * brick;
    region.high[c] = std::ceil(region.high[c] / brick - 1e-6) * brick;
  }
  return region;
}

std::vector<Region> tilesOf(const Region& region, const glm::ivec2& across, double voxel) {
  const double brick = VoxelGrid::kBrick * voxel;
  const auto cut = [&](int c, int i) {
    const double bricks = std::round((region.high[c] - region.low[c]) / brick);
    return region.low[c] + brick * std::round(bricks * i / across[c]);
  };
  std::vector<Region> tiles;
  for (int j = 0; j < across.y; ++j)
    for (int i = 0; i < across.x; ++i) {
      const Region tile{{cut(0, i), cut(1, j), region.low.z}, {cut(0, i + 1), cut(1, j + 1), region.high.z}};
      if (!(tile.low.x < tile.high.x && tile.low.y < tile.high.y))
        throw UsageError(
            fmt::format("--tiles {}x{}: the tiles would be smaller than a brick of {:g} m", across.x, across.y, brick));
      tiles.push_back(tile);
    }
  return tiles;
}

VoxelBox boxOf(const Region& region, double voxel, const VolumeConvention& convention) {
  const double units = unitsPerMetre(convention.unit);
  const glm::dvec3 size = glm::round((region.high - region.low) / voxel);
  VoxelBox box{glm::ivec3(size), region.low * units, glm::dvec3(voxel * units)};
  if (convention.up == VolumeUp::y) {
    box.dims = glm::ivec3(size.x, size.z, size.y);
    box.origin = glm::dvec3(region.low.x, region.low.z, -region.high.y) * units;
  }
  return box;
}

VoxelBaking bakingOf(const VolumeConvention& convention, double extinctionOfOne) {
  const double metres = 1.0 / unitsPerMetre(convention.unit);
  const bool turned = convention.up == VolumeUp::y;
  return {.cloudSpace = [metres,
                         turned](const glm::dvec3& p) { return metres * (turned ? glm::dvec3(p.x, -p.z, p.y) : p); },
          .scale = static_cast<float>(1.0 / extinctionOfOne)};
}

VolumeEstimate estimateOf(const DensityField& field, const Region& region, double voxel) {
  constexpr int kBricks = 256, kPoints = VoxelGrid::kBrickVoxels;
  const double brick = VoxelGrid::kBrick * voxel;
  const glm::dvec3 bricks = glm::round((region.high - region.low) / brick);
  const ClearAir clear(field);
  std::vector<glm::dvec3> points;  // of the bricks that baking does not pass over
  for (int i = 0; i < kBricks; ++i) {
    // Places of a low-discrepancy sequence (R3: Roberts 2018).
    const glm::dvec3 at(std::fmod(0.8191725134 * (i + 1), 1.0), std::fmod(0.6710436067 * (i + 1), 1.0),
                        std::fmod(0.5497004779 * (i + 1), 1.0));
    const glm::dvec3 corner = region.low + glm::floor(at * bricks) * brick;
    if (clear.holds(corner, corner + brick)) continue;
    for (int k = 0; k < kPoints; ++k) points.push_back(corner + (glm::dvec3(k % 8, k / 8 % 8, k / 64) + 0.5) * voxel);
  }
  const auto start = std::chrono::steady_clock::now();
  const std::vector<float> found = field.extinction(points);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double active = 0.0, activeBricks = 0.0;
  for (auto first = found.begin(); first != found.end(); first += kPoints) {
    const auto count = std::count_if(first, first + kPoints, [](float v) { return v > 0.0f; });
    active += static_cast<double>(count) / kPoints;
    activeBricks += count > 0;
  }
  const double all = bricks.x * bricks.y * bricks.z;
  return {.voxels = all * kPoints,
          .activeVoxels = all * kPoints * active / kBricks,
          .activeBricks = all * activeBricks / kBricks,
          .seconds = all * seconds / kBricks};
}

}  // namespace welkin::app
