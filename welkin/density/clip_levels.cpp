#include "welkin/density/clip_levels.hpp"

#include <cmath>

#include "welkin/density/weather_map.hpp"

namespace welkin {

double WeatherExtent::edge(int level) const { return finest * std::pow(ratio, level); }

glm::dvec2 levelCentre(const WeatherExtent& extent, int level, const glm::dvec2& inAir) {
  const double texel = extent.edge(level) / extent.texels;
  return glm::floor(inAir / texel) * texel;
}

law::ClipLevel clipLevel(const WeatherExtent& extent, int level, const glm::dvec2& away) {
  const double edge = extent.edge(level);
  return {static_cast<float>(away.x / edge + 0.5), static_cast<float>(away.y / edge + 0.5),
          static_cast<float>(1.0 / edge), 1.0f / static_cast<float>(extent.texels) + 0.01f};
}

law::ClipLevel& levelOf(law::ClipParams& clip, int level) {
  law::ClipLevel* const levels[] = {&clip.level0, &clip.level1, &clip.level2, &clip.level3};
  return *levels[level];
}
const law::ClipLevel& levelOf(const law::ClipParams& clip, int level) {
  return levelOf(const_cast<law::ClipParams&>(clip), level);
}

namespace {
TextureView stackOf(const Volume& v) {
  return {v.texels.data(), v.width, v.height, v.depth, v.channels, Wrap::clamp, Wrap::clamp};
}
}  // namespace

TextureView WeatherCache::mainView() const { return stackOf(main); }
TextureView WeatherCache::extraView() const { return stackOf(extra); }

WeatherCache bakeWeatherLevels(std::span<const Layer> layers, const WeatherExtent& extent, const glm::dvec2& position,
                               const Drift& drift, int seed, std::span<const Volume> maps) {
  const int slices = extent.levels * static_cast<int>(layers.size());
  WeatherCache cache{Volume(extent.texels, extent.texels, slices, 2), Volume(extent.texels, extent.texels, slices, 2),
                     std::vector<law::ClipParams>(layers.size())};
  const glm::dvec2 inAir = position - driftOffset(drift);
  const std::size_t texels = static_cast<std::size_t>(extent.texels) * static_cast<std::size_t>(extent.texels);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    law::ClipParams& clip = cache.clips[i];
    clip = {};
    clip.count = extent.levels;
    clip.firstSlice = static_cast<float>(i * static_cast<std::size_t>(extent.levels));
    for (int level = 0; level < extent.levels; ++level) {
      const glm::dvec2 centre = levelCentre(extent, level, inAir);
      levelOf(clip, level) = clipLevel(extent, level, inAir - centre);
      // In still air, with the level's centre as anchor.
      const Volume baked =
          bakeWeather(layers[i], centre, extent.edge(level), extent.texels, Drift{drift.windSpeed, drift.windFrom, 0.0},
                      seed, i < maps.size() ? &maps[i] : nullptr);
      const std::size_t start =
          2 * texels * (i * static_cast<std::size_t>(extent.levels) + static_cast<std::size_t>(level));
      for (std::size_t t = 0; t < texels; ++t)
        for (std::size_t c = 0; c < 2; ++c) {
          cache.main.texels[start + 2 * t + c] = baked.texels[4 * t + c];
          cache.extra.texels[start + 2 * t + c] = baked.texels[4 * t + 2 + c];
        }
    }
  }
  return cache;
}

}  // namespace welkin
