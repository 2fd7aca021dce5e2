// Phase functions: integrals over the sphere, mean cosines and published values (Henyey-Greenstein, Draine 2003,
// Jendersie and d'Eon 2023).
#include "welkin/light/phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace welkin {
namespace {

using Phase = std::function<double(double)>;

// Integral over the sphere of f(cosTheta) cosTheta^power, by midpoints that crowd toward straight on.
double integrate(const Phase& f, int power) {
  constexpr int kSteps = 400000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = (i + 0.5) / kSteps, angle = std::numbers::pi * x * x * x;
    const double weight = 3.0 * std::numbers::pi * x * x / kSteps;
    sum += f(std::cos(angle)) * std::pow(std::cos(angle), power) * std::sin(angle) * weight;
  }
  return 2.0 * std::numbers::pi * sum;
}

void expectPhase(const char* name, const Phase& f, double mean, double tolerance = 2e-5) {
  EXPECT_NEAR(integrate(f, 0), 1.0, tolerance) << name;
  EXPECT_NEAR(integrate(f, 1), mean, tolerance) << name;
}

float cosine(double c) { return static_cast<float>(c); }

TEST(Phase, IntegratesToOneWithItsMeanCosine) {
  expectPhase(
      "isotropic", [](double) { return static_cast<double>(law::phaseIsotropic()); }, 0.0);
  expectPhase(
      "Rayleigh", [](double c) { return law::phaseRayleigh(cosine(c)); }, 0.0);
  for (const float g : {-0.5f, 0.0f, 0.5f, 0.85f, 0.95f}) {
    expectPhase(
        "Henyey-Greenstein", [g](double c) { return law::phaseHenyeyGreenstein(cosine(c), g); }, g);
    for (const float alpha : {0.0f, 1.0f, 20.0f}) {
      const double mean = g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
      expectPhase(
          "Draine", [=](double c) { return law::phaseDraine(cosine(c), g, alpha); }, mean);
    }
  }
  expectPhase(
      "two lobes", [](double c) { return law::phaseDualHenyeyGreenstein(cosine(c), 0.8f, -0.2f, 0.25f); },
      0.75 * 0.8 - 0.25 * 0.2);
  EXPECT_NEAR(integrate([](double c) { return law::phaseSchlick(cosine(c), law::schlickFromAsymmetry(0.85f)); }, 0),
              1.0, 2e-5);
}

// The fit's forward peak is 1e-2 rad wide: 1 - cosTheta has a step of 6e-8 in float, which costs a few 1e-4 here.
TEST(Phase, MieFitIntegratesToOne) {
  for (const double d : {5.0, 10.0, 20.0, 50.0}) {
    const law::MiePhase mie = computeMiePhase(d);
    expectPhase(
        "Mie", [mie](double c) { return law::phaseMie(cosine(c), mie); }, meanCosine(mie), 1e-3);
  }
}

TEST(Phase, HenyeyGreensteinValues) {
  const double at5[] = {0.4774648, 0.1492038, 0.0427058, 0.0217987, 0.0176839};
  const double at85[] = {6.5430365, 0.0588199, 0.0097682, 0.0044153, 0.0034877};
  for (int i = 0; i < 5; ++i) {
    const float c = cosine(std::cos(i * std::numbers::pi / 4));
    EXPECT_NEAR(law::phaseHenyeyGreenstein(c, 0.5f), at5[i], 1e-5 * at5[i] + 1e-7);
    EXPECT_NEAR(law::phaseHenyeyGreenstein(c, 0.85f), at85[i], 2e-5 * at85[i] + 1e-7);
  }
}

