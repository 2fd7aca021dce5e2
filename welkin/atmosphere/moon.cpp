#include "welkin/atmosphere/moon.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/atmosphere/earth.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/atmosphere/sun.hpp"

namespace welkin {

namespace {

constexpr double kEarthRadius = 6378.14e3, kAstronomicalUnit = 1.496e11, kMeanDistance = 385000.56e3;  // m
constexpr double kMoonRadius = 1737.4e3;

// Multiples of the four arguments, and amplitudes: longitude in 1e-6 deg, distance in m (Meeus 1998 table 47.A); terms
// under 0.008 deg are left out.
struct MoonTerm {
  int elongation, sunAnomaly, anomaly, node;
  double longitude, distance;
};
constexpr std::array<MoonTerm, 24> kTerms{
    {{0, 0, 1, 0, 6288774, -20905355}, {2, 0, -1, 0, 1274027, -3699111}, {2, 0, 0, 0, 658314, -2955968},
     {0, 0, 2, 0, 213618, -569925},    {0, 1, 0, 0, -185116, 48888},     {0, 0, 0, 2, -114332, -3149},
     {2, 0, -2, 0, 58793, 246158},     {2, -1, -1, 0, 57066, -152138},   {2, 0, 1, 0, 53322, -170733},
     {2, -1, 0, 0, 45758, -204586},    {0, 1, -1, 0, -40923, -129620},   {1, 0, 0, 0, -34720, 108743},
     {0, 1, 1, 0, -30383, 104755},     {2, 0, 0, -2, 15327, 10321},      {0, 0, 1, 2, -12528, 0},
     {0, 0, 1, -2, 10980, 79661},      {4, 0, -1, 0, 10675, -34782},     {0, 0, 3, 0, 10034, -23210},
     {4, 0, -2, 0, 8548, -21636},      {2, 1, -1, 0, -7888, 24208},      {2, 1, 0, 0, -6766, 30824},
     {1, 0, -1, 0, -5163, -8379},      {1, 1, 0, 0, 4987, -16675},       {2, -1, 1, 0, 4036, -12831}}};
// Latitude in 1e-6 deg (table 47.B).
constexpr std::array<MoonTerm, 10> kLatitudes{{{0, 0, 0, 1, 5128122, 0},
                                               {0, 0, 1, 1, 280602, 0},
                                               {0, 0, 1, -1, 277693, 0},
                                               {2, 0, 0, -1, 173237, 0},
                                               {2, 0, -1, 1, 55413, 0},
                                               {2, 0, -1, -1, 46271, 0},
                                               {2, 0, 0, 1, 32573, 0},
                                               {0, 0, 2, 1, 17198, 0},
                                               {2, 0, 1, -1, 9266, 0},
                                               {0, 0, 2, -1, 8822, 0}}};

// From the Earth's centre, on equatorial axes of date, m.
glm::dvec3 geocentricMoon(double daysSince2000) {
  const double t = (daysSince2000 + kDeltaT) / 36525.0;
  const double mean = 218.3164477 + 481267.88123421 * t;  // Meeus eq. 47.1 to 47.6
  const double elongation = (297.8501921 + 445267.1114034 * t) * kDegree;
  const double sunAnomaly = (357.5291092 + 35999.0502909 * t) * kDegree;
  const double anomaly = (134.9633964 + 477198.8675055 * t) * kDegree;
  const double node = (93.2720950 + 483202.0175233 * t) * kDegree;
  const double eccentricity = 1.0 - 0.002516 * t;
  double longitude = 0.0, latitude = 0.0, distance = kMeanDistance;
  const auto argument = [&](const MoonTerm& k) {
    return k.elongation * elongation + k.sunAnomaly * sunAnomaly + k.anomaly * anomaly + k.node * node;
  };
  for (const MoonTerm& k : kTerms) {
    const double factor = k.sunAnomaly == 0 ? 1.0 : eccentricity;
    longitude += factor * k.longitude * std::sin(argument(k));
    distance += factor * k.distance * std::cos(argument(k));
  }
  for (const MoonTerm& k : kLatitudes) latitude += k.longitude * std::sin(argument(k));
  const EarthAxis axis = earthAxis(daysSince2000);
  const double lambda = (mean + longitude * 1e-6) * kDegree + axis.nutation, beta = latitude * 1e-6 * kDegree;
  const glm::dvec3 ecliptic(std::cos(beta) * std::cos(lambda), std::cos(beta) * std::sin(lambda), std::sin(beta));
  const double c = std::cos(axis.obliquity), s = std::sin(axis.obliquity);
  return distance * glm::dvec3(ecliptic.x, ecliptic.y * c - ecliptic.z * s, ecliptic.y * s + ecliptic.z * c);
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));  // of unit vectors
}

