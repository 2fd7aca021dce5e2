#include "apps/viewer/model/weather_view.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "welkin/base/parallel.hpp"
#include "welkin/density/weather_map.hpp"

namespace welkin::viewer {

namespace {

// sRGB; of taste.
constexpr glm::vec3 kNone{0.09f, 0.12f, 0.17f};
constexpr glm::vec3 kTints[] = {
    {0.16f, 0.44f, 0.85f}, {0.10f, 0.62f, 0.42f}, {0.66f, 0.34f, 0.80f}, {0.85f, 0.52f, 0.15f}};

// The channel at a place of the air's own frame, filtered as the law's sampler does.
float authored(const WeatherSettings& weather, const Volume* map, const glm::dvec2& place, int channel) {
  if (weather.map.empty() || !map) {
    const float settings[] = {weather.coverage, weather.precipitation, weather.type, 0.0f};
    return settings[channel];
  }
  const glm::dvec2 share = place / static_cast<double>(weather.mapSize) + 0.5;
  const glm::dvec2 at = (share - glm::floor(share)) * glm::dvec2(map->width, map->height) - 0.5;
  const glm::dvec2 low = glm::floor(at);
  const glm::vec2 part(at - low);
  const auto texel = [&](int dx, int dy) {
    const int x = (static_cast<int>(low.x) + dx + map->width) % map->width;
    const int y = (static_cast<int>(low.y) + dy + map->height) % map->height;
    return map->at(x, y, 0)[channel];
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
}

}  // namespace

std::vector<std::uint8_t> weatherImage(const Layer& layer, const Volume* map, const Drift& drift, int seed,
                                       const WeatherView& view) {
  Volume weather;
  if (view.clouds) weather = bakeWeather(layer, view.centre, view.edge, view.size, drift, seed, map);
  const bool nubis = layer.cloud.shape == LayerShape::nubis;
  const glm::dvec2 corner = view.centre - driftOffset(drift) - 0.5 * view.edge;
  const auto size = static_cast<std::size_t>(view.size);
  std::vector<std::uint8_t> rgba(size * size * 4);
  parallelFor(size, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t x = 0; x < size; ++x) {
        const std::size_t y = size - 1 - row;
        const glm::dvec2 place =
            corner + (glm::dvec2(static_cast<double>(x), static_cast<double>(y)) + 0.5) * (view.edge / view.size);
        const float value = authored(layer.weather, map, place, view.channel);
        glm::vec3 colour = glm::mix(kNone, kTints[view.channel], std::clamp(value, 0.0f, 1.0f));
        if (view.clouds) {
          const float first = weather.at(static_cast<int>(x), static_cast<int>(y), 0)[0];
          const float tall = std::clamp(nubis ? first : first / layer.cloud.thickness, 0.0f, 1.0f);
          const float cover = std::min(12.0f * tall, 1.0f) * (0.35f + 0.6f * tall);
          colour = glm::mix(colour, glm::vec3(0.97f), cover);
        }
        std::uint8_t* to = &rgba[(row * size + x) * 4];
        for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>(std::lround(255.0f * colour[c]));
        to[3] = 255;
      }
  });
  return rgba;
}

}  // namespace welkin::viewer
