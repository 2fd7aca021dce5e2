#include "welkin/density/field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/density/field_kernels.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin {

namespace {

constexpr std::size_t kBlock = 2048;   // most points that share an anchor
constexpr double kReach = 10000.0;     // m, farthest that one may be from it: floats are a millimetre apart there
constexpr std::size_t kColumns = 64;   // columns that are worked on at a time
constexpr float kEdgeOfCloud = 0.05f;  // share of a layer's extinction that counts as cloud, by choice

// Neighbouring points with the anchor of their block.
struct Run {
  std::size_t begin, end;
  glm::dvec2 anchor;
};

template <class At>
std::vector<Run> blocksOf(std::size_t count, const At& at) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 p = at(i);
    const bool fits = !runs.empty() && i - runs.back().begin < kBlock &&
                      std::max(std::abs(p.x - runs.back().anchor.x), std::abs(p.y - runs.back().anchor.y)) < kReach;
    if (!fits) runs.push_back({i, i, p});
    runs.back().end = i + 1;
  }
  return runs;
}

// The points of a run as the kernels read them, and room for their answers.
class Planes {
 public:
  template <class At>
  Planes(const Run& run, const At& at)
      : count_(run.end - run.begin), stride_((count_ + kernels::kPadding - 1) / kernels::kPadding * kernels::kPadding),
        values_(4 * stride_) {
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec3 p = at(run.begin + i) - glm::dvec3(run.anchor, 0.0);
      for (int c = 0; c < 3; ++c) values_[static_cast<std::size_t>(c) * stride_ + i] = static_cast<float>(p[c]);
    }
  }
  kernels::Points points() const {
    return {values_.data(), values_.data() + stride_, values_.data() + 2 * stride_, count_};
  }
  float* answers() { return values_.data() + 3 * stride_; }

 private:
  std::size_t count_, stride_;
  std::vector<float> values_;
};

struct Steps {
  std::size_t count;
  double size;
};
Steps stepsOf(double low, double high, double most) {
  if (!(most > 0.0)) throw Error(ErrorKind::badInput, "", "the steps of an optical depth must be longer than 0 m");
  if (!(high > low)) return {0, 0.0};
  const auto count = static_cast<std::size_t>(std::ceil((high - low) / most));
  return {count, (high - low) / static_cast<double>(count)};
}

}  // namespace

DensityTextures bakeDensityTextures(const DensityParts& parts, DensityTextures textures) {
  const auto uses = [&](LayerShape shape) {
    return std::any_of(parts.layers.begin(), parts.layers.end(),
                       [&](const Layer& l) { return l.cloud.shape == shape; });
  };
  const auto make = [](Volume& volume, const auto& bake) {
    if (volume.texels.empty()) volume = bake();
    roundToHalf(volume);
  };
  const NoiseSettings& n = parts.noise;
  if (uses(LayerShape::profile)) {
    // One base texture serves all layers, mixed as the first one asks.
    make(textures.profileBase,
         [&] { return bakeProfileBasePacked(n.profile, parts.layers.front().profile.billowMix); });
    make(textures.profileDetail, [&] { return bakeProfileDetail(n.profile); });
    make(textures.profileWarp, [&] { return bakeProfileWarp(n.profile); });
  }
  if (uses(LayerShape::nubis)) {
    make(textures.nubisBase, [&] { return bakeBaseShapePacked(n.baseShape); });
    make(textures.nubisDetail, [&] { return bakeDetailPacked(n.detail); });
    make(textures.curl, [&] { return bakeCurl(n.curl); });
  }
  if (!parts.heroes.empty()) make(textures.heroBillows, [] { return bakeHeroBillows(); });
  return textures;
}

DensityField::DensityField(const DensityParts& parts, DensityTextures textures)
    : layers_(parts.layers.begin(), parts.layers.end()), sheets_(parts.sheets.begin(), parts.sheets.end()),
      grids_(parts.grids.begin(), parts.grids.end()), heroes_(parts.heroes.begin(), parts.heroes.end()),
      maps_(parts.weatherMaps.begin(), parts.weatherMaps.end()), drift_(parts.drift), seed_(parts.seed),
      textures_(bakeDensityTextures(parts, std::move(textures))) {
  maps_.resize(layers_.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    authoringMap(layers_[i], &maps_[i]);
    roundToHalf(maps_[i]);
  }
  setDrift(drift_);
}