// A unit vector at right angles to `axis` in the half plane of `toward`; any, where that has none.
glm::dvec3 across(const glm::dvec3& axis, const glm::dvec3& toward) {
  for (const glm::dvec3& v : {toward, glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)}) {
    const glm::dvec3 a = v - axis * glm::dot(v, axis);
    if (glm::length(a) > 1e-6) return glm::normalize(a);
  }
  return {1, 0, 0};
}

// Linear Rec.709 of moonlight at luminance 1 over that of sunlight: lunar dust is redder, by .27 magnitudes in B - V.
constexpr glm::vec3 kMoonTint{1.12f, 0.98f, 0.82f};
glm::vec3 moonColour() {
  const glm::vec3 colour = kMoonTint * kSunIrradiance;
  return colour / luminance(colour);
}
constexpr double kAirglow = 1.7e-7;  // kcd/m^2 at the zenith of a dark site: 22 magnitudes a square second
// A full Earth lights the moon with this share of the sun's light: radius over distance, squared, times an albedo for
// the way back of .43.
constexpr double kEarthlight = 1.2e-4;
constexpr double kSunGone = -4.0 * kDegree, kMoonGone = -4.0 * kDegree;  // from 12 km, half a disc on top
// A second light adds to the air while its sky is more than this share of the other's: less cannot be seen.
constexpr double kCounts = 1.0 / 2000.0;
// Stars are drawn while the sun stands lower than this, rad; the brightest is then a hundredth of the sky.
constexpr double kStarsFrom = 2.0 * kDegree;

// Directions of the moon, of the sun seen from it, and what it sends.
struct MoonState {
  glm::dvec3 direction{0, 0, -1}, toSun{0, 0, 1};
  double illuminance = 0.0, radius = 0.0, phase = kPi;
};

double localSidereal(const Sun& sun, const Night& night, double days) {
  if (sun.mode == SunMode::place) return earthAxis(days).sidereal + static_cast<double>(sun.longitude);
  return static_cast<double>(night.siderealTime) / 86400.0 * 2.0 * kPi;
}

MoonState moonState(const Sun& sun, const Moon& moon, const glm::dvec3& toSun, double days) {
  MoonState m;
  if (moon.mode == MoonMode::off || (moon.mode == MoonMode::automatic && sun.mode == SunMode::angles)) return m;
  m.radius = 0.5 * kSunAngularDiameter * 0.97;  // at its mean distance
  if (moon.mode == MoonMode::automatic) {
    const LunarPosition p = lunarPosition(days, sun.latitude, sun.longitude);
    m.direction = directionFromAngles(p.azimuth, p.elevation);
    m.toSun = glm::normalize(toSun * kAstronomicalUnit - m.direction * p.distance);
    m.radius = kMoonRadius / p.distance;
    m.phase = p.phase;
    m.illuminance = lunarIlluminance(p.phase) * std::pow(kMeanDistance / p.distance, 2.0);
  } else {
    m.direction = directionFromAngles(moon.azimuth, moon.elevation);
    m.phase = std::acos(std::clamp(2.0 * static_cast<double>(moon.phase) - 1.0, -1.0, 1.0));
    m.toSun = -m.direction * std::cos(m.phase) + across(m.direction, toSun) * std::sin(m.phase);
    m.illuminance = lunarIlluminance(m.phase);
  }
  m.illuminance *= static_cast<double>(moon.brightness);
  return m;
}

// Mean over the disc of what a radiance of 1 comes back as.
double meanOfDisc(law::NightParams p) {
  constexpr int kSide = 96;
  p.moonLight = glm::vec4(1.0f);
  p.moonRight.w = 0.0f;
  double sum = 0.0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = (2.0 * i + 1.0) / kSide - 1.0, y = (2.0 * j + 1.0) / kSide - 1.0;
      if (x * x + y * y >= 1.0) continue;
      const glm::dvec3 offset =
          (x * glm::dvec3(p.moonRight) + y * glm::dvec3(p.moonUp)) * static_cast<double>(p.moon.w);
      sum += law::moonDisc(p, glm::vec3(glm::normalize(glm::dvec3(p.moon) + offset)), 1e-6f).x;
    }
  return sum * 4.0 / (kPi * kSide * kSide);
}