TEST(Phase, MieFitValues) {
  struct Row {
    double diameter, mean, p0, p45, p90, p180;
  };
  for (const Row& r : {Row{10, 0.864164, 586.86, 0.0676066, 0.00172563, 0.012715},
                       Row{20, 0.879310, 2742.51, 0.0629513, 0.00114718, 0.010914}}) {
    const law::MiePhase mie = computeMiePhase(r.diameter);
    EXPECT_NEAR(meanCosine(mie), r.mean, 1e-6);
    EXPECT_NEAR(law::phaseMie(1.0f, mie), r.p0, 1e-4 * r.p0);
    EXPECT_NEAR(law::phaseMie(cosine(std::sqrt(0.5)), mie), r.p45, 1e-5 * r.p45 + 1e-7);
    EXPECT_NEAR(law::phaseMie(0.0f, mie), r.p90, 1e-5 * r.p90 + 1e-8);
    EXPECT_NEAR(law::phaseMie(-1.0f, mie), r.p180, 1e-5 * r.p180 + 1e-7);
  }
}

TEST(Phase, DiameterIsTheInverseOfTheMeanCosine) {
  for (const double d : {5.5, 8.0, 12.0, 30.0, 49.0})
    EXPECT_NEAR(diameterFromMeanCosine(meanCosine(computeMiePhase(d))), d, 0.01);
  EXPECT_NEAR(meanCosine(computeMiePhase(diameterFromMeanCosine(0.86))), 0.86, 1e-6);
  EXPECT_NEAR(diameterFromMeanCosine(0.5), 5.0, 1e-6) << "outside the fit: its nearest end";
  EXPECT_NEAR(diameterFromMeanCosine(0.99), 50.0, 1e-6);
}

TEST(Phase, KnownRelations) {
  for (const float c : {-0.9f, 0.1f, 0.99f}) {
    EXPECT_NEAR(law::phaseDraine(c, 0.0f, 1.0f), law::phaseRayleigh(c), 1e-7);
    const float g = 0.8f;
    const double cornetteShanks =
        3 / (8 * std::numbers::pi) * (1 - g * g) * (1 + c * c) / ((2 + g * g) * std::pow(1 + g * g - 2 * g * c, 1.5));
    EXPECT_NEAR(law::phaseCornetteShanks(c, g), cornetteShanks, 2e-5 * cornetteShanks);
  }
  EXPECT_GT(law::phaseSchlick(1.0f, 0.5f), law::phaseSchlick(-1.0f, 0.5f)) << "forward is at +1";
}

// Negative control: the factor pi^2 of a well-known misprint is seen.
TEST(Phase, SeesAWrongFactor) {
  const Phase wrong = [](double c) { return law::phaseHenyeyGreenstein(cosine(c), 0.5f) * 9.8696; };
  EXPECT_GT(std::abs(integrate(wrong, 0) - 1.0), 1.0);
}

TEST(Transmittance, ClosedForms) {
  EXPECT_NEAR(law::beerLambert(1.5f), std::exp(-1.5), 1e-7);
  EXPECT_NEAR(law::powder(0.7f), 1 - std::exp(-1.4), 1e-7);
  EXPECT_NEAR(law::beerPowder(0.7f), 2 * std::exp(-0.7) * (1 - std::exp(-1.4)), 1e-7);
  EXPECT_EQ(law::stepIntegral(0.0f, 25.0f), 25.0f);
  for (const double tau : {1e-8, 1e-4, 0.029, 0.031, 1.0, 30.0}) {
    const double d = 50, exact = -std::expm1(-tau) * d / tau;
    EXPECT_NEAR(law::stepIntegral(cosine(tau / d), 50.0f), exact, 4e-6 * exact) << tau;
  }
}

// A step may be cut anywhere without changing the light that it adds.
TEST(Transmittance, StepsJoin) {
  const float sigma = 0.02f, a = 13.0f, b = 40.0f;
  EXPECT_NEAR(law::stepIntegral(sigma, a + b),
              law::stepIntegral(sigma, a) + law::beerLambert(sigma * a) * law::stepIntegral(sigma, b), 1e-4);
}

}  // namespace
}  // namespace welkin
