// Phase tables: normalised, with the mean cosines of closed forms, sampled as their density says, with weights near 1.
#include "welkin/trace/phase_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/trace/lanes.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/error.hpp"

namespace welkin {
namespace {

struct Named {
  const char* name;
  PhaseTable table;
  double meanCosine;
  double farthestWeight;  // |weight - 1|: twice what was measured; grows with the sharpness of the peak
};

// A made-up function with a peak, a fog bow, a gap without light and a glory, in steps of half a degree.
PhaseTable lumpyTable() {
  std::vector<double> degrees, values;
  for (int i = 0; i <= 360; ++i) {
    const double d = 0.5 * i;
    degrees.push_back(d);
    const double bow = std::exp(-std::pow((d - 140.0) / 2.0, 2)), glory = std::exp(-std::pow((d - 180.0) / 3.0, 2));
    values.push_back(d > 80.0 && d < 95.0 ? 0.0 : 300.0 * std::exp(-d) + 0.02 + 0.3 * bow + 0.2 * glory);
  }
  return PhaseTable::tabulated(degrees, values);
}

std::vector<Named> tables() {
  std::vector<Named> all;
  for (const double g : {-0.85, 0.0, 0.5, 0.85, 0.99})
    all.push_back({"hg", PhaseTable::henyeyGreenstein(g), g, g > 0.9 ? 5e-3 : 1e-4});
  // references.md, section 4: Jendersie and d'Eon 2023.
  all.push_back({"mie 10", PhaseTable::mie(computeMiePhase(10.0)), 0.864164, 3e-3});
  all.push_back({"mie 20", PhaseTable::mie(computeMiePhase(20.0)), 0.879310, 1e-2});
  const std::vector<double> ends{0.0, 180.0}, flat{3.0, 3.0}, ramp{1.0, 0.0};
  all.push_back({"flat table", PhaseTable::tabulated(ends, flat), 0.0, 1e-5});
  // (1 + cosTheta) / (4 pi): mean cosine 1/3.
  all.push_back({"ramp", PhaseTable::tabulated(ends, ramp), 1.0 / 3.0, 1e-4});
  PhaseTable table = lumpyTable();
  const double g = table.meanCosine();
  all.push_back({"lumpy", std::move(table), g, 1e-3});
  return all;
}

// Strata of u with the midpoint of each: integrals over the sphere of f p by the table's own samples.
constexpr std::size_t kStrata = 1 << 20;
float stratum(std::size_t i) { return (static_cast<float>(i) + 0.5f) / float(kStrata); }

TEST(PhaseTable, IntegratesToOneWithItsMeanCosine) {
  for (const Named& n : tables()) {
    double sum = 0.0, cosine = 0.0;
    for (std::size_t i = 0; i < kStrata; ++i) {
      const PhaseTable::Sample s = n.table.sample(stratum(i));
      const double weight = double(n.table.evaluate(s.versine)) / double(s.pdf);
      sum += weight;
      cosine += weight * (1.0 - double(s.versine));
    }
    // Sampling at midpoints leaves 1e-6; the law's floats 2e-6 at the sharpest peak.
    EXPECT_NEAR(sum / kStrata, 1.0, 5e-6) << n.name;
    EXPECT_NEAR(cosine / kStrata, n.meanCosine, 5e-6) << n.name;
    EXPECT_NEAR(n.table.meanCosine(), n.meanCosine, 1e-6) << n.name;
  }
}

TEST(PhaseTable, WeightsStayNearOne) {
  for (const Named& n : tables()) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < kStrata; i += 7) {
      const PhaseTable::Sample s = n.table.sample(stratum(i));
      farthest = std::max(farthest, std::abs(double(n.table.evaluate(s.versine)) / double(s.pdf) - 1.0));
      ASSERT_TRUE(s.versine >= 0.0f && s.versine <= 2.0f && s.pdf > 0.0f) << n.name;
    }
    EXPECT_LT(farthest, n.farthestWeight) << n.name;
  }
}

