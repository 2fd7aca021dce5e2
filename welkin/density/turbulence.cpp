#include "welkin/density/turbulence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace welkin {

namespace {

constexpr double kCloudBase = 1.0, kCloudGrowth = 0.7e-3;  // m/s at the base, and more with each m above
constexpr double kHalo = 0.33, kDowndraught = 0.4, kGridDeviation = 1.0;
constexpr float kFootprint = 40.0f;  // m: an aircraft feels the mean over its own size and more
// Air mixes across the edges of clouds, and so does the variance: the mean of a point and others round it, m.
constexpr double kMixing[] = {25.0, 50.0, 75.0};
constexpr double kFarthest = 1e9;                       // m and s: positions and times are held to it
constexpr double kLargestEddy = 600.0, kTurning = 3.0;  // m, m/s
constexpr int kEddySizes = 4;
// Of one component of the pattern's sum before it is scaled; measured, and held by a test.
constexpr double kPatternDeviation = 1.5;

double saturate(double x) { return std::clamp(x, 0.0, 1.0); }
double rise(double low, double high, double x) {
  const double t = saturate((x - low) / (high - low));
  return t * t * (3.0 - 2.0 * t);
}

// A layer's column: how high cloud reaches above its base there, and how convective it is.
struct Column {
  double base, height, convection, rain;
};
Column columnOf(const Layer& layer, const glm::vec4& weather) {
  constexpr double kClosedCells = 0.4, kSheet = 0.15;
  if (layer.cloud.shape == LayerShape::nubis) {
    const double type = saturate(weather.y);
    return {layer.cloud.base + weather.w, layer.cloud.thickness * (0.3 + 0.7 * type) * rise(0.1, 0.6, weather.x),
            kSheet + (1.0 - kSheet) * type, weather.z};
  }
  const Population p = layer.weather.population;
  const double convection = p == Population::uniform ? kSheet : p == Population::cells ? kClosedCells : 1.0;
  return {layer.cloud.base + weather.y, weather.x, convection, weather.w};
}

// Inside a cloud as high as the column's, `above` its base.
double insideCloud(const Column& c, double above) {
  const double share = above / std::max(c.height, 1.0);
  return c.convection * (kCloudBase + kCloudGrowth * std::clamp(above, 0.0, c.height)) *
         (1.0 - 0.5 * rise(0.7, 1.0, share));
}

// The square of what one layer does at an altitude; `filled`: extinction there against that of dense cloud.
double varianceOf(const Column& c, double altitude, double filled, double heatFlux) {
  const double above = altitude - c.base;
  const double exists = rise(0.0, 200.0, c.height);
  const double halo = kHalo * exists * rise(-100.0, 50.0, above) * (1.0 - rise(-50.0, 150.0, above - c.height));
  const double cloud = insideCloud(c, above) * std::max(saturate(filled / 0.3), halo);
  const double down = kDowndraught * insideCloud(c, 0.6 * c.height) * c.rain * exists *
                      (1.0 - rise(0.0, 300.0, above)) * altitude / (altitude + 200.0);
  constexpr double kGravity = 9.81, kTemperature = 290.0;
  const double x = altitude / std::max(c.base, 1.0);
  const double rooted = c.convection * (1.0 - rise(2500.0, 3500.0, c.base)) * (1.0 - rise(1.0, 1.15, x));
  const double scale = std::cbrt(kGravity / kTemperature * heatFlux * std::max(c.base, 0.0));
  const double thermals =
      rooted * scale * std::sqrt(1.8) * std::cbrt(x) * std::max(1.0 - 0.8 * x, 0.0) * (0.4 + 0.6 * exists);
  return cloud * cloud + down * down + thermals * thermals;
}

bool isFinite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Whole cell and fraction; cells beyond the integers start anew.
struct Cell {
  int whole;
  float fraction;
};
Cell cellOf(double x) {
  const double whole = std::floor(x);
  return {static_cast<int>(static_cast<std::uint32_t>(static_cast<std::int64_t>(whole))),
          static_cast<float>(x - whole)};
}

// The curl of three independent noises, per cell.
glm::dvec3 curlAt(const glm::dvec3& p, std::uint32_t seed) {
  const Cell x = cellOf(p.x), y = cellOf(p.y), z = cellOf(p.z);
  const glm::ivec3 cell(x.whole, y.whole, z.whole);
  const glm::vec3 f(x.fraction, y.fraction, z.fraction);
  const glm::vec4 a = law::perlin3SlopeAt(cell, f, 0, seed), b = law::perlin3SlopeAt(cell, f, 0, seed + 1u),
                  d = law::perlin3SlopeAt(cell, f, 0, seed + 2u);
  return {d.y - b.z, a.z - d.x, b.x - a.y};
}

}  // namespace

