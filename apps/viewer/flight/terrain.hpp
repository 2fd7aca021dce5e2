#pragma once
// The land under a flight: a pure function of place and seed. A coast with a plain, hills behind it, mountains farther
// inland, and a runway at the origin.
#include "apps/viewer/flight/aircraft.hpp"

namespace welkin::viewer {

struct Runway {
  double heading = 4.71238898;  // rad, compass: the direction of take-off
  double length = 1600.0, width = 40.0;
  double elevation = 14.0;  // m
};

class Terrain final : public SurfaceSource {
 public:
  explicit Terrain(unsigned seed = 1, const Runway& runway = {});

  // Height over the sea in m; below 0 it is the sea's floor. Points beyond 4000 km are those at that distance.
  double height(double east, double north) const;
  // How much grows there, of chance: about -1 to 1.
  double woods(double east, double north) const;
  // What one meets: land, runway, or the sea at height 0.
  Surface surface(double east, double north) const override;
  const Runway& runway() const { return runway_; }
  // East and north of a place along the runway and to its right, m from its middle.
  glm::dvec2 runwayPlace(double along, double right) const;
  glm::dvec2 alongAndRight(double east, double north) const;

 private:
  double noise(double east, double north, double size, unsigned salt) const;

  unsigned seed_;
  Runway runway_;
};

}  // namespace welkin::viewer
