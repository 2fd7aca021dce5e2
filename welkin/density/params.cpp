#include "welkin/density/params.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "welkin/base/error.hpp"

namespace welkin {

namespace {

double wrapped(double x) { return x - std::floor(x); }

law::Lattice lattice(const glm::dvec2& anchor, double sizeX, double sizeY, double heading) {
  // The lattice's x axis points along the compass heading, its y axis to the left of it.
  const glm::dvec2 axis(std::sin(heading), std::cos(heading));
  const double x = (anchor.x * axis.x + anchor.y * axis.y) / sizeX;
  const double y = (anchor.y * axis.x - anchor.x * axis.y) / sizeY;
  law::Lattice l{};
  l.fracX = static_cast<float>(wrapped(x));
  l.fracY = static_cast<float>(wrapped(y));
  l.inverseSizeX = static_cast<float>(1.0 / sizeX);
  l.inverseSizeY = static_cast<float>(1.0 / sizeY);
  l.size = static_cast<float>(sizeX);
  l.axisX = static_cast<float>(axis.x);
  l.axisY = static_cast<float>(axis.y);
  l.cellX = static_cast<int>(std::floor(x));
  l.cellY = static_cast<int>(std::floor(y));
  return l;
}

constexpr double kEast = 1.5707963267948966;  // heading of a lattice that is not turned

law::Lattice square(const glm::dvec2& anchor, double size) { return lattice(anchor, size, size, kEast); }

// Offset (in tiles, wrapped) and inverse size of a periodic noise at the anchor.
glm::vec4 noiseOrigin(const glm::dvec3& origin, double tile) {
  return {static_cast<float>(wrapped(origin.x / tile)), static_cast<float>(wrapped(origin.y / tile)),
          static_cast<float>(wrapped(origin.z / tile)), static_cast<float>(1.0 / tile)};
}

// 24 bits, since the law multiplies its seeds.
int mixedSeed(int scene, int part) {
  return static_cast<int>((static_cast<std::uint32_t>(scene) * 7919u + static_cast<std::uint32_t>(part)) & 0xFFFFFFu);
}

// Chance of a cloud in a cell of the largest class for which the expected cover equals `coverage`. Discs of class c
// have mean squared radius 0.146 cell^2 (radius uniform in [.25, .5] cell) and cover about 0.7 of that disc.
float chanceForCoverage(float coverage, float falloff) {
  const double share = 3.14159265 * 0.146 * 0.7;
  const auto cover = [&](double rate) {
    double clear = 1.0;
    for (int c = 0; c < 3; ++c, rate *= falloff) clear *= 1.0 - share * (1.0 - std::exp(-rate));
    return 1.0 - clear;
  };
  double low = 0.0, high = 64.0;
  for (int i = 0; i < 48; ++i) {
    const double middle = 0.5 * (low + high);
    (cover(middle) < coverage ? low : high) = middle;
  }
  return static_cast<float>(low);
}

}  // namespace

glm::dvec2 driftOffset(const Drift& drift) {
  const double way = drift.windSpeed * drift.time;
  return {-std::sin(drift.windFrom) * way, -std::cos(drift.windFrom) * way};
}

law::PlanetParams planetParams(const glm::dvec3& anchor) {
  const glm::dvec3 fromCentre = anchor + glm::dvec3(0.0, 0.0, kPlanetRadius);
  const double r = glm::length(fromCentre);
  if (!(r > 1.0))
    throw Error(ErrorKind::badInput, "", "the camera is at the centre of the planet; move it to the surface");
  law::PlanetParams p{};
  const glm::dvec3 up = fromCentre / r;
  p.up = glm::vec4(glm::vec3(up), static_cast<float>(r));
  // |c|^2 - R^2 without the difference of large numbers.
  p.altitude = static_cast<float>((2.0 * kPlanetRadius * anchor.z + glm::dot(anchor, anchor)) / (r + kPlanetRadius));
  p.radius = static_cast<float>(kPlanetRadius);
  return p;
}

law::LayerParams layerParams(const Layer& layer, const glm::dvec3& anchor, const Drift& drift) {
  const CloudLayer& cloud = layer.cloud;
  const ProfileSettings& s = layer.profile;
  const glm::dvec2 moved = driftOffset(drift);
  const double rise = cloud.updraft * drift.time;
  // Each noise drifts at a speed of its own; altitude is absolute, so the anchor's height does not enter.
  const auto origin = [&](double share, double up) {
    return glm::dvec3(anchor.x - moved.x * share, anchor.y - moved.y * share, -rise * up);
  };
  law::LayerParams p{};
  p.base = cloud.base;
  p.thickness = cloud.thickness;
  p.extinction = cloud.extinction;
  p.shear = cloud.shear;
  p.downwindX = -std::sin(drift.windFrom);
  p.downwindY = -std::cos(drift.windFrom);
  p.baseFade = s.baseFade;
  p.anvilRamp = 1.0f / std::max(450.0f, s.ramp);
  p.inverseRamp = 1.0f / s.ramp;
  p.lengthScale = s.lengthScale;
  p.lengthFraction = s.lengthFraction;
  p.minLength = s.minLength;
  p.erosion = s.erosion;
  p.baseErosion = s.baseErosion;
  p.baseCut = s.baseCut;
  p.detail = s.detail;
  p.fineDetail = s.fineDetail;
  p.baseRagged = s.baseRagged;
  p.liquidGradient = s.liquidGradient;
  p.warp = s.warp;
  p.anvilDensity = s.anvilDensity;
  p.hasAnvil = layer.weather.anvil > 0.0f ? 1 : 0;
  p.needsExtra = p.hasAnvil || layer.weather.precipitation > 0.0f || !layer.weather.map.empty() ? 1 : 0;
  p.shape = static_cast<int>(cloud.shape);
  const Shell shell = shellOf(layer);
  p.bottom = shell.bottom;
  p.top = shell.top;
  if (cloud.shape == LayerShape::profile) {
    p.noise = noiseOrigin(origin(1.0, 1.0), s.noiseTile);
    p.warping = noiseOrigin(origin(1.0, 0.0), 1.3 * s.noiseTile);
    const glm::dvec3 o = origin(1.0, 1.0);
    const glm::dvec2 downwind(-std::sin(drift.windFrom), -std::cos(drift.windFrom));
    const double along = o.x * downwind.x + o.y * downwind.y, across = o.y * downwind.x - o.x * downwind.y;
    p.fibres = noiseOrigin({along / law::kFibreStretch, across, o.z / law::kFibreDepth}, law::kFibreTile * s.noiseTile);
    p.detailing = noiseOrigin(origin(cloud.detailDrift, 1.5), s.detailTile);
    p.fine = noiseOrigin(origin(cloud.detailDrift, 2.0), s.fineTile);
  } else {
    const NubisSettings& n = layer.nubis;
    p.noise = noiseOrigin(origin(1.0, 1.0), n.baseTile);
    p.detailing = noiseOrigin(origin(cloud.detailDrift, 1.5), n.detailTile);
    p.curl = noiseOrigin(origin(cloud.detailDrift, 0.0), n.curlTile);
    p.curlAmplitude = n.curlAmplitude;
    p.detailErosion = n.detailErosion;
    p.transition = static_cast<int>(n.transition);
  }
  return p;
}

law::WeatherParams weatherParams(const Layer& layer, const glm::dvec2& worldAnchor, const Drift& drift, int seed) {
  const WeatherSettings& s = layer.weather;
  const glm::dvec2 anchor = worldAnchor - driftOffset(drift);
  law::WeatherParams p{};
  p.cells = s.population == Population::cells
                ? lattice(anchor, s.cellSize, s.cellSize * s.stretch, s.orientation + kEast)
                : square(anchor, s.cellSize);
  p.clusters = square(anchor, s.clusterSize);
  p.warp = square(anchor, layer.cloud.shape == LayerShape::profile ? 1200.0 : s.cellSize);
  // Streets and fronts run along `orientation`: the lattice's x axis stands across.
  p.streets = lattice(anchor, s.streetSpacing, s.streetSpacing, s.orientation + kEast);
  p.coverage = s.coverage;
  p.precipitation = s.precipitation;
  p.type = s.type;
  p.anvil = s.anvil;
  p.falloff = std::exp2(-(3.0f - s.sizeExponent));
  p.probability = chanceForCoverage(s.coverage, p.falloff);
  // Single domes are scattered evenly; the other populations gather.
  const bool gathers = layer.cloud.shape == LayerShape::nubis || s.population != Population::domes;
  p.clustering = gathers ? s.clustering : 0.0f;
  p.roughness = s.roughness;
  p.thickness = layer.cloud.thickness;
  p.baseVariation = layer.profile.baseVariation;
  p.baseRange = s.mapBaseRange;
  p.mapInverseSize = 1.0f / s.mapSize;
  // The picture's centre stands over the origin, its top edge to the north.
  p.mapOffsetX = static_cast<float>(wrapped(anchor.x / s.mapSize + 0.5));
  p.mapOffsetY = static_cast<float>(wrapped(anchor.y / s.mapSize + 0.5));
  p.downwindX = -std::sin(drift.windFrom);
  p.downwindY = -std::cos(drift.windFrom);
  p.population = static_cast<int>(s.population);
  p.useMap = s.map.empty() ? 0 : 1;
  p.seed = mixedSeed(seed, layer.cloud.seed);
  if (layer.cloud.shape == LayerShape::nubis) {
    p.clusters = square(anchor, layer.nubis.weatherTile / 4.0);
    p.cells = square(anchor, layer.nubis.weatherTile / 16.0);
  }
  return p;
}

law::SheetParams sheetParams(const Sheet& sheet, const glm::dvec2& worldAnchor, double time, int seed) {
  const glm::dvec2 anchor = worldAnchor - driftOffset({sheet.windSpeed, sheet.windFrom, time});
  law::SheetParams p{};
  p.height = sheet.height;
  p.opticalDepth = sheet.opticalDepth;
  p.coverage = sheet.coverage;
  p.warp = sheet.warp;
  p.fibres = lattice(anchor, sheet.tile, sheet.tile / sheet.stretch, sheet.orientation);
  p.patches = lattice(anchor, 16000.0, 9000.0, sheet.orientation);
  p.bend = square(anchor, 14000.0);
  p.kind = static_cast<int>(sheet.kind);
  p.seed = mixedSeed(seed, sheet.seed);
  return p;
}

Shell shellOf(const Layer& layer) {
  const CloudLayer& cloud = layer.cloud;
  if (cloud.shape == LayerShape::nubis) return {cloud.base, cloud.base + cloud.thickness + layer.weather.mapBaseRange};
  const float shift = layer.profile.baseVariation + layer.profile.baseRagged;
  // What the law's height fields reach: type raises tops by up to 40 %, closed cells vary by another 25 %, fronts by 15
  // %, sheets reach 1.45 by themselves. Erosion removes; fine noise adds up to half its depth, and so does the smooth
  // joint of tower and anvil.
  const float type = layer.weather.map.empty() ? layer.weather.type : 1.0f;
  const float tall = 0.6f + 0.8f * type;
  const float vary = layer.weather.population == Population::cells   ? 1.25f * tall
                     : layer.weather.population == Population::front ? 1.15f * tall
                                                                     : tall;
  const float joint = layer.weather.anvil > 0.0f ? 0.075f * layer.profile.lengthScale : 0.0f;
  const float top = cloud.thickness * std::max(vary, 1.45f) + 0.5f * layer.profile.fineDetail + joint;
  return {std::max(cloud.base - shift, 0.0f), cloud.base + top + shift + layer.weather.mapBaseRange};
}

}  // namespace welkin
