#include "welkin/atmosphere/tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "welkin/atmosphere/bake.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/parallel.hpp"

namespace welkin {

namespace {

void forRows(int rows, const std::function<void(int)>& body) {
  parallelFor(static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) body(static_cast<int>(y));
  });
}

// Unit direction of a heading relative to the sun (`side` +1 or -1) and an elevation.
glm::vec3 directionFrom(const law::AtmosphereParams& air, double fromSun, double elevation, double side) {
  const glm::dvec2 ahead(air.sunHeading.x, air.sunHeading.y), right(ahead.y, -ahead.x);
  const glm::dvec2 level = ahead * std::cos(fromSun) + right * (side * std::sin(fromSun));
  return glm::vec3(glm::dvec3(level * std::cos(elevation), std::sin(elevation)));
}

glm::vec3 meanOfSides(const law::AtmosphereParams& air, const SkyModel& user, double fromSun, double elevation) {
  return 0.5f * (user.radiance(directionFrom(air, fromSun, elevation, 1.0)) +
                 user.radiance(directionFrom(air, fromSun, elevation, -1.0)));
}

void paintUserRow(const law::AtmosphereParams& air, const SkyModel& user, int y, Table& out) {
  for (int x = 0; x < out.width; ++x) {
    const glm::vec2 uv((static_cast<float>(x) + 0.5f) / law::kSkyViewWidth,
                       (static_cast<float>(y) + 0.5f) / law::kSkyViewHeight);
    const glm::vec2 view = law::headingElevationFromUv(air, uv);
    const glm::vec3 c =
        air.radianceScale * meanOfSides(air, user, 2.0 * std::asin(static_cast<double>(view.x)), view.y);
    std::copy_n(&c.x, 3, out.texels.data() + (static_cast<std::size_t>(y) * out.width + x) * 4);
  }
}

}  // namespace

SkyParams makeSkyParams(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                        const AirSurface& surface) {
  return {makeAtmosphereParams(atmosphere, lights, cameraAltitude, surface),
          makePreethamParams(atmosphere.turbidity, lights), makeGradientParams(atmosphere)};
}

glm::dvec3 computeTransmittance(const law::AtmosphereParams& air, double altitude, double cosZenith) {
  const double r = air.groundRadius + altitude, b = r * cosZenith;
  const double below = (air.thickness - altitude) * (2.0 * air.groundRadius + air.thickness + altitude);
  const double end = std::sqrt(std::max(b * b + below, 0.0)) - b;
  const double lowest = std::clamp(-b, 0.0, end);
  const auto extinction = [&](double t) {
    const double q = t * (2.0 * b + t);
    const double h = std::max(altitude + q / (r + std::sqrt(std::max(r * r + q, 0.0))), 0.0);
    const double mie = std::exp(-h * air.mieScattering.w) + air.haze * std::exp(-h * air.hazeFalloff);
    const double ozone = std::max(1.0 - std::abs(h - air.ozoneHeight) * air.ozone.w, 0.0);
    return glm::dvec3(air.rayleigh) * std::exp(-h * air.rayleigh.w) + glm::dvec3(air.mieExtinction) * mie +
           glm::dvec3(air.ozone) * ozone;
  };
  // Midpoints of t = lowest + s |s|, on each side of the lowest point.
  constexpr int kSteps = 4000;
  glm::dvec3 depth(0.0);
  for (const double side : {-1.0, 1.0}) {
    const double ds = std::sqrt(side < 0 ? lowest : end - lowest) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double s = (i + 0.5) * ds;
      depth += extinction(lowest + side * s * s) * (2.0 * s * ds);
    }
  }
  return glm::exp(-depth);
}

glm::vec3 computeSkyRadiance(const SkyParams& params, const AirTables& air, const glm::vec3& direction) {
  constexpr int kSteps = 500;
  const float elevation = law::elevationFromDirection(direction);
  const float cosSun = std::clamp(glm::dot(direction, glm::vec3(params.air.sunDirection)), -1.0f, 1.0f);
  const TextureView t = air.transmittance.view(), m = air.multiScattering.view();
  const bool above = elevation >= params.air.horizonElevation;
  glm::vec3 sum =
      law::skyRadiance(t, m, params.air, params.preetham, params.gradient, elevation, cosSun, above, kSteps);
  if (params.air.secondDirection.w > 0.5f) {
    const glm::vec3 second(params.air.secondDirection);
    glm::vec3 through(1.0f);
    sum += law::scatteredRadiance(t, m, params.air, elevation, second.z, params.air.secondIrradiance,
                                  std::clamp(glm::dot(direction, second), -1.0f, 1.0f), above, kSteps, through);
  }
  return sum;
}

AirTables bakeAir(const law::AtmosphereParams& air) {
  AirTables t{Table(static_cast<int>(law::kTransmittanceWidth), static_cast<int>(law::kTransmittanceHeight), 1),
              Table(static_cast<int>(law::kMultiScatteringSize), static_cast<int>(law::kMultiScatteringSize), 1)};
  forRows(t.transmittance.height, [&](int y) { bake::transmittanceRow(air, y, t.transmittance); });
  const TextureView transmittance = t.transmittance.view();
  forRows(t.multiScattering.height, [&](int y) { bake::multiScatteringRow(air, transmittance, y, t.multiScattering); });
  return t;
}

