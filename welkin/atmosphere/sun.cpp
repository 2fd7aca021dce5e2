#include "welkin/atmosphere/sun.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "welkin/atmosphere/earth.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/error.hpp"

namespace welkin {

namespace {

constexpr double kArcsecond = kDegree / 3600.0;

// VSOP87 (Bretagnon and Francou 1988), heliocentric longitude of the Earth: amplitude (1e-8 rad), phase, frequency (per
// 1000 years). Terms under 2.7e-6 rad are left out.
struct EarthTerm {
  double amplitude, phase, frequency;
};
constexpr std::array<EarthTerm, 22> kL0{{{175347046, 0, 0},
                                         {3341656, 4.6692568, 6283.0758500},
                                         {34894, 4.62610, 12566.15170},
                                         {3497, 2.7441, 5753.3849},
                                         {3418, 2.8289, 3.5231},
                                         {3136, 3.6277, 77713.7715},
                                         {2676, 4.4181, 7860.4194},
                                         {2343, 6.1352, 3930.2097},
                                         {1324, 0.7425, 11506.7698},
                                         {1273, 2.0371, 529.6910},
                                         {1199, 1.1096, 1577.3435},
                                         {990, 5.233, 5884.927},
                                         {902, 2.045, 26.298},
                                         {857, 3.508, 398.149},
                                         {780, 1.179, 5223.694},
                                         {753, 2.533, 5507.553},
                                         {505, 4.583, 18849.228},
                                         {492, 4.205, 775.523},
                                         {357, 2.920, 0.067},
                                         {317, 5.849, 11790.629},
                                         {284, 1.899, 796.298},
                                         {271, 0.315, 10977.079}}};
constexpr std::array<EarthTerm, 4> kL1{
    {{628331966747, 0, 0}, {206059, 2.678235, 6283.075850}, {4303, 2.6351, 12566.1517}, {425, 1.590, 3.523}}};
constexpr std::array<EarthTerm, 2> kL2{{{52919, 0, 0}, {8720, 1.0721, 6283.0758}}};

template <std::size_t N>
double sumTerms(const std::array<EarthTerm, N>& terms, double tau) {
  double sum = 0;
  for (const EarthTerm& t : terms) sum += t.amplitude * std::cos(t.phase + t.frequency * tau);
  return sum * 1e-8;
}

double positiveAngle(double x) {
  const double r = std::fmod(x, 2 * kPi);
  return r < 0 ? r + 2 * kPi : r;
}

bool isLeap(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

// Julian day number of a Gregorian date at noon (Fliegel and van Flandern 1968).
long julianDay(int y, int m, int d) {
  const long a = (m - 14) / 12;
  return (1461 * (y + 4800 + a)) / 4 + (367 * (m - 2 - 12 * a)) / 12 - (3 * ((y + 4900 + a) / 100)) / 4 + d - 32075;
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::badInput, "sun", what); }

}  // namespace

glm::dvec3 directionFromAngles(double azimuth, double elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

EarthAxis earthAxis(double daysSince2000) {
  const double century = (daysSince2000 + kDeltaT) / 36525.0;
  const double node = (125.04452 - 1934.136261 * century) * kDegree;
  const double sunLongitude = (280.4665 + 36000.7698 * century) * kDegree;
  const double moonLongitude = (218.3165 + 481267.8813 * century) * kDegree;
  EarthAxis axis;
  axis.nutation = (-17.20 * std::sin(node) - 1.32 * std::sin(2 * sunLongitude) - 0.23 * std::sin(2 * moonLongitude) +
                   0.21 * std::sin(2 * node)) *
                  kArcsecond;
  axis.obliquity =
      (23.4392911 - 0.0130042 * century) * kDegree + (9.20 * std::cos(node) + 0.57 * std::cos(2 * sunLongitude) +
                                                      0.10 * std::cos(2 * moonLongitude) - 0.09 * std::cos(2 * node)) *
                                                         kArcsecond;
  const double t = daysSince2000 / 36525.0;  // Meeus eq. 12.4
  axis.sidereal = (280.46061837 + 360.98564736629 * daysSince2000 + 0.000387933 * t * t) * kDegree +
                  axis.nutation * std::cos(axis.obliquity);
  return axis;
}

glm::dmat3 localFromEquatorial(double siderealTime, double latitude) {
  const double c = std::cos(siderealTime), s = std::sin(siderealTime);
  const double cl = std::cos(latitude), sl = std::sin(latitude);
  return {{-s, -sl * c, cl * c}, {c, -sl * s, cl * s}, {0.0, cl, sl}};  // columns
}

SolarPosition solarPosition(double daysSince2000, double latitude, double longitude) {
  const double tau = (daysSince2000 + kDeltaT) / 365250.0, century = 10 * tau;
  const double earth = sumTerms(kL0, tau) + tau * sumTerms(kL1, tau) + tau * tau * sumTerms(kL2, tau);
  const double anomaly = (357.52911 + 35999.05029 * century) * kDegree;                             // Meeus eq. 25.3
  const double distance = 1.00014 - 0.01671 * std::cos(anomaly) - 0.00014 * std::cos(2 * anomaly);  // au

  const EarthAxis axis = earthAxis(daysSince2000);
  const double lambda = earth + kPi + axis.nutation - (20.4898 / distance) * kArcsecond;
  const double ascension = std::atan2(std::sin(lambda) * std::cos(axis.obliquity), std::cos(lambda));
  const double declination = std::asin(std::sin(axis.obliquity) * std::sin(lambda));

  const double hourAngle = axis.sidereal + longitude - ascension;

  const double sinElevation =
      std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hourAngle);
  const double geocentric = std::asin(std::fmin(1.0, std::fmax(-1.0, sinElevation)));
  const double fromSouth = std::atan2(
      std::sin(hourAngle), std::cos(hourAngle) * std::sin(latitude) - std::tan(declination) * std::cos(latitude));
  const double parallax = (8.794 / distance) * kArcsecond * std::cos(geocentric);
  return {positiveAngle(fromSouth + kPi), geocentric - parallax};
}

double daysFromDateTime(const std::string& date, const std::string& time) {
  int year = 0, month = 0, day = 0, used = 0;
  if (std::sscanf(date.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &used) != 3 ||
      static_cast<std::size_t>(used) != date.size())
    refuse("date is \"" + date + "\", but must read year-month-day, such as \"2026-06-21\"");
  if (year < 1583 || year > 3000) refuse("date is \"" + date + "\", but its year must lie between 1583 and 3000");
  if (month < 1 || month > 12) refuse("date is \"" + date + "\", but there is no month " + std::to_string(month));
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const int last = kDays[month - 1] + (month == 2 && isLeap(year) ? 1 : 0);
  if (day < 1 || day > last) refuse("date is \"" + date + "\", but that month has days 1 to " + std::to_string(last));

  int hour = 0, minute = 0;
  double second = 0;
  used = 0;
  const bool withSeconds = std::sscanf(time.c_str(), "%2d:%2d:%lf%n", &hour, &minute, &second, &used) == 3 &&
                           static_cast<std::size_t>(used) == time.size();
  if (!withSeconds) {
    second = 0;
    used = 0;
    if (std::sscanf(time.c_str(), "%2d:%2d%n", &hour, &minute, &used) != 2 ||
        static_cast<std::size_t>(used) != time.size())
      refuse("time is \"" + time + "\", but must read hours:minutes:seconds, such as \"18:30:00\"");
  }
  if (hour < 0 || hour > 24 || minute < 0 || minute > 59 || !(second >= 0.0 && second < 60.0) ||
      (hour == 24 && (minute != 0 || second != 0.0)))
    refuse("time is \"" + time + "\", but a day has hours 0 to 24, minutes 0 to 59 and seconds below 60");
  constexpr long kNoon2000 = 2451545;
  return static_cast<double>(julianDay(year, month, day) - kNoon2000) - 0.5 +
         (hour * 3600.0 + minute * 60.0 + second) / 86400.0;
}

DateTime dateTimeFromDays(double daysSince2000) {
  using namespace std::chrono;
  constexpr long kDay = 86400000;
  const sys_days start{2000y / January / 1};
  const long all = std::lround((daysSince2000 + 0.5) * kDay);
  const long day = (all >= 0 ? all : all - kDay + 1) / kDay, left = all - day * kDay;
  const year_month_day date{start + days(day)};
  char dateText[32], timeText[32];
  std::snprintf(dateText, sizeof dateText, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  std::snprintf(timeText, sizeof timeText, "%02ld:%02ld:%02ld.%03ld", left / 3600000, left / 60000 % 60,
                left / 1000 % 60, left % 1000);
  return {dateText, timeText};
}

glm::vec3 sunDirection(const Sun& sun) {
  if (sun.mode == SunMode::angles) return glm::vec3(directionFromAngles(sun.azimuth, sun.elevation));
  const double days = daysFromDateTime(sun.date, sun.time) - static_cast<double>(sun.utcOffset) / 86400.0;
  const SolarPosition p = solarPosition(days, sun.latitude, sun.longitude);
  return glm::vec3(directionFromAngles(p.azimuth, p.elevation));
}

}  // namespace welkin
