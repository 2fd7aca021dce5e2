#pragma once
// The turning Earth: what the places of sun, moon and stars in a local sky have in common.
#include <glm/mat3x3.hpp>

namespace welkin {

// Terrestrial time less universal time in days: 69 s, right to a few seconds from 2000 to 2050 and to a minute from
// 1900 to 2100; the sun moves 0.0007 deg a minute, the moon 0.01.
inline constexpr double kDeltaT = 69.0 / 86400.0;

// Where the Earth's axis and its prime meridian point; all in rad.
struct EarthAxis {
  double nutation = 0;   // in longitude
  double obliquity = 0;  // true
  double sidereal = 0;   // apparent sidereal time at Greenwich
};

// For universal time as days since 2000-01-01 12:00 (Meeus 1998 ch. 12, 22: the four largest terms of the nutation).
EarthAxis earthAxis(double daysSince2000);

// From equatorial axes (x to the equinox, z to the celestial pole) to east, north, up where the local sidereal time and
// the latitude are these (rad).
glm::dmat3 localFromEquatorial(double siderealTime, double latitude);

}  // namespace welkin
