#pragma once
// How rough the air is: what a flight model asks besides the density.
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "welkin/density/field.hpp"

namespace welkin {

struct TurbulenceSettings {
  int seed = 1;
  // Heat that the ground gives to the air, over density and heat capacity of the air, K m/s: about 0.1 at noon over
  // land, 0.01 over the sea, 0 by night, when no thermals rise.
  float heatFlux = 0.1f;
};

// Turbulence by the clouds that it has made or that make it. Three sources, added by their squares, as standard
// deviation of the vertical wind:
//   * inside convective cloud (populations domes, clusters, streets and front; nubis as far as its type is 1): 1 m/s at
//     the base and .7 m/s more with each km above it, less again near the top. Measured by J. Warner (1970, "The
//     microstructure of cumulus cloud, part III", J. Atmos. Sci. 27) in cumulus .7 to 4 km deep, and carried on to
//     deeper ones: 1 to 1.5 m/s in cumulus humilis, 5 to 7 in a cumulonimbus, where a tenth of the updraughts average
//     more than 5 m/s over sea (M. LeMone and E. Zipser 1980) and several times that over land. Closed cells have .4 of
//     it and sheets .15, by choice. A third of it reaches some 100 m out of sides and tops, where cloudy and clear air
//     mix; raining towers send two fifths down to the ground.
//   * thermals under convective cloud whose base is low enough to have grown from the ground: w* sqrt(1.8 x^(2/3))
//     (1 - .8 x) at the share x of the base's height (D. Lenschow, J. Wyngaard and W. Pennell 1980), with the
//     convective velocity w* = (g / T heatFlux base)^(1/3), 1.6 m/s on a fine day; between the clouds .4 of it.
//   * imported grids: 1 m/s inside.
// Above and away from clouds the air is calm: no jet streams, mountain waves or wakes. For comparison, vertical gusts
// of .8, 1.5 and 2.3 m/s (0.1 of winds of 15, 30 and 45 knots) are light, moderate and severe low turbulence in
// MIL-F-8785C; above the ground's layer 1.5 m/s is light and 3 m/s moderate.
//
// Safe to ask from many threads. Points are those of DensityField, whose drift says where the clouds are.
class Turbulence {
 public:
  // Keeps a reference to the field.
  explicit Turbulence(const DensityField& field, const TurbulenceSettings& settings = {})
      : field_(field), settings_(settings) {}

  // Standard deviation of the vertical wind in m/s, over some 100 m; continuous in space; 0 for points that are not
  // finite. About 0.1 ms for one point and layer.
  double deviation(const glm::dvec3& point) const { return deviations(std::span(&point, 1)).front(); }
  std::vector<double> deviations(std::span<const glm::dvec3> points) const;

  // The gust at a point and time (s), east, north and up in m/s, to be added to the mean wind: the deviation times
  // gustPattern. Continuous in space and time, the same for the same seed.
  glm::dvec3 gust(const glm::dvec3& point, double time) const;

  // The same in air whose every component has a standard deviation of 1 m/s: flow without divergence (curl noise),
  // carried by the wind, eddies of 600, 300, 150 and 75 m with velocities as the cube root of their size, as in
  // Kolmogorov's spectrum, each turning into another one in the time that 3 m/s take to cross it. (Warner: most energy
  // at 500 to 600 m.)
  glm::dvec3 gustPattern(const glm::dvec3& point, double time) const;

 private:
  std::vector<double> variances(std::span<const glm::dvec3> points) const;

  const DensityField& field_;
  TurbulenceSettings settings_;
};

}  // namespace welkin
