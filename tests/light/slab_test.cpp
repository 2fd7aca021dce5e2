#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>

#include "welkin/light/law.hpp"

namespace welkin {
namespace {

glm::dvec3 scatter(const glm::dvec3& way, double g, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * uniform(random));
  const double cosine = (1.0 + g * g - s * s) / (2.0 * g), sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  const double turn = 2.0 * std::numbers::pi * uniform(random);
  const glm::dvec3 side =
      glm::normalize(glm::cross(way, std::abs(way.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  return glm::normalize(cosine * way + sine * (std::cos(turn) * side + std::sin(turn) * glm::cross(way, side)));
}

// Radiance toward `view` (the way of the light) of a slab under a beam of irradiance 1 that comes down along `beam`:
// photons, each scattering of which is also counted straight toward the eye.
double photons(const glm::dvec3& beam, const glm::dvec3& view, double tau, double g, int count) {
  std::mt19937_64 random(11);
  std::exponential_distribution<double> free;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    glm::dvec3 way = beam;
    double depth = free(random) * -way.z;
    while (depth > 0.0 && depth < tau) {
      const double left = (view.z < 0.0 ? tau - depth : depth) / std::abs(view.z);
      const double phase = law::phaseHenyeyGreenstein(static_cast<float>(glm::dot(way, view)), static_cast<float>(g));
      sum += phase * std::exp(-left) / std::abs(view.z);
      way = scatter(way, g, random);
      depth -= free(random) * way.z;
    }
  }
  return sum / count * -beam.z;
}

glm::dvec3 direction(double height, double azimuth) {
  const double across = std::sqrt(1.0 - height * height);
  return {across * std::cos(azimuth), across * std::sin(azimuth), height};
}

TEST(Slab, ThinItScattersOnce) {
  for (const bool beyond : {false, true}) {
    const float tau = 1e-4f, phase = 0.2f;
    EXPECT_NEAR(law::slabRadiance(phase, 0.5f, 0.78f, tau, 0.5f, 0.7f, beyond), phase * tau / 0.7f,
                0.03f * phase * tau);
  }
}

// The errors that slab.glsl states; thin layers are cirrus, what is over 1 altocumulus. Under a grazing beam the depth
// of the beam without its peak made side and back twice as bright, which an allowance of .01 1/sr once hid.
TEST(Slab, AgreesWithPhotons) {
  const double g = 0.78;
  double squares = 0.0, count = 0.0;
  for (const double tau : {0.15, 1.0, 3.0})
    for (const double sun : {0.1, 0.35, 0.8})
      for (const double eye : {-0.9, -0.4, 0.5})
        for (const double azimuth : {0.3, 2.0}) {
          const glm::dvec3 beam = direction(-sun, 0.0), view = direction(eye, azimuth);
          const double truth = photons(beam, view, tau, g, 60000);
          const auto cosTheta = static_cast<float>(glm::dot(beam, view));
          const float phase = law::phaseHenyeyGreenstein(cosTheta, static_cast<float>(g));
          const float found = law::slabRadiance(phase, cosTheta, static_cast<float>(g), static_cast<float>(tau),
                                                static_cast<float>(sun), static_cast<float>(std::abs(eye)), eye < 0.0);
          const double error = std::log(found / truth);
          EXPECT_LT(std::abs(error), tau < 0.2 ? 0.25 : 0.5) << tau << ' ' << sun << ' ' << eye << ' ' << azimuth;
          squares += error * error;
          count += 1.0;
        }
  const double error = std::sqrt(squares / count);
  std::printf("root mean square of log(found / truth) %.3f\n", error);
  EXPECT_LT(error, 0.2);
}

TEST(Slab, GrazingLightAndDeepLayersAreFinite) {
  for (const float tau : {0.0f, 1e-7f, 1.0f, 20.0f, 1e4f})
    for (const float low : {1e-3f, 0.12f, 1.0f})
      for (const bool beyond : {false, true}) {
        const float found = law::slabRadiance(50.0f, 1.0f, 0.86f, tau, low, 1.0f, beyond);
        EXPECT_TRUE(std::isfinite(found) && found >= 0.0f) << tau << ' ' << low;
      }
}

}  // namespace
}  // namespace welkin
