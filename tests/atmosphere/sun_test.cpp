// Where the sun stands: NREL's worked example (Reda and Andreas 2004, table A5.1), the compass, refusals.
#include "welkin/atmosphere/sun.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/error.hpp"

namespace welkin {
namespace {

TEST(Sun, StandsWhereNrelComputesIt) {
  const double days = daysFromDateTime("2003-10-17", "12:30:30") + 7.0 / 24.0;
  const SolarPosition p = solarPosition(days, 39.742476 * kDegree, -105.1786 * kDegree);
  EXPECT_NEAR(p.azimuth / kDegree, 194.3402, 2e-3);
  EXPECT_NEAR(p.elevation / kDegree, 39.872, 2e-3);
}

TEST(Sun, DaysCountFromNoonOfTheYear2000) {
  EXPECT_EQ(daysFromDateTime("2000-01-01", "12:00"), 0.0);
  EXPECT_EQ(daysFromDateTime("2000-03-01", "00:00:00"), 59.5);
  EXPECT_EQ(daysFromDateTime("1999-12-31", "24:00"), -0.5);
  EXPECT_NEAR(daysFromDateTime("2024-02-29", "06:00:30.5"), 8824.5 + 0.25 + 30.5 / 86400, 1e-9);
}

// Equinox of March 2026, 14:46 UT: the declination is zero, so the sun is overhead somewhere on the equator.
TEST(Sun, CrossesTheEquatorAtTheEquinox) {
  const SolarPosition p = solarPosition(daysFromDateTime("2026-03-20", "14:46"), 90 * kDegree, 0);
  EXPECT_NEAR(p.elevation / kDegree, 0.0, 0.004);
}

TEST(Sun, CompassAndAxes) {
  const glm::vec3 east = sunDirection({.elevation = 0, .azimuth = static_cast<float>(90 * kDegree)});
  EXPECT_NEAR(east.x, 1, 1e-6);
  const glm::vec3 north = sunDirection({.elevation = 0, .azimuth = 0});
  EXPECT_NEAR(north.y, 1, 1e-6);
  EXPECT_NEAR(sunDirection({.elevation = static_cast<float>(90 * kDegree)}).z, 1, 1e-6);
  Sun morning{
      .mode = SunMode::place, .date = "2026-03-20", .time = "06:30", .utcOffset = 0, .latitude = 0.8f, .longitude = 0};
  EXPECT_GT(sunDirection(morning).x, 0.9f) << "the sun rises in the east";
  morning.time = "12:00";
  EXPECT_LT(sunDirection(morning).y, -0.6f) << "and stands in the south at noon";
  morning.utcOffset = 12 * 3600.0f;
  EXPECT_LT(sunDirection(morning).z, 0.0f) << "noon at +12 h is midnight here";
}

// The brightest sky of a table stands where the sun is: +x for a sun in the east.
TEST(Sun, OrientsTheSky) {
  const glm::vec3 sun = sunDirection({.elevation = 0.3f, .azimuth = static_cast<float>(90 * kDegree)});
  const SkyTablesCpu sky = bakeSky({}, sun, 100.0);
  const auto at = [&](const glm::vec3& d) {
    return luminance(law::lookupSky(sky.skyView.view(), sky.params.air, glm::normalize(d)));
  };
  EXPECT_GT(at({1, 0, 0.3f}), 2 * at({-1, 0, 0.3f}));
  EXPECT_NEAR(at({0, 1, 0.3f}), at({0, -1, 0.3f}), 1e-3);
}

std::string refusal(const std::string& date, const std::string& time) {
  try {
    daysFromDateTime(date, time);
  } catch (const Error& e) {
    return e.kind() == ErrorKind::badInput ? e.what() : "wrong kind";
  }
  return "";
}

TEST(Sun, RefusesDatesAndTimesThatDoNotExist) {
  EXPECT_NE(refusal("2026-02-29", "12:00").find("days 1 to 28"), std::string::npos);
  EXPECT_NE(refusal("2026-13-01", "12:00").find("no month 13"), std::string::npos);
  EXPECT_NE(refusal("21.6.2026", "12:00").find("year-month-day"), std::string::npos);
  EXPECT_NE(refusal("2026-06-21x", "12:00").find("year-month-day"), std::string::npos);
  EXPECT_NE(refusal("", "12:00"), "");
  EXPECT_NE(refusal("0001-01-01", "12:00").find("1583"), std::string::npos);
  EXPECT_NE(refusal("2026-06-21", "25:00").find("hours 0 to 24"), std::string::npos);
  EXPECT_NE(refusal("2026-06-21", "12:60").find("minutes"), std::string::npos);
  EXPECT_NE(refusal("2026-06-21", "12:00:nan"), "");
  EXPECT_NE(refusal("2026-06-21", "noon").find("hours:minutes:seconds"), std::string::npos);
  EXPECT_EQ(refusal("2026-06-21", "18:30:00"), "");
  EXPECT_THROW(sunDirection({.mode = SunMode::place, .date = "x"}), Error);
}

TEST(DateTime, DaysComeBack) {
  for (const char* date : {"1999-12-31", "2000-01-01", "2024-02-29", "1605-03-01", "2026-06-21"})
    for (const char* time : {"00:00:00.000", "00:00:00.001", "11:59:59.999", "12:00:00.000", "23:59:59.000"}) {
      const DateTime back = dateTimeFromDays(daysFromDateTime(date, time));
      EXPECT_EQ(back.date, date);
      EXPECT_EQ(back.time, time);
    }
  EXPECT_EQ(dateTimeFromDays(daysFromDateTime("2026-12-31", "24:00")).date, "2027-01-01");
}

}  // namespace
}  // namespace welkin