void DensityField::setDrift(const Drift& drift) {
  drift_ = drift;
  bodies_.clear();
  for (const Hero& hero : heroes_) bodies_.push_back(bakeHero(hero, drift, seed_));
}

void DensityField::addLayer(std::size_t index, std::span<const glm::dvec3> points, float footprint,
                            std::span<float> sum) const {
  const Layer& layer = layers_.at(index);
  const bool profile = layer.cloud.shape == LayerShape::profile;
  const kernels::LayerTextures textures{authoringMap(layer, &maps_[index]),
                                        (profile ? textures_.profileBase : textures_.nubisBase).view(),
                                        (profile ? textures_.profileDetail : textures_.nubisDetail).view(),
                                        (profile ? textures_.profileWarp : textures_.curl).view()};
  const std::vector<Run> runs = blocksOf(points.size(), [&](std::size_t i) { return glm::dvec2(points[i]); });
  parallelFor(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Run& run = runs[r];
      Planes planes(run, [&](std::size_t i) { return points[i]; });
      kernels::layerExtinction(layerParams(layer, glm::dvec3(run.anchor, 0.0), drift_),
                               weatherParams(layer, run.anchor, drift_, seed_), textures, footprint, planes.points(),
                               planes.answers());
      for (std::size_t i = run.begin; i < run.end; ++i) sum[i] += planes.answers()[i - run.begin];
    }
  });
}

void DensityField::addHeroes(std::span<const glm::dvec3> points, float footprint, std::span<float> sum) const {
  if (bodies_.empty()) return;
  const std::vector<Run> runs = blocksOf(points.size(), [&](std::size_t i) { return glm::dvec2(points[i]); });
  parallelFor(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Run& run = runs[r];
      glm::dvec3 low(points[run.begin]), high(low);
      for (std::size_t i = run.begin; i < run.end; ++i) {
        low = glm::min(low, points[i]);
        high = glm::max(high, points[i]);
      }
      std::optional<Planes> planes;
      for (const HeroBody& body : bodies_) {
        if (glm::any(glm::lessThan(high, body.lowest())) || glm::any(glm::greaterThan(low, body.highest()))) continue;
        if (!planes) planes.emplace(run, [&](std::size_t i) { return points[i]; });
        kernels::heroExtinction(body.paramsAt(run.anchor), *body.parts,
                                {body.shapeView(), textures_.heroBillows.view()}, footprint, planes->points(),
                                planes->answers());
        for (std::size_t i = run.begin; i < run.end; ++i) sum[i] += planes->answers()[i - run.begin];
      }
    }
  });
}

void DensityField::addGrids(std::span<const glm::dvec3> points, std::span<float> sum) const {
  for (const PlacedGrid& grid : grids_)
    parallelFor(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sum[i] += grid.at(points[i]);
    });
}

std::vector<float> DensityField::layerExtinction(std::size_t layer, std::span<const glm::dvec3> points,
                                                 float footprint) const {
  std::vector<float> sum(points.size());
  addLayer(layer, points, footprint, sum);
  return sum;
}

std::vector<float> DensityField::extinction(std::span<const glm::dvec3> points, float footprint) const {
  std::vector<float> sum(points.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) addLayer(i, points, footprint, sum);
  addGrids(points, sum);
  addHeroes(points, footprint, sum);
  return sum;
}

float DensityField::extinction(const glm::dvec3& point, float footprint) const {
  return extinction(std::span(&point, 1), footprint).front();
}

double DensityField::opticalDepth(const glm::dvec2& place, double low, double high, double step) const {
  const Steps steps = stepsOf(low, high, step);
  std::vector<glm::dvec3> points(steps.count);
  for (std::size_t k = 0; k < steps.count; ++k)
    points[k] = glm::dvec3(place, low + (static_cast<double>(k) + 0.5) * steps.size);
  double sum = 0.0;
  for (const float sigma : extinction(points)) sum += sigma;
  return sum * steps.size;
}

