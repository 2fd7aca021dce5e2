// The air's tables against exact quadrature and published radiances (references: Hillaire 2020 for the air).
#include "welkin/atmosphere/tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "welkin/base/angle.hpp"
#include "welkin/atmosphere/sun.hpp"

namespace welkin {
namespace {

const glm::vec3 kBlack(0.0f);

// The published air, which the references were computed for.
Atmosphere published() {
  Atmosphere a;
  a.coefficients = AirCoefficients::hillaire;
  return a;
}

law::AtmosphereParams earth(double sunElevation = 45, double altitude = 200) {
  return makeAtmosphereParams(published(), glm::vec3(directionFromAngles(1.0, sunElevation * kDegree)), altitude,
                              kBlack);
}

const AirTables& earthTables() {
  static const AirTables kTables = bakeAir(earth());
  return kTables;
}

struct Row {
  double angle, r, g, b;
};
constexpr Row kTransmittance[] = {{0, .940359, .867615, .762310},
                                  {60, .884784, .753858, .582282},
                                  {80, .712941, .459379, .221627},
                                  {85, .543644, .249467, .063628},
                                  {90, .106429, .009580, .000052}};

TEST(Transmittance, ExactValuesFromTheGround) {
  for (const Row& row : kTransmittance) {
    const glm::dvec3 t = computeTransmittance(earth(), 0.0, std::cos(row.angle * kDegree));
    EXPECT_NEAR(t.x, row.r, 2e-6) << row.angle;
    EXPECT_NEAR(t.y, row.g, 2e-6) << row.angle;
    EXPECT_NEAR(t.z, row.b, 2e-6) << row.angle;
  }
}

TEST(Transmittance, VerticalOpticalDepth) {
  const glm::dvec3 depth = -glm::log(computeTransmittance(earth(), 0.0, 1.0));
  EXPECT_NEAR(depth.x, .061494, 1e-6);
  EXPECT_NEAR(depth.y, .142007, 1e-6);
  EXPECT_NEAR(depth.z, .271402, 1e-6);
}

// Texels are marched with 80 steps; between them the table is filtered linearly.
TEST(Transmittance, TableAgreesWithQuadrature) {
  const law::AtmosphereParams air = earth();
  double worstTexel = 0, worstLookup = 0;
  for (int y = 0; y < 64; y += 3)
    for (int x = 0; x < 256; x += 5) {
      const glm::vec2 uv((x + 0.5f) / 256.0f, (y + 0.5f) / 64.0f);
      const glm::vec2 ray = law::altitudeCosineFromUv(air, uv);
      const glm::dvec3 exact = computeTransmittance(air, ray.x, ray.y);
      const float* texel = earthTables().transmittance.texels.data() + (y * 256 + x) * 4;
      for (int c = 0; c < 3; ++c) worstTexel = std::max(worstTexel, std::abs(exact[c] - texel[c]));
    }
  for (const double altitude : {0.0, 50.0, 700.0, 3000.0, 12000.0, 60000.0, 99000.0}) {
    const double horizon = law::horizonCosine(air, static_cast<float>(altitude));
    for (int i = 0; i <= 200; ++i) {
      const double s = i / 200.0, mu = horizon + (1 - horizon) * s * s;
      const glm::dvec3 exact = computeTransmittance(air, altitude, mu);
      const glm::vec3 t = law::lookupTransmittance(earthTables().transmittance.view(), air,
                                                   static_cast<float>(altitude), static_cast<float>(mu));
      for (int c = 0; c < 3; ++c) worstLookup = std::max(worstLookup, std::abs(exact[c] - t[c]));
    }
  }
  std::printf("transmittance: texel %.2e, lookup %.2e\n", worstTexel, worstLookup);
  EXPECT_LT(worstTexel, 1e-3);
  EXPECT_LT(worstLookup, 5e-3) << "at the horizon, where a texel spans a few per cent";
}

TEST(Transmittance, FromOutsideTheAir) {
  const law::AtmosphereParams air = earth();
  const TextureView t = earthTables().transmittance.view();
  EXPECT_EQ(law::lookupTransmittance(t, air, 400e3f, 0.1f).x, 1.0f);
  EXPECT_EQ(law::lookupTransmittance(t, air, 400e3f, -0.1f).x, 1.0f) << "a ray that misses the air";
  // A ray that grazes 20 km: twice the way from its lowest point.
  const double r = 6360e3 + 400e3, low = 6360e3 + 20e3;
  const double mu = -std::sqrt(1 - low * low / (r * r));
  const glm::dvec3 half = computeTransmittance(air, 20e3, 0.0);
  const glm::vec3 whole = law::lookupTransmittance(t, air, 400e3f, static_cast<float>(mu));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], half[c] * half[c], 5e-3);
}