Table bakeSkyView(const SkyParams& params, const AirTables& air, const SkyModel* user) {
  Table out(static_cast<int>(law::kSkyViewWidth), static_cast<int>(law::kSkyViewHeight), 1);
  forRows(out.height, [&](int y) {
    bake::skyViewRow(params, air, y, out);
    if (user && y >= static_cast<int>(law::kSkyViewBelow)) paintUserRow(params.air, *user, y, out);
  });
  return out;
}

void bakeAerial(const SkyParams& params, const AirTables& air, Table& inscatter, Table& transmittance) {
  inscatter = Table(static_cast<int>(law::kAerialWidth), static_cast<int>(law::kAerialHeight),
                    static_cast<int>(law::kAerialDepth));
  transmittance = inscatter;
  forRows(inscatter.height, [&](int y) { bake::aerialRow(params, air, y, inscatter, transmittance); });
}

namespace {

// The sky of the second light alone.
SkyParams secondAlone(SkyParams p) {
  const glm::vec2 level(p.air.secondDirection);
  const float length = glm::length(level);
  p.air.sunDirection = glm::vec4(glm::vec3(p.air.secondDirection), p.air.sunDirection.w);
  p.air.sunHeading = length > 1e-6f ? glm::vec4(level / length, length, 0.0f) : glm::vec4(0.0f, 1.0f, 0.0f, 0.0f);
  p.air.sunIrradiance = glm::vec4(glm::vec3(p.air.secondIrradiance), 0.0f);
  p.air.secondDirection.w = p.air.secondIrradiance.w = 0.0f;
  p.air.skyKind = 0;
  return p;
}

}  // namespace

SkyLight computeSkyLight(const SkyParams& params, const AirTables& air, const SkyModel* user) {
  // Elevations at equal steps; headings as pi t^2 at equal steps of t, dense toward the sun.
  constexpr int kElevations = 16, kHeadings = 24, kSteps = 24;
  constexpr std::size_t kCount = kElevations * kHeadings;
  std::vector<float> elevations(kCount), cosSuns(kCount), radiances(3 * kCount);
  std::vector<double> solidAngles(kCount);
  for (int i = 0; i < kElevations; ++i)
    for (int j = 0; j < kHeadings; ++j) {
      const std::size_t k = static_cast<std::size_t>(i) * kHeadings + static_cast<std::size_t>(j);
      const double elevation = 0.5 * kPi * (i + 0.5) / kElevations, t = (j + 0.5) / kHeadings;
      const glm::vec3 direction = directionFrom(params.air, kPi * t * t, elevation, 1.0);
      elevations[k] = static_cast<float>(elevation);
      cosSuns[k] = std::clamp(glm::dot(direction, glm::vec3(params.air.sunDirection)), -1.0f, 1.0f);
      solidAngles[k] = 2.0 * std::cos(elevation) * (0.5 * kPi / kElevations) * (2.0 * kPi * t / kHeadings);
      if (user) {
        const glm::vec3 c = meanOfSides(params.air, *user, kPi * t * t, elevation);
        std::copy_n(&c.x, 3, radiances.data() + 3 * k);
      }
    }
  if (!user) bake::radiances(params, air, kSteps, elevations.data(), cosSuns.data(), kCount, radiances.data());
  glm::dvec3 flux(0.0), mean(0.0);
  double whole = 0.0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const glm::dvec3 c(radiances[3 * k], radiances[3 * k + 1], radiances[3 * k + 2]);
    flux += c * (solidAngles[k] * std::sin(static_cast<double>(elevations[k])));
    mean += c * solidAngles[k];
    whole += solidAngles[k];
  }
  SkyLight light;
  light.skyIrradiance = glm::vec3(flux);
  light.meanRadiance = glm::vec3(mean / whole);
  light.sunIrradiance = glm::vec3(params.air.sunIrradiance) *
                        law::lookupTransmittanceToSun(air.transmittance.view(), params.air, params.air.cameraAltitude,
                                                      params.air.sunDirection.z);
  if (params.air.secondDirection.w > 0.5f && !user) {
    const SkyLight second = computeSkyLight(secondAlone(params), air);
    light.skyIrradiance += second.skyIrradiance;
    light.meanRadiance += second.meanRadiance;
  }
  return light;
}

SkyTablesCpu bakeSky(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                     const AirSurface& surface, const SkyModel* user) {
  SkyTablesCpu sky;
  sky.params = makeSkyParams(atmosphere, lights, cameraAltitude, surface);
  sky.air = bakeAir(sky.params.air);
  sky.skyView = bakeSkyView(sky.params, sky.air, user);
  bakeAerial(sky.params, sky.air, sky.aerialInscatter, sky.aerialTransmittance);
  sky.light = computeSkyLight(sky.params, sky.air, user);
  return sky;
}

SkyTablesCpu bakeSky(const Atmosphere& atmosphere, const Sun& sun, double cameraAltitude, const AirSurface& surface,
                     const SkyModel* user) {
  return bakeSky(atmosphere, ::welkin::sunDirection(sun), cameraAltitude, surface, user);
}

}  // namespace welkin
