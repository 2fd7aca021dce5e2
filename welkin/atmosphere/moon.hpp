#pragma once
// Where the moon stands, how bright it is, and which lights a sky has.
#include "welkin/atmosphere/params.hpp"
#include "welkin/atmosphere/settings.hpp"

namespace welkin {

// The moon seen from a place on Earth. Angles in rad; azimuth is a compass heading in [0, 2 pi); `distance` to the
// observer in m; `phase` between sun and observer seen from the moon: 0 is full, pi is new.
struct LunarPosition {
  double azimuth = 0, elevation = 0, distance = 0, phase = 0;
};

// Apparent place of the moon without refraction, with parallax, for universal time as days since 2000-01-01 12:00. Good
// to 0.02 deg from 1900 to 2100: the largest terms of ELP-2000/82 (Chapront-Touze and Chapront 1983; Meeus 1998 ch.
// 47).
LunarPosition lunarPosition(double daysSince2000, double latitude, double longitude);

// Illuminance outside the air by a moon at its mean distance, klx on a plane facing it: 3.1e-4 when full (Krisciunas
// and Schaefer 1991, eq. 9: magnitude -12.73 + 0.026 |phase| + 4e-9 phase^4, in degrees; magnitude 0 is 2.54e-6 lx).
double lunarIlluminance(double phase);

// A scene's sun, moon and stars.
struct Heavens {
  glm::vec3 sun{0.0f, 0.0f, 1.0f};  // unit vector toward it
  SkyLights lights{glm::vec3(0.0f, 0.0f, 1.0f)};
  law::NightParams night{};
  bool moonShows = false, starsShow = false;  // whether there is any need to draw them
};

// One light at a time shines on clouds and ground: the moon's as soon as the sun has left even clouds at 12 km (it
// stands 4 degrees below the horizon) and while the moon has not; the sun's otherwise. The air is lit by both where
// both count, so that twilight does not jump. Throws Error (badInput) for a date or time that does not exist.
Heavens heavensOf(const Sun& sun, const Moon& moon, const Night& night);

}  // namespace welkin
