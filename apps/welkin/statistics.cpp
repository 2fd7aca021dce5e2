#include "apps/welkin/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "apps/welkin/picture.hpp"
#include "welkin/io/grids.hpp"

namespace welkin::app {

namespace {

constexpr int kColumnsAcross = 64;
constexpr double kPatterns = 12.0, kFrontClusters = 4.0;
constexpr double kSheetEdge = 200000.0;          // m; the patches of every sheet are 16 km x 9 km
constexpr double kStep = 15.0, kThinSteps = 64;  // m; at least so many steps through a thin layer
constexpr double kTail = 0.02;
constexpr int kHeroSteps = 1000;
constexpr float kHeroCloud = 0.002f;  // share of its extinction that counts as cloud; an anvil has 0.015, by choice

// One jittered place in each cell of a square grid.
std::vector<glm::dvec2> stratifiedPlaces(const glm::dvec2& centre, double edge) {
  std::vector<glm::dvec2> places;
  std::uint32_t hash = 1;
  const auto jitter = [&] {
    hash = law::nextHash(hash);
    return static_cast<double>(law::unitFromHash(hash));
  };
  for (int j = 0; j < kColumnsAcross; ++j)
    for (int i = 0; i < kColumnsAcross; ++i) {
      const double x = (i + jitter()) / kColumnsAcross - 0.5, y = (j + jitter()) / kColumnsAcross - 0.5;
      places.push_back(centre + edge * glm::dvec2(x, y));
    }
  return places;
}

double areaOf(const Layer& layer) {
  const WeatherSettings& w = layer.weather;
  if (!w.map.empty()) return w.mapSize;
  if (layer.cloud.shape == LayerShape::nubis) return kPatterns * layer.nubis.weatherTile / 4.0;
  if (w.population == Population::front) return kFrontClusters * w.clusterSize;
  return kPatterns * std::max(w.cellSize, w.clusterSize);
}

// The middle of the columns: the camera, but for a front the place on its line that is nearest to it.
glm::dvec2 middleOf(const Layer& layer, const Scene& scene) {
  const glm::dvec2 camera(scene.camera.position);
  const WeatherSettings& w = layer.weather;
  if (!w.map.empty() || layer.cloud.shape == LayerShape::nubis || w.population != Population::front) return camera;
  const glm::dvec2 across(std::cos(w.orientation), -std::sin(w.orientation));
  const glm::dvec2 moved = driftOffset({scene.wind.speed, scene.wind.from, scene.time});
  return camera - across * glm::dot(camera - moved, across);
}

// The column over the middle of a box that holds the field's only cloud; `extinction` is the cloud's own.
CloudColumn middleOf(const DensityField& field, const WorldBox& box, float extinction) {
  const double bottom = box.low.z, step = (box.high.z - bottom) / kHeroSteps;
  std::vector<glm::dvec3> points;
  points.reserve(kHeroSteps);
  for (int i = 0; i < kHeroSteps; ++i)
    points.emplace_back(0.5 * glm::dvec2(box.low + box.high), bottom + (i + 0.5) * step);
  CloudColumn column;
  double sum = 0.0;
  for (std::size_t i = 0; const float sigma : field.extinction(points)) {
    sum += sigma;
    if (sigma > kHeroCloud * extinction) {
      if (column.top == 0.0f) column.base = static_cast<float>(points[i].z - 0.5 * step);
      column.top = static_cast<float>(points[i].z + 0.5 * step);
    }
    ++i;
  }
  column.opticalDepth = static_cast<float>(sum * step);
  return column;
}

CloudColumn middleOf(const Hero& hero, const Scene& scene) {
  const Hero one = alone(hero);
  const DensityField field(
      {.drift = {scene.wind.speed, scene.wind.from, scene.time}, .seed = scene.seed, .heroes = std::span(&one, 1)});
  const HeroBody& body = field.heroes().front();
  return middleOf(field, {body.lowest(), body.highest()}, hero.cloud.extinction);
}

CloudColumn middleOf(const Classical& cloud, const Scene& scene) {
  const DensityField field({.drift = {scene.wind.speed, scene.wind.from, scene.time},
                            .seed = scene.seed,
                            .classical = std::span(&cloud, 1)});
  return middleOf(field, boundsOf(field.grids().front()), cloud.cloud.extinction);
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

CloudStatistics summary(const std::vector<CloudColumn>& columns, double threshold) {
  CloudStatistics s;
  std::vector<double> depths, bases, tops;
  double all = 0.0, cloudy = 0.0;
  for (const CloudColumn& column : columns) {
    all += column.opticalDepth;
    if (column.opticalDepth <= threshold) continue;
    cloudy += column.opticalDepth;
    depths.push_back(column.opticalDepth);
    if (column.top <= column.base) continue;
    bases.push_back(column.base);
    tops.push_back(column.top);
  }
  s.meanOpticalDepth = all / static_cast<double>(columns.size());
  s.cover = static_cast<double>(depths.size()) / static_cast<double>(columns.size());
  if (!depths.empty()) s.cloudyOpticalDepth = cloudy / static_cast<double>(depths.size());
  s.medianOpticalDepth = quantile(depths, 0.5);
  s.base = quantile(bases, kTail);
  s.top = quantile(tops, 1.0 - kTail);
  return s;
}

}  // namespace

DensityField densityField(const Scene& scene, DensityTextures textures) {
  const std::vector<Volume> maps = weatherMaps(scene);
  const std::vector<PlacedGrid> grids = loadGrids(scene);
  return DensityField({.layers = scene.layers,
                       .sheets = scene.sheets,
                       .noise = scene.noise,
                       .drift = {scene.wind.speed, scene.wind.from, scene.time},
                       .seed = scene.seed,
                       .grids = grids,
                       .classical = scene.classical,
                       .heroes = scene.heroes,
                       .weatherMaps = maps},
                      std::move(textures));
}

SkyStatistics measureSky(const Scene& scene) {
  const DensityField clouds = densityField(scene);
  SkyStatistics sky;
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = scene.layers[i];
    const double step = std::min(kStep, layer.cloud.thickness / kThinSteps);
    const std::vector<glm::dvec2> places = stratifiedPlaces(middleOf(layer, scene), areaOf(layer));
    sky.layers.push_back(summary(clouds.columns(i, places, step), kCloudyLayer));
  }
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const float height = scene.sheets[i].height;
    std::vector<CloudColumn> columns;
    for (const float depth :
         clouds.sheetOpticalDepth(i, stratifiedPlaces(glm::dvec2(scene.camera.position), kSheetEdge)))
      columns.push_back({depth, height, height});
    CloudStatistics s = summary(columns, kCloudySheet);
    s.base = s.top = height;
    sky.sheets.push_back(s);
  }
  for (const Classical& cloud : scene.classical) sky.classical.push_back(middleOf(cloud, scene));
  for (const Hero& hero : scene.heroes) sky.heroes.push_back(middleOf(hero, scene));
  return sky;
}

}  // namespace welkin::app
