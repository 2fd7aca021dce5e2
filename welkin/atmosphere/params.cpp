#include "welkin/base/angle.hpp"
#include "welkin/atmosphere/params.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {

namespace {

// Earth's air after Hillaire 2020 (table 1): 1/m at the ground. The sets for Rec.709 are -log(change of each channel of
// sunlight) / path, computed from Rayleigh's law through 13.558e-6 at 550 nm, the ozone cross-sections of Serdyuchenko
// et al. 2014 scaled to 1.881e-6 at 550 nm, the spectrum of ASTM G173 and the CIE 1931 observer; up to ten vertical
// atmospheres they hold to 3, 4 and 6 per cent. Ozone's band at 600 nm is what keeps the zenith blue after sunset.
constexpr double kGroundRadius = 6360e3, kThickness = 100e3;
constexpr double kRayleigh[2][3] = {{7.09e-6, 13.73e-6, 32.8e-6}, {5.802e-6, 13.558e-6, 33.100e-6}};
constexpr double kRayleighHeight = 8000.0;
constexpr double kMieScattering = 3.996e-6, kMieExtinction = 4.440e-6, kMieHeight = 1200.0;
constexpr double kOzone[2][3] = {{2.49e-6, 1.79e-6, 0.0}, {0.650e-6, 1.881e-6, 0.085e-6}};
constexpr double kOzoneMiddle = 25e3, kOzoneHalfWidth = 15e3;
constexpr double kAerialRange = 400e3;  // m, chosen; from high up it reaches 1.3 times the distance of the horizon

// Twilight falls by about a factor 2^1.1 for each degree of the sun's depression: 10^6 until astronomical night.
double twilight(double elevation) { return std::exp2(1.1 * std::clamp(elevation / kDegree, -18.0, 0.0)); }

// Sky light of a unit of illuminance, in 1/sr: about 0.03 under a high sun, a twentieth of that at sunset.
double skyShare(double elevation) {
  return 0.0016 * std::exp2(1.1 * std::min(elevation / kDegree, 0.0)) + 0.03 * std::max(std::sin(elevation), 0.0);
}

double horner(double t, const double (&c)[4]) { return ((c[0] * t + c[1]) * t + c[2]) * t + c[3]; }

float narrow(double x) { return static_cast<float>(x); }

}  // namespace

double roughSkyLuminance(const FarLight& light) {
  return luminance(light.irradiance) *
         skyShare(std::asin(std::clamp(static_cast<double>(light.direction.z), -1.0, 1.0)));
}

law::AtmosphereParams makeAtmosphereParams(const Atmosphere& a, const SkyLights& lights, double cameraAltitude,
                                           const AirSurface& surface) {
  law::AtmosphereParams p{};
  const double* const rayleigh = kRayleigh[static_cast<std::size_t>(a.coefficients)];
  const double* const ozones = kOzone[static_cast<std::size_t>(a.coefficients)];
  const glm::dvec3 ray = glm::dvec3(rayleigh[0], rayleigh[1], rayleigh[2]) * static_cast<double>(a.rayleigh);
  p.rayleigh = glm::vec4(glm::vec3(ray), narrow(1.0 / kRayleighHeight));
  // The haze is of the same matter as the aerosol: without any aerosol it takes the place of its unit.
  const double mie = a.mie > 1e-3f ? static_cast<double>(a.mie) : 1e-3;
  p.mieScattering = glm::vec4(glm::vec3(narrow(kMieScattering * mie)), narrow(1.0 / kMieHeight));
  p.mieExtinction = glm::vec4(glm::vec3(narrow(kMieExtinction * mie)), a.mieG);
  p.haze = narrow(static_cast<double>(a.haze) / (kMieExtinction * mie));
  p.hazeFalloff = 1.0f / a.hazeHeight;
  const glm::dvec3 ozone = glm::dvec3(ozones[0], ozones[1], ozones[2]) * static_cast<double>(a.ozone);
  p.ozone = glm::vec4(glm::vec3(ozone), narrow(1.0 / kOzoneHalfWidth));
  p.ozoneHeight = narrow(kOzoneMiddle);

  const glm::dvec3 sun = glm::normalize(glm::dvec3(lights.light.direction));
  const double level = std::hypot(sun.x, sun.y);
  p.sunDirection = glm::vec4(glm::vec3(sun), narrow(0.5 * kSunAngularDiameter));
  p.sunHeading = level > 1e-9 ? glm::vec4(narrow(sun.x / level), narrow(sun.y / level), narrow(level), 0.0f)
                              : glm::vec4(0.0f, 1.0f, 0.0f, 0.0f);
  p.sunIrradiance = glm::vec4(lights.light.irradiance, lights.isSun ? 0.0f : 1.0f);
  const bool two = luminance(lights.second.irradiance) > 0.0f;
  p.secondDirection = glm::vec4(glm::normalize(lights.second.direction), two ? 1.0f : 0.0f);
  p.secondIrradiance = glm::vec4(lights.second.irradiance, lights.airglow);
  p.groundAlbedo = glm::vec4(surface.ground, surface.clouds);
  p.cloudBottom = surface.cloudBottom;
  p.cloudTop = surface.cloudTop;

  const double altitude = std::max(cameraAltitude, 1.0);
  const double horizon = std::sqrt(altitude * (2 * kGroundRadius + altitude));
  const double dip = std::atan(horizon / kGroundRadius);
  p.groundRadius = narrow(kGroundRadius);
  p.thickness = narrow(kThickness);
  p.cameraAltitude = narrow(altitude);
  p.horizonElevation = narrow(-dip);
  p.aerialRange = narrow(std::max(kAerialRange, 1.3 * horizon));
  // Half floats end at 65504 and lose digits below 6e-5: the brighter of the two skies comes out as a day's.
  const auto brightness = [&](const FarLight& light) {
    const double z = std::clamp(static_cast<double>(light.direction.z), -1.0, 1.0);
    return luminance(light.irradiance) / luminance(kSunIrradiance) * twilight(std::asin(z) + dip);
  };
  p.radianceScale = narrow(1.0 / std::max({brightness(lights.light), brightness(lights.second), 1e-6}));
  if (a.model == SkyKind::gradient) p.radianceScale = 1.0f;
  p.skyKind = static_cast<int>(a.model);
  return p;
}

