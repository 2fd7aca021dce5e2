// Sky models in closed form, derived here again from the papers: Preetham, Shirley and Smits 1999 and the gradient.
#include <gtest/gtest.h>

#include <cmath>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/atmosphere/tables.hpp"

namespace welkin {
namespace {

// F(theta, gamma) of Perez, Seals and Michalsky 1993 with coefficients linear in turbidity.
struct Distribution {
  double a, b, c, d, e;
  double operator()(double theta, double gamma) const {
    return (1 + a * std::exp(b / std::cos(theta))) *
           (1 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma));
  }
};

// Linear Rec.709 of Preetham's sky, written out from the paper's appendix A.2.
glm::dvec3 preetham(double T, double sunTheta, double theta, double gamma) {
  const Distribution Y{.1787 * T - 1.4630, -.3554 * T + .4275, -.0227 * T + 5.3251, .1206 * T - 2.5771,
                       -.0670 * T + .3703};
  const Distribution x{-.0193 * T - .2592, -.0665 * T + .0008, -.0004 * T + .2125, -.0641 * T - .8989,
                       -.0033 * T + .0452};
  const Distribution y{-.0167 * T - .2608, -.0950 * T + .0092, -.0079 * T + .2102, -.0441 * T - 1.6537,
                       -.0109 * T + .0529};
  const double s = sunTheta, s2 = s * s, s3 = s2 * s, T2 = T * T;
  const double zenithY = (4.0453 * T - 4.9710) * std::tan((4.0 / 9 - T / 120) * (kPi - 2 * s)) - .2155 * T + 2.4192;
  const double zenithX = (.00166 * s3 - .00375 * s2 + .00209 * s) * T2 +
                         (-.02903 * s3 + .06377 * s2 - .03202 * s + .00394) * T +
                         (.11693 * s3 - .21196 * s2 + .06052 * s + .25886);
  const double zenithy = (.00275 * s3 - .00610 * s2 + .00317 * s) * T2 +
                         (-.04214 * s3 + .08970 * s2 - .04153 * s + .00516) * T +
                         (.15346 * s3 - .26756 * s2 + .06670 * s + .26688);
  const double cy = zenithy * y(theta, gamma) / y(0, s), cx = zenithX * x(theta, gamma) / x(0, s);
  const double l = zenithY * Y(theta, gamma) / Y(0, s);
  const double X = cx / cy * l, Z = (1 - cx - cy) / cy * l;
  return {3.2404542 * X - 1.5371385 * l - 0.4985314 * Z, -0.9692660 * X + 1.8760108 * l + 0.0415560 * Z,
          0.0556434 * X - 0.2040259 * l + 1.0572252 * Z};
}

TEST(Preetham, AgreesWithItsClosedForm) {
  for (const double turbidity : {2.0, 3.0, 6.0})
    for (const double sunTheta : {0.2, 0.9, 1.4}) {
      const glm::vec3 sun(directionFromAngles(0.4, kPi / 2 - sunTheta));
      const law::PreethamParams p = makePreethamParams(turbidity, sun);
      for (const double theta : {0.0, 0.5, 1.2, 1.5})
        for (const double heading : {0.4, 1.5, 3.0}) {
          const glm::vec3 d(directionFromAngles(heading, kPi / 2 - theta));
          const double gamma = std::acos(std::min(1.0, static_cast<double>(glm::dot(d, sun))));
          const glm::dvec3 expected = glm::max(preetham(turbidity, sunTheta, theta, gamma), glm::dvec3(0.0));
          const glm::vec3 got = law::preethamRadiance(p, d.z, glm::dot(d, sun));
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(got[c], expected[c], 2e-3 * std::max(expected[c], 0.5)) << turbidity << " " << sunTheta;
        }
    }
}

// At the zenith the luminance is the published formula: T 2, sun 45 degrees from it.
TEST(Preetham, ZenithLuminance) {
  const glm::vec3 sun(directionFromAngles(0.0, kPi / 4));
  const glm::vec3 zenith = law::preethamRadiance(makePreethamParams(2.0, sun), 1.0f, sun.z);
  const double chi = (4.0 / 9 - 2.0 / 120) * (kPi / 2);
  EXPECT_NEAR(luminance(zenith), (4.0453 * 2 - 4.9710) * std::tan(chi) - .2155 * 2 + 2.4192, 0.01);
  EXPECT_GT(zenith.z, zenith.x) << "blue";
}

TEST(Preetham, GoesDarkAfterSunset) {
  double last = 1e9;
  for (const double elevation : {0.05, 0.0, -0.05, -0.15, -0.3, -1.5}) {
    const glm::vec3 sun(directionFromAngles(0.0, elevation));
    const double l = luminance(law::preethamRadiance(makePreethamParams(3.0, sun), 1.0f, sun.z));
    EXPECT_TRUE(std::isfinite(l));
    EXPECT_LE(l, last);
    last = l;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(Colour, WhiteIsWhite) {
  const glm::vec3 white = law::rec709FromXyz(law::xyzFromXyY({0.3127f, 0.3290f, 2.0f}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 2.0, 2e-3);
}

TEST(Gradient, RunsFromHorizonToZenithWithAGlow) {
  Atmosphere a;
  a.model = SkyKind::gradient;
  const law::GradientParams p = makeGradientParams(a);
  EXPECT_EQ(law::gradientRadiance(p, 0.0f, -1.0f), a.gradientHorizon);
  EXPECT_EQ(law::gradientRadiance(p, 1.0f, -1.0f), a.gradientZenith);
  EXPECT_NEAR(law::gradientRadiance(p, 1.0f, 1.0f).x, a.gradientZenith.x + a.gradientGlow.x, 1e-4);
}

// Every model fills the same table; air and sun stay physical.
TEST(Models, FillTheSkyViewTable) {
  const glm::vec3 sun(directionFromAngles(1.0, 0.6));
  Atmosphere a;
  const SkyTablesCpu physical = bakeSky(a, sun, 100.0);
  a.model = SkyKind::preetham;
  const SkyTablesCpu painted = bakeSky(a, sun, 100.0);
  const glm::vec3 d(directionFromAngles(2.0, 0.5)), down(directionFromAngles(2.0, -0.5));
  const glm::vec3 closed = law::preethamRadiance(makePreethamParams(a.turbidity, sun), d.z, glm::dot(d, sun));
  const glm::vec3 looked = law::lookupSky(painted.skyView.view(), painted.params.air, d);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(looked[c], closed[c], 0.01 * closed[c]);
  EXPECT_EQ(painted.aerialInscatter.texels, physical.aerialInscatter.texels);
  EXPECT_EQ(law::lookupSky(painted.skyView.view(), painted.params.air, down),
            law::lookupSky(physical.skyView.view(), physical.params.air, down));
  EXPECT_EQ(painted.light.sunIrradiance, physical.light.sunIrradiance);
}

class Uniform : public SkyModel {
 public:
  glm::vec3 radiance(const glm::vec3& d) const override { return d.x > 0 ? glm::vec3(2.0f) : glm::vec3(4.0f); }
};

TEST(Models, AUsersModelIsTheMeanOfTheTwoSides) {
  const Uniform user;
  const SkyTablesCpu sky = bakeSky({}, glm::vec3(0, 0.8f, 0.6f), 100.0, kDefaultGroundAlbedo, &user);
  const glm::vec3 c = law::lookupSky(sky.skyView.view(), sky.params.air, glm::normalize(glm::vec3(0.6f, 0.3f, 0.4f)));
  EXPECT_NEAR(c.x, 3.0f, 1e-4f);
  EXPECT_NEAR(sky.light.meanRadiance.x, 3.0f, 1e-4f);
  EXPECT_NEAR(sky.light.skyIrradiance.x, 3.0 * kPi, 0.05);
}

}  // namespace
}  // namespace welkin