TEST(Maps, AreInverse) {
  const law::AtmosphereParams air = earth(30, 2000);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 96; x += 5) {
      const glm::vec2 uv((x + 0.5f) / 96.0f, (y + 0.5f) / 128.0f);
      const glm::vec2 view = law::headingElevationFromUv(air, uv);
      const glm::vec2 heading(air.sunHeading), right(heading.y, -heading.x);
      const float az = 2 * std::asin(view.x);
      const glm::vec2 level = heading * std::cos(az) + right * std::sin(az);
      const glm::vec3 d(level * std::cos(view.y), std::sin(view.y));
      const glm::vec2 again = law::skyViewUv(air, d);
      if (y != 39 && y != 40) {  // the two rows of the horizon are a hair from each other
        EXPECT_NEAR(again.y, uv.y, 2e-4) << x << " " << y;
      }
      if (y != 0 && y != 127) {
        EXPECT_NEAR(again.x, uv.x, 2e-4) << x << " " << y;
      }
      const glm::vec2 uvAerial((x / 3 + 0.5f) / 32.0f, (y / 2 + 0.5f) / 64.0f);
      const glm::vec2 aerial = law::headingElevationFromAerialUv(air, uvAerial);
      const glm::vec3 da(heading * std::cos(aerial.y), std::sin(aerial.y));
      EXPECT_NEAR(law::aerialUv(air, da).y, uvAerial.y, 3e-4);
    }
  for (int i = 1; i < 32; ++i) EXPECT_NEAR(law::aerialDepth(air, law::aerialDistance(air, i)), (i + 0.5) / 32, 1e-5);
  for (const float u : {0.1f, 0.4f, 0.6f, 0.9f}) {
    const glm::vec2 ray = law::altitudeCosineFromUv(air, {u, 1 - u});
    EXPECT_NEAR(law::transmittanceUv(air, ray.x, ray.y).x, u, 1e-4);
    EXPECT_NEAR(law::transmittanceUv(air, ray.x, ray.y).y, 1 - u, 1e-5);
    const glm::vec2 place = law::altitudeSunFromUv(air, {u, 1 - u});
    EXPECT_NEAR(law::multiScatteringUv(air, place.x, place.y).x, u, 1e-5);
    EXPECT_NEAR(law::multiScatteringUv(air, place.x, place.y).y, 1 - u, 1e-5);
  }
}

// Radiance per unit solar irradiance, all orders, black ground, observer at 200 m (Monte Carlo). `across` is 90 degrees
// from the sun's heading.
struct SkyRow {
  double sun, view, heading, r, g, b, gate;
};
constexpr SkyRow kSky[] = {{60, 0, 0, .003471, .007653, .018794, .04},
                           {60, 60, 0, .039695, .047139, .067893, .04},
                           {60, 60, 90, .005855, .012916, .030748, .04},
                           {60, 60, 180, .006739, .014815, .034388, .04},
                           {85, 85, 90, .017915, .021637, .020577, .15}};

TEST(SkyView, AgreesWithMonteCarlo) {
  for (const SkyRow& row : kSky) {
    const glm::vec3 sun(directionFromAngles(0.7, (90 - row.sun) * kDegree));
    const SkyParams params = makeSkyParams(published(), sun, 200.0, kBlack);
    const AirTables& air = earthTables();
    const Table skyView = bakeSkyView(params, air);
    const glm::vec3 d(directionFromAngles(0.7 + row.heading * kDegree, (90 - row.view) * kDegree));
    const glm::vec3 table = law::lookupSky(skyView.view(), params.air, d) / kSunIrradiance;
    const glm::vec3 exact = computeSkyRadiance(params, air, d) / kSunIrradiance;
    const double published[] = {row.r, row.g, row.b};
    std::printf("sun %2.0f view %2.0f heading %3.0f: table/published", row.sun, row.view, row.heading);
    for (int c = 0; c < 3; ++c) {
      std::printf(" %.4f (%.4f)", table[c] / published[c], exact[c] / published[c]);
      EXPECT_NEAR(table[c], published[c], row.gate * published[c]) << row.sun << " " << row.view << " " << c;
      EXPECT_NEAR(table[c], exact[c], 0.01 * exact[c]);
    }
    std::printf("\n");
  }
}

TEST(SkyView, HasNoSeamAtTheSunsHeadingNorOppositeIt) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(0.7, 0.2)), 500.0);
  for (const double heading : {0.7, 0.7 + kPi})
    for (const double elevation : {0.01, 0.2, 1.0, 1.5}) {
      const auto at = [&](double offset) {
        return luminance(law::lookupSky(sky.skyView.view(), sky.params.air,
                                        glm::vec3(directionFromAngles(heading + offset, elevation))));
      };
      EXPECT_NEAR(at(0.002), at(-0.002), 1e-4 * at(0.0));
      EXPECT_NEAR(at(0.0005), at(0.0), 0.005 * at(0.0));
    }
}

