#pragma once
// A layer's weather from above, as the panel shows it.
#include <cstdint>
#include <vector>

#include "welkin/density/layer.hpp"
#include "welkin/density/params.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin::viewer {

struct WeatherView {
  glm::dvec2 centre{0.0};  // east and north, m
  double edge = 60000.0;   // m
  int size = 192;          // pixels a side
  int channel = 0;         // of kWeatherChannels
  bool clouds = true;      // with the clouds that the generator makes of it
};

// RGBA, north up: a channel of the authoring map as a tint, and the clouds over it, taller ones whiter. `map` as of
// bakeWeather(), which throws what this throws.
std::vector<std::uint8_t> weatherImage(const Layer& layer, const Volume* map, const Drift& drift, int seed,
                                       const WeatherView& view);

}  // namespace welkin::viewer
