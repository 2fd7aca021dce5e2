#pragma once
// Where the sun stands.
#include <glm/vec3.hpp>
#include <string>

#include "welkin/atmosphere/settings.hpp"

namespace welkin {

// Angles of the sun seen from a place on Earth, in rad; azimuth is a compass heading in [0, 2 pi).
struct SolarPosition {
  double azimuth = 0, elevation = 0;
};

// A unit vector (east, north, up) toward a compass heading and elevation in rad.
glm::dvec3 directionFromAngles(double azimuth, double elevation);

// Apparent place of the sun without refraction, for universal time as days since 2000-01-01 12:00. Good to 0.003 deg
// from 1900 to 2100: the largest terms of VSOP87 for the Earth (Meeus 1998 ch. 25, 32; Reda and Andreas 2004),
// nutation (Meeus ch. 22), aberration and parallax. Latitude north and longitude east in rad.
SolarPosition solarPosition(double daysSince2000, double latitude, double longitude);

// Days since 2000-01-01 12:00 of a date "2026-06-21" and a time "18:30" or "18:30:00.5". Throws Error (badInput) that
// names what is wrong with them.
double daysFromDateTime(const std::string& date, const std::string& time);

// Its inverse, to the millisecond: "2026-06-21" and "18:30:00.000".
struct DateTime {
  std::string date, time;
};
DateTime dateTimeFromDays(double daysSince2000);

// Unit vector toward the sun. Throws Error (badInput) for a date or time that does not exist, in mode place.
glm::vec3 sunDirection(const Sun& sun);

}  // namespace welkin