// Chi-square of samples against pdf() integrated over angular bins, as a standard normal (Wilson and Hilferty).
double chiDeviation(const PhaseTable& sampled, const PhaseTable& density) {
  constexpr std::size_t kSamples = 1 << 20, kBins = 180;
  std::vector<double> expected(kBins), counted(kBins);
  for (std::size_t b = 0; b < kBins; ++b)
    for (int i = 0; i < 2000; ++i) {
      const double angle = (double(b) + (i + 0.5) / 2000.0) * kPi / 180.0, s = std::sin(0.5 * angle);
      expected[b] +=
          kSamples * 2.0 * kPi * double(density.pdf(float(2.0 * s * s))) * std::sin(angle) * kPi / 180.0 / 2000.0;
    }
  std::vector<float> u(kSamples);
  lanes::randomNumbers(3, 1, 0, u);
  for (const float x : u) {
    const double v = sampled.sample(x).versine;
    counted[std::min(std::size_t(2.0 * std::asin(std::sqrt(0.5 * v)) * 180.0 / kPi), kBins - 1)] += 1.0;
  }
  double chi = 0.0, k = -1.0;
  for (std::size_t b = 0; b < kBins; ++b) {
    if (expected[b] < 10.0) {
      if (counted[b] > 60.0) return 1e3;
      continue;
    }
    chi += std::pow(counted[b] - expected[b], 2) / expected[b];
    k += 1.0;
  }
  return (std::cbrt(chi / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

TEST(PhaseTable, SamplesFollowTheDensity) {
  for (const Named& n : tables()) EXPECT_LT(chiDeviation(n.table, n.table), 4.0) << n.name;
  // Negative control: a hundredth more asymmetry is seen.
  EXPECT_GT(chiDeviation(PhaseTable::henyeyGreenstein(0.85), PhaseTable::henyeyGreenstein(0.86)), 4.0);
}

TEST(PhaseTable, EveryTargetAgreesWithScalar) {
  constexpr std::size_t kCount = 1 << 14;
  std::vector<float> u(kCount), versine(kCount), pdf(kCount), again(kCount), value(kCount);
  for (std::size_t i = 0; i < kCount; ++i) u[i] = (float(i) + 0.37f) / float(kCount);
  for (const Named& n : tables())
    lanes::forEachTarget([&](const char* target) {
      lanes::samplePhase(n.table.view(), u, versine, pdf);
      lanes::phasePdf(n.table.view(), versine, again);
      lanes::evaluatePhase(n.table.view(), versine, value);
      for (std::size_t i = 0; i < kCount; ++i) {
        const PhaseTable::Sample s = n.table.sample(u[i]);
        ASSERT_NEAR(versine[i], s.versine, 1e-6f * s.versine) << n.name << " on " << target << " at u " << u[i];
        ASSERT_NEAR(pdf[i], s.pdf, 1e-5f * s.pdf) << n.name << " on " << target;
        ASSERT_NEAR(again[i], n.table.pdf(versine[i]), 1e-5f * s.pdf) << n.name << " on " << target;
        ASSERT_NEAR(value[i], n.table.evaluate(versine[i]), 1e-5f * s.pdf) << n.name << " on " << target;
      }
    });
}

// A table of Henyey-Greenstein every 0.05 degrees is Henyey-Greenstein.
TEST(PhaseTable, ATabulatedFunctionIsTheFunction) {
  std::vector<double> degrees, values;
  const PhaseTable hg = PhaseTable::henyeyGreenstein(0.85);
  for (int i = 0; i <= 3600; ++i) {
    degrees.push_back(i == 3600 ? 180.0 : 0.05 * i);
    const double s = std::sin(degrees.back() * kPi / 360.0);
    values.push_back(17.0 * double(hg.evaluate(float(2.0 * s * s))));
  }
  const PhaseTable table = PhaseTable::tabulated(degrees, values);
  EXPECT_NEAR(table.meanCosine(), 0.85, 1e-6);
  for (const float v : {0.0f, 1e-4f, 0.3f, 1.0f, 1.9f}) EXPECT_NEAR(table.evaluate(v) / hg.evaluate(v), 1.0, 1e-5) << v;
}

TEST(PhaseTable, ReadsText) {
  const PhaseTable t = PhaseTable::parse("# angle value\n0 2\r\n\n 90, 1 # side\n180\t0", "ramp.txt");
  EXPECT_NEAR(t.meanCosine(), 1.0 / 3.0, 1e-9);
}

TEST(PhaseTable, RefusesNonsense) {
  for (const char* text :
       {"", "0 1", "0 1\n90 1", "1 1\n180 1", "0 1\n180 -1", "0 1\n180 nan", "0 1\n180 inf", "0 0\n180 0",
        "0 1\n90 1\n90 1\n180 1", "0 1\n100 1\n50 1\n180 1", "0 1\nnan 1\n180 1", "0 1 2\n180 1", "0\n180 1",
        "zero 1\n180 1", "0 1x\n180 1", "0 1e300\n180 1e300", "0 1e-40\n180 1e-40", "0x10 1\n180 1"})
    EXPECT_THROW(PhaseTable::parse(text, "bad.txt"), Error) << text;
  EXPECT_THROW(PhaseTable::henyeyGreenstein(1.0), Error);
  EXPECT_THROW(PhaseTable::henyeyGreenstein(std::nan("")), Error);
  try {
    PhaseTable::parse("0 1\n# fine\n10 one\n180 1", "bad.txt");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("bad.txt:3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace welkin
