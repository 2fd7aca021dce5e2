#pragma once
// Clip levels: the weather cached in nested squares round a place, each a slice of two texture stacks, those of all
// cloud layers one after the other. The geometry serves every cache; WeatherCache holds one on the CPU.
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "welkin/density/params.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {

// Size of the cached weather.
struct WeatherExtent {
  int texels = 512;
  int levels = 4;           // 2 to 4
  double finest = 20000.0;  // m, edge of level 0
  double ratio = 2.8;       // each level against the one before

  double edge(int level) const;  // m
};

// Shares of a level's edge that the camera may move before the level is made again, and after which it is of no use.
inline constexpr double kLeash = 0.08, kUseless = 0.3;

// Where a level is centred that serves `inAir` (m, in the air's own frame): on a texel's corner.
glm::dvec2 levelCentre(const WeatherExtent& extent, int level, const glm::dvec2& inAir);

// The law's view of a level from a place `away` from its centre.
law::ClipLevel clipLevel(const WeatherExtent& extent, int level, const glm::dvec2& away);

// The level of a clip by number.
law::ClipLevel& levelOf(law::ClipParams& clip, int level);
const law::ClipLevel& levelOf(const law::ClipParams& clip, int level);

struct WeatherCache {
  Volume main;                         // texels^2 x (levels x layers), RG: (height or coverage, base shift or type)
  Volume extra;                        // RG: (anvil or precipitation, precipitation or base shift)
  std::vector<law::ClipParams> clips;  // one for each layer
  TextureView mainView() const;
  TextureView extraView() const;
};

// The cache of these layers round `position`. `seed` is the scene's; `maps` holds the authoring picture of every layer
// that names one, at its index, or is empty. Throws as bakeWeather.
WeatherCache bakeWeatherLevels(std::span<const Layer> layers, const WeatherExtent& extent, const glm::dvec2& position,
                               const Drift& drift, int seed, std::span<const Volume> maps);

}  // namespace welkin
