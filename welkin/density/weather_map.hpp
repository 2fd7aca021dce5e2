#pragma once
// The weather on the CPU: texels of the law of density/weather.glsl, the same as those of realtime/weather_levels.hpp
// before both are rounded to half floats.
#include <glm/vec2.hpp>

#include "welkin/density/params.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {

// texels^2 x 4 over the square of `edge` m round `centre` (east and north in m), south row first, texel (i, j) at
// (i + 1/2, j + 1/2) / texels: profileWeather (height of the top above the base in m, shift of the base in m, anvil,
// precipitation) or nubisWeather (coverage, type, precipitation, shift of the base in m), as the layer's shape asks.
// `seed` is the scene's; `map` the authoring picture that layer.weather.map names (RGBA, south row first), null where
// it names none. The same bits on any number of threads. Throws Error (badInput) for a missing map, one without four
// channels, or a size below 1.
Volume bakeWeather(const Layer& layer, const glm::dvec2& centre, double edge, int texels, const Drift& drift, int seed,
                   const Volume* map = nullptr);

// The map to sample, a single neutral texel where the layer names none. Throws as bakeWeather.
TextureView authoringMap(const Layer& layer, const Volume* map);

}  // namespace welkin