std::vector<double> Turbulence::deviations(std::span<const glm::dvec3> points) const {
  std::vector<glm::dvec3> probes;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 p = isFinite(point) ? glm::clamp(point, -kFarthest, kFarthest) : glm::dvec3(0.0, 0.0, kFarthest);
    probes.push_back(p);
    for (const double reach : kMixing)
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-reach, reach}) {
          probes.push_back(p);
          probes.back()[axis] += side;
        }
  }
  const std::vector<double> variance = variances(probes);
  const std::size_t each = 1 + 6 * std::size(kMixing);
  std::vector<double> deviation(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < each; ++k) deviation[i] += variance[i * each + k];
    deviation[i] = std::sqrt(deviation[i] / static_cast<double>(each));
  }
  return deviation;
}

std::vector<double> Turbulence::variances(std::span<const glm::dvec3> points) const {
  std::vector<double> variance(points.size());
  const std::vector<Layer>& layers = field_.layers();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    // What a layer stirs reaches from the ground to a little above its top.
    const double top = shellOf(layers[i]).top + 200.0;
    const std::vector<float> sigma = field_.layerExtinction(i, points, kFootprint);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k].z > 0.0 && points[k].z < top)
        variance[k] += varianceOf(columnOf(layers[i], field_.weather(i, points[k])), points[k].z,
                                  sigma[k] / std::max(layers[i].cloud.extinction, 1e-6f), settings_.heatFlux);
  }
  for (const PlacedGrid& grid : field_.grids())
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double inside = kGridDeviation * saturate(grid.at(points[k]) / 0.03);
      variance[k] += inside * inside;
    }
  return variance;
}

glm::dvec3 Turbulence::gustPattern(const glm::dvec3& point, double time) const {
  if (!isFinite(point) || !std::isfinite(time)) return glm::dvec3(0.0);
  const double now = std::clamp(time, -kFarthest, kFarthest);
  const Drift& wind = field_.drift();
  const glm::dvec3 p =
      glm::clamp(point, -kFarthest, kFarthest) - glm::dvec3(driftOffset({wind.windSpeed, wind.windFrom, now}), 0.0);
  glm::dvec3 sum(0.0);
  double size = kLargestEddy;
  for (int i = 0; i < kEddySizes; ++i, size *= 0.5) {
    // One field of eddies fades into the next with weights whose squares add up to 1.
    const Cell turn = cellOf(now * kTurning / size);
    const double angle = 1.5707963267948966 * rise(0.0, 1.0, turn.fraction);
    const auto seedOf = [&](int number) { return law::hashCell3(number, i, settings_.seed, 0x6A09E667u); };
    const glm::dvec3 eddies = curlAt(p / size, seedOf(turn.whole)) * std::cos(angle) +
                              curlAt(p / size, seedOf(turn.whole + 1)) * std::sin(angle);
    sum += eddies * std::cbrt(size / kLargestEddy);
  }
  return sum / kPatternDeviation;
}

glm::dvec3 Turbulence::gust(const glm::dvec3& point, double time) const {
  return deviation(point) * gustPattern(point, time);
}

}  // namespace welkin
