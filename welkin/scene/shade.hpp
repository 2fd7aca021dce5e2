#pragma once
// How much sunlight the clouds leave to a point, on the CPU.
#include <cmath>
#include <glm/vec3.hpp>

#include "welkin/density/field.hpp"

namespace welkin {

// Share of the extinction that turns light aside: 1 - g with g = .86, of water droplets. The rest is scattered forward
// and arrives from nearly where the sun stands. The same as kReduced in realtime/light_volume.glsl.
inline constexpr double kTurnedAside = 0.14;

// Share of the sun's light that reaches a point (of DensityField: east, north, altitude in m), exp(-.14 optical depth)
// along the ray `toSun` (unit vector) in steps of `step` m, by the midpoint rule: what welkinSunShare() answers on the
// GPU from its lattice. There edges of shadows are as wide as the lattice's cells (100 m within 6 km of the eye with
// quality high); here they are exact. On the ground under fair-weather cumulus the two differ by .04 in the mean. High
// sheets do not count here. About .06 ms for one layer.
inline double sunShare(const DensityField& field, const glm::dvec3& point, const glm::dvec3& toSun,
                       double step = 20.0) {
  return std::exp(-kTurnedAside * field.opticalDepthToward(point, toSun, step));
}

}  // namespace welkin
