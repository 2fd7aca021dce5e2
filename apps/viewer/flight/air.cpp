#include "apps/viewer/flight/air.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/atmosphere/sun.hpp"

namespace welkin::viewer {

namespace {

constexpr double kHeroPatience = 10.0;  // s

// What the noise textures depend on.
bool sameNoise(const Scene& a, const Scene& b) {
  const auto mixOf = [](const Scene& s) { return s.layers.empty() ? 0.0f : s.layers.front().profile.billowMix; };
  return sameFields(a.noise.profile, b.noise.profile) && sameFields(a.noise.baseShape, b.noise.baseShape) &&
         sameFields(a.noise.detail, b.noise.detail) && sameFields(a.noise.curl, b.noise.curl) && mixOf(a) == mixOf(b);
}

}  // namespace

AirOfSky::AirOfSky() = default;
AirOfSky::~AirOfSky() = default;

void AirOfSky::setScene(const Scene& scene, std::span<const Volume> weatherMaps, std::span<const PlacedGrid> grids) {
  const DensityParts parts{.layers = scene.layers,
                           .sheets = scene.sheets,
                           .noise = scene.noise,
                           .drift = {scene.wind.speed, scene.wind.from, scene.time},
                           .seed = scene.seed,
                           .grids = grids,
                           .heroes = scene.heroes,
                           .weatherMaps = weatherMaps};
  if (field_ && !sameNoise(scene_, scene)) textures_ = {};
  textures_ = bakeDensityTextures(parts, std::move(textures_));
  auto field = std::make_unique<DensityField>(parts, textures_);
  turbulence_.reset();
  field_ = std::move(field);
  const float height = std::max(sunDirection(scene.sun).z, 0.0f);
  turbulence_ =
      std::make_unique<Turbulence>(*field_, TurbulenceSettings{.seed = scene.seed, .heatFlux = 0.1f * height});
  scene_ = scene;
}

Air AirOfSky::at(const glm::dvec3& point, const glm::dvec3& right, double time) {
  Air air;
  if (!field_) return air;
  // Hero clouds are shaped anew for every drift, which is too dear for every frame.
  if (scene_.heroes.empty() || std::abs(time - field_->drift().time) > kHeroPatience)
    field_->setDrift({scene_.wind.speed, scene_.wind.from, time});
  const double rough = turbulence_->deviation(point);
  air.wind = meanWind(scene_.wind, point.z);
  if (rough <= 0.0) return air;
  const glm::dvec3 middle = turbulence_->gustPattern(point, time);
  air.wind += rough * middle;
  air.left = rough * (turbulence_->gustPattern(point - right, time) - middle);
  air.right = rough * (turbulence_->gustPattern(point + right, time) - middle);
  return air;
}

double AirOfSky::extinction(const glm::dvec3& point) const {
  return field_ ? static_cast<double>(field_->extinction(point)) : 0.0;
}

glm::dvec3 meanWind(const Wind& wind, double height) {
  const double share = std::pow(std::clamp(height / 1000.0, 0.005, 1.0), 0.16);
  const double from = static_cast<double>(wind.from), speed = share * static_cast<double>(wind.speed);
  return {-speed * std::sin(from), -speed * std::cos(from), 0.0};
}

}  // namespace welkin::viewer
