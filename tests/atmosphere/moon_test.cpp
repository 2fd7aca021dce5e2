// Where the moon stands and how bright it is, against published positions, eclipses and photometry; which light a sky
// has; the count and the light of the stars.
#include "welkin/atmosphere/moon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/atmosphere/earth.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/atmosphere/tables.hpp"

namespace welkin {
namespace {

double separation(const LunarPosition& m, const SolarPosition& s) {
  return std::acos(std::min(
      glm::dot(directionFromAngles(m.azimuth, m.elevation), directionFromAngles(s.azimuth, s.elevation)), 1.0));
}

// Meeus 1998, example 47.a: 1992-04-12, 0h dynamical time. The Earth's radius and the series cut short remain.
TEST(Moon, StandsWhereMeeusComputesIt) {
  const double days = daysFromDateTime("1992-04-12", "00:00") - kDeltaT;
  // Apparent right ascension 134.688470, declination 13.768368, distance 368409.7 km from the Earth's centre: seen
  // where it stands overhead there is no parallax.
  const double latitude = 13.768368 * kDegree, longitude = 134.688470 * kDegree - earthAxis(days).sidereal;
  const LunarPosition p = lunarPosition(days, latitude, longitude);
  EXPECT_NEAR(p.elevation / kDegree, 90.0, 0.03);
  EXPECT_NEAR(p.distance, 368409.7e3 - 6378.14e3, 60e3);
}

// In the middle of the path of a total eclipse, moon and sun stand in one place: 2024-04-08 near Torreon, 18:19 UT;
// 2017- 08-21 near Hopkinsville, 18:24 UT. The discs are .53 degrees wide, and the parallax of the moon is up to one
// degree.
TEST(Moon, EclipsesTheSun) {
  const struct {
    const char *date, *time;
    double latitude, longitude;
  } eclipses[] = {{"2024-04-08", "18:19", 25.5, -103.4}, {"2017-08-21", "18:24", 36.9, -87.5}};
  for (const auto& e : eclipses) {
    const double days = daysFromDateTime(e.date, e.time);
    const LunarPosition m = lunarPosition(days, e.latitude * kDegree, e.longitude * kDegree);
    EXPECT_LT(separation(m, solarPosition(days, e.latitude * kDegree, e.longitude * kDegree)) / kDegree, 0.06)
        << e.date;
    EXPECT_GT(m.phase / kDegree, 179.0) << e.date;
    // Negative control: an hour later they have parted by half a degree.
    const LunarPosition later = lunarPosition(days + 1 / 24.0, e.latitude * kDegree, e.longitude * kDegree);
    EXPECT_GT(separation(later, solarPosition(days + 1 / 24.0, e.latitude * kDegree, e.longitude * kDegree)) / kDegree,
              0.3);
  }
}

// Total eclipses of the moon (2000-01-21 04:44 UT, 2025-03-14 06:59 UT) and a first quarter (2025-01-06 23:56 UT).
TEST(Moon, HasThePhasesOfTheAlmanac) {
  EXPECT_LT(lunarPosition(daysFromDateTime("2000-01-21", "04:44"), 0, -1.0).phase / kDegree, 1.6);
  EXPECT_LT(lunarPosition(daysFromDateTime("2025-03-14", "06:59"), 0, -1.5).phase / kDegree, 1.6);
  EXPECT_NEAR(lunarPosition(daysFromDateTime("2025-01-06", "23:56"), 0, 0).phase / kDegree, 90.0, 1.2);
}

// Krisciunas and Schaefer 1991: magnitude -12.73 full; half a moon gives about a tenth of the light, not half.
TEST(Moon, IsAsBrightAsMeasured) {
  EXPECT_NEAR(lunarIlluminance(0.0), 3.14e-4, 0.03e-4);
  EXPECT_NEAR(lunarIlluminance(90 * kDegree) / lunarIlluminance(0.0), 0.0913, 0.002);
  EXPECT_LT(lunarIlluminance(170 * kDegree), 1e-6 * 3.1e-4 * 1e3);
}

Heavens heavens(double sunElevation, double moonElevation, double phase = 1.0) {
  Sun sun;
  sun.elevation = static_cast<float>(sunElevation * kDegree);
  Moon moon;
  moon.mode = MoonMode::angles;
  moon.elevation = static_cast<float>(moonElevation * kDegree);
  moon.azimuth = 4.0f;
  moon.phase = static_cast<float>(phase);
  return heavensOf(sun, moon, {});
}

TEST(Heavens, MoonTakesTheSunsPlaceAtNight) {
  EXPECT_TRUE(heavens(20, 30).lights.isSun);
  EXPECT_TRUE(heavens(-3.9, 30).lights.isSun);
  EXPECT_FALSE(heavens(-4.1, 30).lights.isSun);
  EXPECT_TRUE(heavens(-30, -10).lights.isSun) << "there is no moon either";
  EXPECT_NEAR(luminance(heavens(-30, 30).lights.light.irradiance), 3.14e-4, 0.05e-4);
  EXPECT_EQ(luminance(heavens(20, 30).lights.second.irradiance), 0.0f) << "by day the moon does not count";
  EXPECT_GT(luminance(heavens(-8, 30).lights.second.irradiance), 100.0f) << "the sun's twilight goes on";
  EXPECT_EQ(luminance(heavens(-40, 30).lights.second.irradiance), 0.0f);
  Sun sun;
  sun.elevation = -1.0f;
  EXPECT_FALSE(heavensOf(sun, {}, {}).moonShows) << "a sun by angles has no moon of its own accord";
}

// Through dusk nothing is lost where lights are swapped or dropped: the sky is at every height of the sun the sum of
// the sky that the sun makes alone and that of the moon alone. Tables of two sides have half the texels of a side.
TEST(Heavens, TwilightDoesNotJump) {
  const glm::vec3 ways[] = {glm::normalize(glm::vec3(0.9f, -0.3f, 0.2f)), glm::normalize(glm::vec3(-0.6f, -0.7f, 0.1f)),
                            glm::vec3(0, 0, 1)};
  const auto skyOf = [&](const SkyLights& lights) {
    const SkyTablesCpu sky = bakeSky({}, lights, 100.0);
    std::array<double, 4> all{};
    for (std::size_t i = 0; i < 3; ++i) all[i] = luminance(law::lookupSky(sky.skyView.view(), sky.params.air, ways[i]));
    all[3] = luminance(sky.light.skyIrradiance);
    return all;
  };
  for (const double phase : {1.0, 0.3}) {
    SkyLights moonAlone = heavens(-40, 30, phase).lights;
    moonAlone.airglow = 0.0f;
    const std::array<double, 4> moon = skyOf(moonAlone);
    for (const double height : {-2.0, -3.0, -3.9, -4.1, -6.0, -8.0, -10.0, -14.0, -18.0, -24.0}) {
      SCOPED_TRACE(testing::Message() << "sun at " << height << ", phase " << phase);
      const Heavens h = heavens(height, 30, phase);
      SkyLights sunAlone(h.sun);
      sunAlone.airglow = h.lights.airglow;
      const std::array<double, 4> sun = skyOf(sunAlone), both = skyOf(h.lights);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(both[i] / (sun[i] + moon[i]), 1.0, 0.02) << i;
    }
  }
}

// Both lights' skies stand on their own sides of the tables: the sum is that of the two alone.
TEST(Heavens, TwoLightsAddUp) {
  SkyLights both(glm::normalize(glm::vec3(0.3f, 0.9f, 0.2f)));
  both.second = {glm::normalize(glm::vec3(0.8f, -0.2f, 0.5f)), glm::vec3(60, 50, 40)};
  SkyLights other(both.second.direction);
  other.light = both.second;
  const SkyTablesCpu sum = bakeSky({}, both, 1000.0), a = bakeSky({}, both.light.direction, 1000.0),
                     b = bakeSky({}, other, 1000.0);
  const auto sky = [](const SkyTablesCpu& s, const glm::vec3& d) {
    return law::lookupSky(s.skyView.view(), s.params.air, d);
  };
  const auto aerial = [](const SkyTablesCpu& s, const glm::vec3& d) {
    glm::vec3 in(0.0f), through(0.0f);
    law::lookupAerial(s.aerialInscatter.view(), s.aerialTransmittance.view(), s.params.air, d, 30000.0f, in, through);
    return in;
  };
  for (int i = 0; i < 40; ++i) {
    const double heading = i * 0.157 + 0.05, elevation = 0.05 + 0.07 * (i % 12);
    const glm::vec3 d(directionFromAngles(heading, elevation));
    // Near a light the tables of one side have twice the texels.
    const bool near = glm::dot(d, both.light.direction) > 0.9f || glm::dot(d, both.second.direction) > 0.9f;
    for (int c = 0; c < 3; ++c) {
      const float skies = sky(a, d)[c] + sky(b, d)[c], airs = aerial(a, d)[c] + aerial(b, d)[c];
      EXPECT_NEAR(sky(sum, d)[c] / skies, 1.0f, near ? 0.12f : 0.02f) << i;
      EXPECT_NEAR(aerial(sum, d)[c] / airs, 1.0f, near ? 0.2f : 0.04f) << i;
    }
  }
  EXPECT_NEAR(
      luminance(sum.light.skyIrradiance) / (luminance(a.light.skyIrradiance) + luminance(b.light.skyIrradiance)), 1.0,
      1e-3);
}

// A grid over the disc sums up to the moon's illuminance, for every phase, and the lit side is toward the sun.
TEST(Moon, DiscCarriesItsLight) {
  for (const double phase : {1.0, 0.7, 0.5, 0.1}) {
    const Heavens h = heavens(-20, 30, phase);
    const glm::dvec3 moon(h.night.moon), right(h.night.moonRight), up(h.night.moonUp);
    const double radius = h.night.moon.w, step = radius / 60.0;
    glm::dvec3 sum(0.0), weighted(0.0);
    for (int j = -66; j <= 66; ++j)
      for (int i = -66; i <= 66; ++i) {
        const glm::dvec3 d = glm::normalize(moon + (right * (i * step) + up * (j * step)));
        const glm::dvec3 c(law::moonDisc(h.night, glm::vec3(d), static_cast<float>(step)));
        sum += c * step * step;
        weighted += (d - moon) * c.y;
      }
    const glm::dvec3 expected(h.lights.light.irradiance);
    // A narrow crescent's edge is wider than the grid.
    EXPECT_NEAR(sum.y / expected.y, 1.0, phase < 0.2 ? 0.05 : 0.02) << phase;
    if (phase < 0.9) {
      EXPECT_GT(glm::dot(glm::normalize(weighted),
                         glm::normalize(glm::dvec3(h.sun) - moon * glm::dot(moon, glm::dvec3(h.sun)))),
                0.9)
          << phase;
    }
  }
}

// Summed over the sphere: the light of the stars of the counts, and the light does not hang on the pixel. Bright stars
// are few, so that the sum is known to some tens of per cent only.
TEST(Stars, KeepTheirLightAtEverySize) {
  const auto total = [](double pixel, int rows) {
    double sum = 0.0;
    for (int j = 0; j < rows; ++j) {
      const double z = (2.0 * j + 1.0) / rows - 1.0, s = std::sqrt(1.0 - z * z);
      for (int i = 0; i < 2 * rows; ++i) {
        const double a = kPi * (i + 0.5) / rows;
        sum += law::starField(glm::vec3(s * std::cos(a), s * std::sin(a), z), static_cast<float>(pixel)).y;
      }
    }
    return sum * 4.0 * kPi / (2.0 * rows * rows);  // klx
  };
  const double coarse = total(0.004, 1600), fine = total(0.002, 1600);
  EXPECT_NEAR(fine / coarse, 1.0, 0.05);
  // The law of counts gives as much light as 94 stars of magnitude 0; the few brightest are a matter of luck.
  EXPECT_NEAR(coarse, 94 * 2.54e-9, 0.35 * 94 * 2.54e-9);
}

// Counts by magnitude against those of the sky (Cox 2000, table 19.17: 4,850 brighter than 6, 1,600 than 5, 530 than
// 4).
TEST(Stars, AreAsManyAsReal) {
  int brighter[3] = {};
  constexpr int kReach = 49;
  for (int z = -kReach; z < kReach; ++z)
    for (int y = -kReach; y < kReach; ++y)
      for (int x = -kReach; x < kReach; ++x) {
        const double far = glm::length(glm::dvec3(x + 0.5, y + 0.5, z + 0.5));
        if (std::abs(far - 48.0) > 1.3) continue;
        // The star's own direction shows its peak, .955 E / reach^2.
        unsigned h = law::nightCell(x, y, z);
        glm::vec3 star(x, y, z);
        for (int k = 0; k < 3; ++k, h = law::nightHash(h + 1u)) star[k] += law::nightUnit(h);
        const glm::vec3 c = law::starInCell(glm::normalize(star) * 48.0f, glm::vec3(x, y, z), 0.002f);
        const double e = luminance(c) * 0.002 * 0.002 / 0.954929659 / 2.54e-9;
        if (!(e > 0.0)) continue;
        const double magnitude = -2.5 * std::log10(e);
        for (int k = 0; k < 3; ++k) brighter[k] += magnitude < 6 - k;
      }
  EXPECT_NEAR(brighter[0], 4850, 0.2 * 4850);
  EXPECT_NEAR(brighter[1], 1600, 0.25 * 1600);
  EXPECT_NEAR(brighter[2], 530, 0.3 * 530);
}

// The pole of the sky stands in the north as high as the latitude, and the stars turn about it once in a sidereal day.
TEST(Stars, TurnAboutThePole) {
  Sun sun{.mode = SunMode::place, .date = "2026-03-20", .time = "00:00", .latitude = 0.8f, .longitude = 0.3f};
  const law::NightParams a = heavensOf(sun, {}, {}).night;
  sun.time = "23:56:04.09";
  const law::NightParams b = heavensOf(sun, {}, {}).night;
  sun.time = "06:00";
  const law::NightParams c = heavensOf(sun, {}, {}).night;
  EXPECT_NEAR(a.skyZ.z, std::sin(0.8), 1e-5);
  EXPECT_NEAR(a.skyZ.y, std::cos(0.8), 1e-5);
  EXPECT_NEAR(glm::dot(a.skyX, b.skyX), 1.0, 1e-6);
  EXPECT_LT(glm::dot(a.skyX, c.skyX), 0.1);
  EXPECT_EQ(a.skyZ, c.skyZ);
}

// A moonless, clear night: 1.7e-4 cd/m^2 at the zenith, about 1e-3 lx on the ground.
TEST(Night, IsNotBlack) {
  Sun sun;
  sun.elevation = -0.7f;
  const SkyTablesCpu sky = bakeSky({}, heavensOf(sun, {}, {}).lights, 0.0);
  EXPECT_NEAR(luminance(law::lookupSky(sky.skyView.view(), sky.params.air, {0, 0, 1})), 1.6e-7, 0.2e-7);
  EXPECT_NEAR(luminance(sky.light.skyIrradiance), 7e-7, 3e-7);
}

}  // namespace
}  // namespace welkin