double DensityField::opticalDepthToward(const glm::dvec3& point, const glm::dvec3& direction, double step) const {
  constexpr double kFarthest = 200000.0;  // m
  double bottom = 1e9, top = -1e9;
  const auto include = [&](double low, double high) {
    bottom = std::min(bottom, low);
    top = std::max(top, high);
  };
  for (const Layer& layer : layers_) include(shellOf(layer).bottom, shellOf(layer).top);
  for (const PlacedGrid& grid : grids_) include(boundsOf(grid).low.z, boundsOf(grid).high.z);
  for (const HeroBody& body : bodies_) include(body.lowest().z, body.highest().z);
  // From the planet's centre. The ray crosses altitude h at -b -+ sqrt(b^2 + (R + h)^2 - |start|^2).
  const double radius = kPlanetRadius + point.z;
  const glm::dvec3 start(point.x, point.y,
                         std::sqrt(std::max(radius * radius - point.x * point.x - point.y * point.y, 0.0)));
  const double b = glm::dot(start, direction);
  const auto root = [&](double h) { return b * b + (kPlanetRadius + h - radius) * (kPlanetRadius + h + radius); };
  if (top < bottom || root(top) <= 0.0) return 0.0;
  double near = std::max(-b - std::sqrt(root(top)), 0.0), far = -b + std::sqrt(root(top));
  if (point.z < bottom) near = std::max(-b + std::sqrt(root(bottom)), 0.0);
  if (b < 0.0 && root(0.0) > 0.0) far = std::min(far, -b - std::sqrt(root(0.0)));
  far = std::min(far, kFarthest);
  const Steps steps = stepsOf(near, far, step);
  std::vector<glm::dvec3> points(steps.count);
  for (std::size_t k = 0; k < steps.count; ++k) {
    const glm::dvec3 p = start + direction * (near + (static_cast<double>(k) + 0.5) * steps.size);
    points[k] = {p.x, p.y, glm::length(p) - kPlanetRadius};
  }
  double sum = 0.0;
  for (const float sigma : extinction(points)) sum += sigma;
  return sum * steps.size;
}

glm::vec4 DensityField::weather(std::size_t index, const glm::dvec3& point) const {
  const Layer& layer = layers_.at(index);
  const law::LayerParams c = layerParams(layer, glm::dvec3(point.x, point.y, 0.0), drift_);
  const law::WeatherParams w = weatherParams(layer, glm::dvec2(point), drift_, seed_);
  const glm::vec3 q = law::unsheared(glm::vec3(0.0f, 0.0f, point.z), c);
  const TextureView map = authoringMap(layer, &maps_[index]);
  if (layer.cloud.shape == LayerShape::nubis) return law::nubisWeather(glm::vec2(q), w, map);
  return law::profileWeather(law::profileColumn(q, c, textures_.profileWarp.view()), w, map);
}

std::vector<CloudColumn> DensityField::columns(std::size_t index, std::span<const glm::dvec2> places,
                                               double step) const {
  const Layer& layer = layers_.at(index);
  const Shell shell = shellOf(layer);
  const Steps steps = stepsOf(shell.bottom, shell.top, step);
  std::vector<CloudColumn> columns(places.size());
  std::vector<glm::dvec3> points;
  for (std::size_t first = 0; first < places.size(); first += kColumns) {
    const std::size_t count = std::min(kColumns, places.size() - first);
    points.clear();
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < steps.count; ++k)
        points.emplace_back(places[first + i], shell.bottom + (static_cast<double>(k) + 0.5) * steps.size);
    const std::vector<float> sigma = layerExtinction(index, points);
    for (std::size_t i = 0; i < count; ++i) {
      CloudColumn& column = columns[first + i];
      double sum = 0.0;
      for (std::size_t k = 0; k < steps.count; ++k) {
        const std::size_t at = i * steps.count + k;
        sum += sigma[at];
        if (sigma[at] <= kEdgeOfCloud * layer.cloud.extinction) continue;
        const double half = 0.5 * steps.size;
        if (column.top == 0.0f) column.base = static_cast<float>(points[at].z - half);
        column.top = static_cast<float>(points[at].z + half);
      }
      column.opticalDepth = static_cast<float>(sum * steps.size);
    }
  }
  return columns;
}

std::vector<float> DensityField::sheetOpticalDepth(std::size_t index, std::span<const glm::dvec2> places) const {
  const Sheet& sheet = sheets_.at(index);
  std::vector<float> depth(places.size());
  const std::vector<Run> runs = blocksOf(places.size(), [&](std::size_t i) { return places[i]; });
  parallelFor(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Run& run = runs[r];
      Planes planes(run, [&](std::size_t i) { return glm::dvec3(places[i], 0.0); });
      kernels::sheetOpticalDepth(sheetParams(sheet, run.anchor, drift_.time, seed_), planes.points(), planes.answers());
      std::copy_n(planes.answers(), run.end - run.begin, depth.begin() + static_cast<std::ptrdiff_t>(run.begin));
    }
  });
  return depth;
}

}  // namespace welkin
