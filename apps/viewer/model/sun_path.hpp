#pragma once
// The sun's way through a day, and times as people write them.
#include <optional>
#include <string>
#include <vector>

#include "welkin/atmosphere/sun.hpp"

namespace welkin::viewer {

// Where the sun stands at an hour (civil time, 0 to 24) of the day, seen from the place that `sun` names, whatever its
// mode. Throws Error (badInput) for a date that does not exist.
SolarPosition sunAt(const Sun& sun, double hour);

// Of a whole day, `steps` + 1 places from 0 to 24 h.
std::vector<SolarPosition> sunPath(const Sun& sun, int steps);

// Civil hours at which the sun's centre crosses the horizon (geometrically, without refraction); none where it stays up
// or down all day.
struct SunTimes {
  std::optional<double> rise, set;
};
SunTimes sunTimes(const Sun& sun);

// The hour at which the sun stands nearest to a direction of the sky.
double hourNearest(const Sun& sun, const SolarPosition& place);

// "18:30:00" and back; 12 for text that is no time.
std::string textFromHour(double hour);
double hourFromText(const std::string& text);

// The day of the year, from 1, of a date "2026-06-21", and the date so many days later.
int dayOfYear(const std::string& date);
std::string dateOfDay(const std::string& sameYear, int day);
int daysInYear(const std::string& date);

}  // namespace welkin::viewer
