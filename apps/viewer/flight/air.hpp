#pragma once
// The air that an aircraft flies in: the sky's wind, and the turbulence of its clouds.
#include <memory>
#include <span>

#include "apps/viewer/flight/aircraft.hpp"
#include "welkin/density/field.hpp"
#include "welkin/density/turbulence.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

class AirOfSky {
 public:
  AirOfSky();
  ~AirOfSky();
  AirOfSky(const AirOfSky&) = delete;
  AirOfSky& operator=(const AirOfSky&) = delete;

  // Takes over a sky; quick when its noise and shapes are those of the last one. Throws Error (badInput).
  void setScene(const Scene& scene, std::span<const Volume> weatherMaps, std::span<const PlacedGrid> grids);

  // The air at a place and at the wing tips (m, `right` from the middle to the right one), at the sky's time in s.
  Air at(const glm::dvec3& point, const glm::dvec3& right, double time);
  // Extinction of the clouds there, 1/m: what the pilot sees is 3.9 over it.
  double extinction(const glm::dvec3& point) const;

 private:
  Scene scene_;
  DensityTextures textures_;
  std::unique_ptr<DensityField> field_;
  std::unique_ptr<Turbulence> turbulence_;
};

// The mean wind at a height over the ground, m/s: the sky's above 1000 m, less below it as the power law with an
// exponent of .16 has it over open land.
glm::dvec3 meanWind(const Wind& wind, double height);

}  // namespace welkin::viewer