TEST(Tables, AreFiniteWithTheSunAndTheCameraAnywhere) {
  for (const double elevation : {90.0, 30.0, 0.0, -0.3, -6.0, -18.0, -40.0, -90.0})
    for (const double altitude : {0.0, 200.0, 20e3, 100e3, 400e3}) {
      const SkyParams params =
          makeSkyParams(published(), glm::vec3(directionFromAngles(2.0, elevation * kDegree)), altitude);
      const Table skyView = bakeSkyView(params, earthTables());
      Table inscatter, transmittance;
      bakeAerial(params, earthTables(), inscatter, transmittance);
      for (const Table* t : std::initializer_list<const Table*>{&skyView, &inscatter, &transmittance})
        for (const float v : t->texels) {
          ASSERT_TRUE(std::isfinite(v)) << elevation << " " << altitude;
          ASSERT_GE(v, 0.0f);
          ASSERT_LT(v, 65504.0f) << "beyond half floats: " << elevation << " " << altitude;
        }
      const SkyLight light = computeSkyLight(params, earthTables());
      ASSERT_TRUE(std::isfinite(light.skyIrradiance.x) && light.skyIrradiance.x >= 0);
    }
}

// The air in front of a point far above the horizon is the whole sky, and its transmittance that to space.
TEST(Aerial, TendsToTheSky) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(0.7, 0.5)), 200.0);
  for (const double elevation : {0.3, 0.8, 1.4}) {
    const glm::vec3 d(directionFromAngles(2.0, elevation));
    glm::vec3 inscatter, through;
    law::lookupAerial(sky.aerialInscatter.view(), sky.aerialTransmittance.view(), sky.params.air, d, 400e3f, inscatter,
                      through);
    const glm::vec3 whole = law::lookupSky(sky.skyView.view(), sky.params.air, d);
    const glm::dvec3 t = computeTransmittance(sky.params.air, 200.0, d.z);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(inscatter[c], whole[c], 0.02 * whole[c]) << elevation;
      EXPECT_NEAR(through[c], t[c], 5e-3) << elevation;
    }
  }
}

// Linear filtering in direction and distance costs a per cent or two.
TEST(Aerial, AgreesWithAFineMarch) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(0.7, 0.5)), 500.0);
  const law::AtmosphereParams& air = sky.params.air;
  const TextureView t = sky.air.transmittance.view(), m = sky.air.multiScattering.view();
  for (const double elevation : {-0.011, 0.0, 0.05, 0.4, 1.3})
    for (const double heading : {0.75, 1.5, 3.8})
      for (const float distance : {150.0f, 2000.0f, 15000.0f, 70000.0f}) {
        const glm::vec3 d(directionFromAngles(heading, elevation));
        glm::vec3 exact(0.0f), exactThrough(1.0f), got, through;
        law::addInscatter(t, m, air, air.cameraAltitude, d.z, air.sunDirection.z,
                          glm::dot(d, glm::vec3(air.sunDirection)), 0.0f, distance, 300, exact, exactThrough);
        exact *= kSunIrradiance;
        law::lookupAerial(sky.aerialInscatter.view(), sky.aerialTransmittance.view(), air, d, distance, got, through);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(got[c], exact[c], 0.02 * exact[c]) << elevation << " " << heading << " " << distance;
          EXPECT_NEAR(through[c], exactThrough[c], 4e-3) << elevation << " " << heading << " " << distance;
        }
      }
}

// Along the sea-level horizon the air is uniform for 20 km: transmittance is exp(-extinction distance).
TEST(Aerial, FollowsBeerNearTheGround) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(0.7, 0.5)), 2.0);
  const glm::vec3 extinction = law::atmosphereExtinction(sky.params.air, 2.0f);
  for (const float distance : {100.0f, 3000.0f, 20000.0f}) {
    glm::vec3 inscatter, through;
    law::lookupAerial(sky.aerialInscatter.view(), sky.aerialTransmittance.view(), sky.params.air, {0, 1, 0}, distance,
                      inscatter, through);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(through[c], std::exp(-extinction[c] * distance), 4e-3) << distance;
  }
  glm::vec3 inscatter, through;
  law::lookupAerial(sky.aerialInscatter.view(), sky.aerialTransmittance.view(), sky.params.air, {0, 1, 0}, 0.0f,
                    inscatter, through);
  EXPECT_EQ(inscatter, glm::vec3(0.0f));
  EXPECT_NEAR(through.z, 1.0f, 1e-4f);
}

