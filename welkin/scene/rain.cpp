#include "welkin/scene/rain.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {

namespace {

constexpr float kLapse = 0.0065f;       // K/m, of the standard atmosphere
constexpr float kStreakTile = 1200.0f;  // m, about, of the noise that tells showers apart

// The most of the weather's precipitation that there can be.
float mostPrecipitation(const WeatherSettings& weather) {
  if (!weather.map.empty()) return 1.0f;
  return weather.population == Population::uniform ? std::min(2.0f * weather.precipitation, 1.0f)
                                                   : weather.precipitation;
}

}  // namespace

bool rains(const Scene& scene, const Layer& layer) {
  return scene.precipitation.rate > 0.0f && mostPrecipitation(layer.weather) > 0.0f;
}

bool rains(const Scene& scene) {
  return std::any_of(scene.layers.begin(), scene.layers.end(), [&](const Layer& l) { return rains(scene, l); });
}

float freezingLevel(const Precipitation& precipitation) { return precipitation.temperature / kLapse; }

law::RainParams rainParams(const Scene& scene, const Layer& layer) {
  const Precipitation& p = scene.precipitation;
  law::RainParams r{};
  r.rate = rains(scene, layer) ? p.rate : 0.0f;
  r.lost = std::sqrt(p.evaporation);
  r.top = std::max(layer.cloud.base, 1.0f);
  r.inverseTop = 1.0f / r.top;
  r.freezing = freezingLevel(p);
  const float lag = scene.wind.speed * (1.0f - law::kSurfaceWind), rate = std::max(p.rate, 0.01f);
  // Most of the water is in particles of about 4 / slope.
  r.behindRain = lag / law::rainSpeed(4.0f / law::rainSlope(rate));
  r.behindSnow = lag / law::snowSpeed(4.0f / law::snowSlope(rate));
  const float tile = layer.cloud.shape == LayerShape::nubis ? layer.nubis.baseTile : layer.profile.noiseTile;
  r.streaks = std::max(std::round(tile / kStreakTile), 1.0f);
  return r;
}

float rainTop(const Layer& layer) {
  const float shift = layer.cloud.shape == LayerShape::nubis ? 0.0f : layer.profile.baseVariation;
  return std::max(layer.cloud.base, 1.0f) + shift + layer.weather.mapBaseRange + law::kRainOverlap;
}

float rainBound(const Scene& scene, const Layer& layer) {
  if (!rains(scene, layer)) return 0.0f;
  const float rate = scene.precipitation.rate * mostPrecipitation(layer.weather);
  const float freezing = freezingLevel(scene.precipitation);
  return 1.0001f * std::max(law::fallingExtinction(rate, law::snowShare(0.0f, freezing)),
                            law::fallingExtinction(rate, law::snowShare(rainTop(layer), freezing)));
}

Falling fallingAt(const Precipitation& precipitation, float altitude) {
  const float rate = std::max(precipitation.rate, 0.01f);
  Falling f{};
  f.snow = law::snowShare(altitude, freezingLevel(precipitation));
  const float rain = law::rainSlope(rate), snow = law::snowSlope(rate);
  const glm::vec2 count(law::countAbove(law::rainIntercept(rate), rain, kLeastDrop),
                        law::countAbove(law::snowIntercept(rate), snow, kLeastFlake));
  const glm::vec2 section = glm::vec2((1.0f - f.snow) * law::rainExtinction(rate), f.snow * law::snowExtinction(rate));
  const glm::vec2 seen(law::sectionAbove(rain, kLeastDrop), law::sectionAbove(snow, kLeastFlake));
  f.count = glm::mix(count.x, count.y, f.snow);
  f.share = glm::dot(section, seen) / std::max(section.x + section.y, 1e-20f);
  const int flakes = static_cast<int>(std::lround(f.snow * kFallClasses));
  for (int i = 0; i < kFallClasses; ++i) {
    const bool flake = i < flakes;
    const int of = flake ? flakes : kFallClasses - flakes, at = flake ? i : i - flakes;
    const float u = (static_cast<float>(at) + 0.5f) / static_cast<float>(of);
    const float water = law::sizeAt(u, flake ? snow : rain, flake ? kLeastFlake : kLeastDrop);
    f.classes[static_cast<std::size_t>(i)] = {flake ? law::kSnowSwelling * water : water,
                                              flake ? law::snowSpeed(water) : law::rainSpeed(water),
                                              flake ? 1.0f : 0.0f};
  }
  return f;
}

}  // namespace welkin
