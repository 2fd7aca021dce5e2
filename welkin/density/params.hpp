#pragma once
// From a layer's plain values to the parameters of its law, as seen from an anchor.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "welkin/density/law.hpp"
#include "welkin/density/layer.hpp"

namespace welkin {

constexpr double kPlanetRadius = 6360000.0;  // m

// What moves the clouds: wind in m/s, compass heading that it comes from in rad, time in s.
struct Drift {
  float windSpeed = 0.0f;
  float windFrom = 0.0f;
  double time = 0.0;
};

// The planet as seen from `anchor` (east, north, up in m; the world's origin lies on the ground). Throws Error
// (badInput) when the anchor is at the planet's centre.
law::PlanetParams planetParams(const glm::dvec3& anchor);

// A layer's parameters for positions relative to `anchor`. Noise origins are wrapped to their period in double.
law::LayerParams layerParams(const Layer& layer, const glm::dvec3& anchor, const Drift& drift);

// The same for its weather; `seed` is the scene's. Weather moves with the wind as a whole.
law::WeatherParams weatherParams(const Layer& layer, const glm::dvec2& anchor, const Drift& drift, int seed);

// The same for a sheet, which has a wind of its own.
law::SheetParams sheetParams(const Sheet& sheet, const glm::dvec2& anchor, double time, int seed);

// Altitudes that hold all of the layer's cloud.
struct Shell {
  float bottom, top;  // m
};
Shell shellOf(const Layer& layer);

// How the wind has moved the air since time 0, east and north in m.
glm::dvec2 driftOffset(const Drift& drift);

}  // namespace welkin