TEST(Aerial, TransmittanceToTheGroundAgreesWithQuadrature) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(0.7, 0.5)), 10000.0);
  for (const double elevation : {-1.5, -0.6, -0.1}) {
    const glm::vec3 d(directionFromAngles(2.0, elevation));
    const float t = law::distanceToGround(sky.params.air, 10000.0f, d.z);
    const double up = -((6370e3) * d.z + t) / 6360e3;
    const glm::dvec3 exact = computeTransmittance(sky.params.air, 0.0, up) /
                             computeTransmittance(sky.params.air, 10000.0, -static_cast<double>(d.z));
    const glm::vec3 got = law::lookupTransmittanceToGround(sky.air.transmittance.view(), sky.params.air, d);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], exact[c], 5e-3) << elevation;
  }
}

// What the sky and the sun send to the ground never exceeds what arrives outside, and is most of it at noon.
TEST(Light, ConservesEnergy) {
  for (const double elevation : {5.0, 30.0, 60.0, 90.0}) {
    const SkyParams params =
        makeSkyParams(published(), glm::vec3(directionFromAngles(0.0, elevation * kDegree)), 0.0, kBlack);
    const SkyLight light = computeSkyLight(params, earthTables());
    const double down = std::sin(elevation * kDegree);
    for (int c = 0; c < 3; ++c) {
      const double arrived = light.sunIrradiance[c] * down + light.skyIrradiance[c];
      EXPECT_LT(arrived, kSunIrradiance[c] * down) << elevation;
      EXPECT_GT(arrived, (elevation > 20 ? 0.7 : 0.2) * kSunIrradiance[c] * down) << elevation;
    }
    if (elevation == 60.0) {
      EXPECT_NEAR(luminance(light.skyIrradiance), 6.5, 1.5) << "some 45 per cent of the 16 klx that the air takes";
    }
  }
  EXPECT_NEAR(luminance(kSunIrradiance), 128.0, 0.01);
}

TEST(Light, AgreesWithTheSkyViewTable) {
  const SkyTablesCpu sky = bakeSky(published(), glm::vec3(directionFromAngles(1.0, 0.6)), 200.0);
  glm::dvec3 flux(0.0), mean(0.0);
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < 2 * kSteps; ++j) {
      const double e = 0.5 * kPi * (i + 0.5) / kSteps, a = kPi * (j + 0.5) / kSteps;
      const glm::dvec3 c(law::lookupSky(sky.skyView.view(), sky.params.air, glm::vec3(directionFromAngles(a, e))));
      const double solid = std::cos(e) * (0.5 * kPi / kSteps) * (kPi / kSteps);
      flux += c * (solid * std::sin(e));
      mean += c * (solid / (2 * kPi));
    }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sky.light.skyIrradiance[c], flux[c], 0.02 * flux[c]);
    EXPECT_NEAR(sky.light.meanRadiance[c], mean[c], 0.02 * mean[c]);
  }
}

TEST(SunDisc, SendsTheSunsIrradiance) {
  const law::AtmosphereParams air = earth(60);
  const glm::vec3 sun(air.sunDirection);
  const glm::vec3 side = glm::normalize(glm::cross(sun, glm::vec3(0, 0, 1))), up = glm::cross(side, sun);
  constexpr int kSteps = 400;
  constexpr double kHalf = 0.006;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const float x = static_cast<float>(kHalf * (2 * (i + 0.5) / kSteps - 1));
      const float y = static_cast<float>(kHalf * (2 * (j + 0.5) / kSteps - 1));
      sum += glm::dvec3(law::sunDisc(air, glm::normalize(sun + x * side + y * up), 2e-5f));
    }
  sum *= std::pow(2 * kHalf / kSteps, 2);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], kSunIrradiance[c], 0.01 * kSunIrradiance[c]);
}

// After sunset the zenith is blue, not purple: ozone takes red and green alike.
TEST(Colour, TheZenithAtDuskIsBlue) {
  const SkyTablesCpu sky = bakeSky({}, glm::vec3(directionFromAngles(0.7, -4.0 * kDegree)), 100.0);
  const glm::vec3 zenith = law::lookupSky(sky.skyView.view(), sky.params.air, {0, 0, 1});
  EXPECT_LT(zenith.x, zenith.y);
  EXPECT_LT(zenith.y, zenith.z);
}

// Negative control: a tenth more molecules is seen by the gates above.
TEST(Transmittance, SeesATenthMoreAir) {
  Atmosphere thicker = published();
  thicker.rayleigh = 1.1f;
  const law::AtmosphereParams air = makeAtmosphereParams(thicker, glm::vec3(0, 0, 1), 0.0, kBlack);
  EXPECT_GT(std::abs(computeTransmittance(air, 0.0, 1.0).z - .762310), 1e-3);
}

}  // namespace
}  // namespace welkin