law::PreethamParams makePreethamParams(double turbidity, const SkyLights& lights) {
  const double t = turbidity;
  const double elevation = std::asin(std::clamp(static_cast<double>(lights.light.direction.z), -1.0, 1.0));
  const double theta = std::min(0.5 * kPi - elevation, 0.5 * kPi);

  // 000 eq. 2.42 to 2.44: slope and offset in turbidity, for Y, x and y.
  constexpr double kSlope[5][3] = {{0.1787, -0.0193, -0.0167},
                                   {-0.3554, -0.0665, -0.0950},
                                   {-0.0227, -0.0004, -0.0079},
                                   {0.1206, -0.0641, -0.0441},
                                   {-0.0670, -0.0033, -0.0109}};
  constexpr double kOffset[5][3] = {{-1.4630, -0.2592, -0.2608},
                                    {0.4275, 0.0008, 0.0092},
                                    {5.3251, 0.2125, 0.2102},
                                    {-2.5771, -0.8989, -1.6537},
                                    {0.3703, 0.0452, 0.0529}};
  double f[5][3];
  for (int i = 0; i < 5; ++i)
    for (int c = 0; c < 3; ++c) f[i][c] = kSlope[i][c] * t + kOffset[i][c];

  // 000 eq. 2.39 (with the paper's 4.0453) to 2.41, polynomials in the sun's zenith angle.
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * theta);
  const double zenith[3] = {(4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
                            t * t * horner(theta, {0.00166, -0.00375, 0.00209, 0.0}) +
                                t * horner(theta, {-0.02903, 0.06377, -0.03202, 0.00394}) +
                                horner(theta, {0.11693, -0.21196, 0.06052, 0.25886}),
                            t * t * horner(theta, {0.00275, -0.00610, 0.00317, 0.0}) +
                                t * horner(theta, {-0.04214, 0.08970, -0.04153, 0.00516}) +
                                horner(theta, {0.15346, -0.26756, 0.06670, 0.26688})};
  law::PreethamParams p{};
  glm::vec4* const rows[5] = {&p.a, &p.b, &p.c, &p.d, &p.e};
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 5; ++i) (*rows[i])[c] = narrow(f[i][c]);
    const double atZenith = (1.0 + f[0][c] * std::exp(f[1][c])) *
                            (1.0 + f[2][c] * std::exp(f[3][c] * theta) + f[4][c] * std::pow(std::cos(theta), 2));
    p.zenith[c] = narrow(std::max(zenith[c], 0.0) / atZenith);
  }
  p.zenith.w = narrow(twilight(elevation) * luminance(lights.light.irradiance) / luminance(kSunIrradiance));
  return p;
}

law::GradientParams makeGradientParams(const Atmosphere& a) {
  return {glm::vec4(a.gradientHorizon, 0.0f), glm::vec4(a.gradientZenith, 0.0f),
          glm::vec4(a.gradientGlow, a.gradientGlowExponent)};
}

}  // namespace welkin