law::NightParams nightParams(const MoonState& moon, const Night& night, const glm::dmat3& localFromSky) {
  law::NightParams p{};
  const glm::dvec3 north = localFromSky[2];  // the moon's own differs by up to 25 degrees
  const glm::dvec3 above = across(moon.direction, north), right = glm::cross(moon.direction, above);
  p.moon = glm::vec4(glm::vec3(moon.direction), static_cast<float>(moon.radius));
  // Seen from the moon the Earth's phase is the other way round.
  p.moonRight = glm::vec4(glm::vec3(right), static_cast<float>(kEarthlight * 0.5 * (1.0 - std::cos(moon.phase))));
  p.moonUp = glm::vec4(glm::vec3(above), 0.0f);
  p.moonToSun = glm::vec4(glm::vec3(moon.toSun), 0.0f);
  if (moon.radius > 0.0 && moon.illuminance > 0.0) {
    const double solidAngle = kPi * moon.radius * moon.radius;
    // The narrowest crescents slip through the grid of the mean.
    const double radiance = moon.illuminance / (solidAngle * std::max(meanOfDisc(p), 1e-5));
    p.moonLight = glm::vec4(moonColour() * static_cast<float>(radiance), 0.0f);
  }
  p.skyX = glm::vec4(glm::vec3(localFromSky[0]), 0.0f);
  p.skyY = glm::vec4(glm::vec3(localFromSky[1]), 0.0f);
  p.skyZ = glm::vec4(glm::vec3(localFromSky[2]), 0.0f);
  // Right ascension and declination of the galaxy's north pole and centre (J2000).
  const auto axis = [](double ascension, double declination) {
    const double a = ascension * kDegree, d = declination * kDegree;
    return glm::vec4(glm::vec3(glm::dvec3(std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d))), 0.0f);
  };
  p.galaxyPole = axis(192.859, 27.128);
  p.galaxyCentre = axis(266.405, -28.936);
  p.stars = night.stars;
  p.milkyWay = night.milkyWay;
  return p;
}

}  // namespace

LunarPosition lunarPosition(double daysSince2000, double latitude, double longitude) {
  const EarthAxis axis = earthAxis(daysSince2000);
  const glm::dmat3 turn = localFromEquatorial(axis.sidereal + longitude, latitude);
  const glm::dvec3 moon = turn * geocentricMoon(daysSince2000) - glm::dvec3(0.0, 0.0, kEarthRadius);
  const SolarPosition s = solarPosition(daysSince2000, latitude, longitude);
  const glm::dvec3 toSun = directionFromAngles(s.azimuth, s.elevation);
  LunarPosition p;
  p.distance = glm::length(moon);
  const glm::dvec3 way = moon / p.distance;
  p.elevation = std::asin(std::clamp(way.z, -1.0, 1.0));
  p.azimuth = std::atan2(way.x, way.y);
  if (p.azimuth < 0.0) p.azimuth += 2.0 * kPi;
  p.phase = angleBetween(-way, glm::normalize(toSun * kAstronomicalUnit - moon));
  return p;
}

double lunarIlluminance(double phase) {
  const double degrees = std::abs(phase) / kDegree;
  return 2.54e-9 * std::pow(10.0, -0.4 * (-12.73 + 0.026 * degrees + 4e-9 * std::pow(degrees, 4.0)));
}

Heavens heavensOf(const Sun& sun, const Moon& moon, const Night& night) {
  Heavens h;
  h.sun = sunDirection(sun);
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(h.sun));
  const double days = sun.mode == SunMode::place
                          ? daysFromDateTime(sun.date, sun.time) - static_cast<double>(sun.utcOffset) / 86400.0
                          : 0.0;
  const MoonState m = moonState(sun, moon, toSun, days);
  h.night = nightParams(m, night, localFromEquatorial(localSidereal(sun, night, days), sun.latitude));

  h.lights = SkyLights(h.sun);
  h.lights.airglow = static_cast<float>(kAirglow) * night.airglow;
  const double sunHeight = std::asin(std::clamp(toSun.z, -1.0, 1.0));
  h.starsShow = sunHeight < kStarsFrom && (night.stars > 0.0f || night.milkyWay > 0.0f);
  const double moonHeight = std::asin(std::clamp(m.direction.z, -1.0, 1.0));
  h.moonShows = m.illuminance > 0.0 && moonHeight > kMoonGone;
  if (!h.moonShows) return h;
  const FarLight light{glm::vec3(m.direction), moonColour() * static_cast<float>(m.illuminance)};
  FarLight other = light;
  if (sunHeight < kSunGone) {
    other = h.lights.light;
    h.lights.light = light;
    h.lights.isSun = false;
  }
  if (roughSkyLuminance(other) > kCounts * roughSkyLuminance(h.lights.light)) h.lights.second = other;
  return h;
}

}  // namespace welkin
