#include "welkin/density/reflectance.hpp"

#include <algorithm>

#include "welkin/density/weather_map.hpp"

namespace welkin {

namespace {

constexpr double kEdge = 96000.0;  // m
constexpr int kTexels = 96;
constexpr float kTurned = 0.75f * 0.14f;  // of an optical depth, what a two-stream slab reflects by

// What noise leaves of the height of a profile cloud, and how dense that is, in the mean: fitted to `welkin flux`.
constexpr float kEroded = 0.6f, kDensity = 0.7f;
constexpr float kDetailMean = 0.45f;
constexpr float kAnvil = 0.1f;  // depth of an anvil's ice, share of the layer's thickness

// Depth in m of cloud as dense as the layer's that stands over a texel of its weather.
float depthOver(const float* weather, const Layer& layer) {
  const CloudLayer& c = layer.cloud;
  // The height profiles of nubis fill a good third of what their coverage leaves.
  if (c.shape == LayerShape::nubis) return 0.35f * c.thickness * std::max(weather[0] - 0.3f, 0.0f);
  const ProfileSettings& s = layer.profile;
  const float amplitude = std::min(s.lengthScale, s.lengthFraction * weather[0] + s.minLength);
  const float eroded = kEroded * (s.erosion * amplitude + kDetailMean * s.detail);
  return kDensity * std::max(weather[0] - eroded, 0.0f) + kAnvil * s.anvilDensity * c.thickness * weather[2];
}

float layerReflectance(Layer layer, int seed) {
  layer.weather.map.clear();
  const Volume weather = bakeWeather(layer, glm::dvec2(0.0), kEdge, kTexels, {}, seed);
  double sum = 0.0;
  for (std::size_t i = 0; i < weather.texels.size(); i += 4) {
    const float turned = kTurned * layer.cloud.extinction * depthOver(&weather.texels[i], layer);
    sum += turned / (1.0f + turned);
  }
  return static_cast<float>(sum) / static_cast<float>(kTexels * kTexels);
}

}  // namespace

float cloudReflectance(std::span<const Layer> layers, int seed) {
  // Slabs on top of each other that take nothing: R / (1 - R) adds.
  float sum = 0.0f;
  for (const Layer& layer : layers) {
    const float r = std::min(layerReflectance(layer, seed), 0.999f);
    sum += r / (1.0f - r);
  }
  return sum / (1.0f + sum);
}

}  // namespace welkin
