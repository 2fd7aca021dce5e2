#include "apps/viewer/model/sun_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

using std::chrono::sys_days, std::chrono::year_month_day;

// 2026-01-01 for text that is no date.
year_month_day dateFrom(const std::string& text) {
  int year = 2026;
  unsigned month = 1, day = 1;
  if (std::sscanf(text.c_str(), "%d-%u-%u", &year, &month, &day) != 3) year = 2026, month = day = 1;
  const year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
  return date.ok() ? date : year_month_day{std::chrono::year(2026), std::chrono::January, std::chrono::day(1)};
}

sys_days newYear(const year_month_day& date) {
  return sys_days(year_month_day{date.year(), std::chrono::January, std::chrono::day(1)});
}

// Where the elevation changes its sign between two hours.
double crossing(const Sun& sun, double low, double high) {
  const bool up = sunAt(sun, low).elevation > 0.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    ((sunAt(sun, middle).elevation > 0.0) == up ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

SolarPosition sunAt(const Sun& sun, double hour) {
  const double days = daysFromDateTime(sun.date, "00:00") + hour / 24.0 - static_cast<double>(sun.utcOffset) / 86400.0;
  return solarPosition(days, sun.latitude, sun.longitude);
}

std::vector<SolarPosition> sunPath(const Sun& sun, int steps) {
  std::vector<SolarPosition> path;
  for (int i = 0; i <= steps; ++i) path.push_back(sunAt(sun, 24.0 * i / steps));
  return path;
}

SunTimes sunTimes(const Sun& sun) {
  constexpr int kSteps = 96;
  SunTimes times;
  const std::vector<SolarPosition> path = sunPath(sun, kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double low = 24.0 * i / kSteps, high = 24.0 * (i + 1) / kSteps;
    const bool before = path[static_cast<std::size_t>(i)].elevation > 0.0;
    const bool after = path[static_cast<std::size_t>(i) + 1].elevation > 0.0;
    if (!before && after && !times.rise) times.rise = crossing(sun, low, high);
    if (before && !after && !times.set) times.set = crossing(sun, low, high);
  }
  return times;
}

double hourNearest(const Sun& sun, const SolarPosition& place) {
  const glm::dvec3 wanted = directionFromAngles(place.azimuth, place.elevation);
  const auto distance = [&](double hour) {
    const SolarPosition at = sunAt(sun, hour);
    return -glm::dot(wanted, directionFromAngles(at.azimuth, at.elevation));
  };
  constexpr int kSteps = 96;
  double best = 12.0, least = 2.0;
  for (int i = 0; i <= kSteps; ++i)
    if (const double d = distance(24.0 * i / kSteps); d < least) least = d, best = 24.0 * i / kSteps;
  // Golden section round the best of them.
  double low = std::max(best - 24.0 / kSteps, 0.0), high = std::min(best + 24.0 / kSteps, 24.0);
  for (int i = 0; i < 40; ++i) {
    const double a = high - 0.618034 * (high - low), b = low + 0.618034 * (high - low);
    if (distance(a) < distance(b))
      high = b;
    else
      low = a;
  }
  return 0.5 * (low + high);
}

std::string textFromHour(double hour) {
  const int seconds = std::clamp(static_cast<int>(std::lround(hour * 3600.0)), 0, 24 * 3600 - 1);
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

double hourFromText(const std::string& text) {
  try {
    return (daysFromDateTime("2000-01-01", text) - daysFromDateTime("2000-01-01", "00:00")) * 24.0;
  } catch (const Error&) {
    return 12.0;
  }
}

int dayOfYear(const std::string& date) {
  const year_month_day d = dateFrom(date);
  return static_cast<int>((sys_days(d) - newYear(d)).count()) + 1;
}

std::string dateOfDay(const std::string& sameYear, int day) {
  const year_month_day year = dateFrom(sameYear);
  const year_month_day d{newYear(year) + std::chrono::days(std::clamp(day, 1, daysInYear(sameYear)) - 1)};
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(d.year()), static_cast<unsigned>(d.month()),
                     static_cast<unsigned>(d.day()));
}

int daysInYear(const std::string& date) { return dateFrom(date).year().is_leap() ? 366 : 365; }

}  // namespace welkin::viewer
