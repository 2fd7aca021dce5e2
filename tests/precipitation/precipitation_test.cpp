// Rain and snow against published measurements and their own integrals.
#include <gtest/gtest.h>

#include <cmath>

#include "welkin/precipitation/law.hpp"

namespace welkin::law {
namespace {

// The integral of f over the diameters above `least`, mm.
template <class F>
double integral(double least, const F& f) {
  constexpr int kSteps = 20000;
  constexpr double kMost = 40.0;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double d = least + (kMost - least) * (i + 0.5) / kSteps;
    sum += f(d) * (kMost - least) / kSteps;
  }
  return sum;
}

double rainDrops(double d, float rate) { return rainIntercept(rate) * std::exp(-rainSlope(rate) * d); }
double flakes(double d, float rate) { return snowIntercept(rate) * std::exp(-snowSlope(rate) * d); }

TEST(Rain, FallsAsFastAsGunnAndKinzerMeasured) {
  // Their table of 1949: mm, m/s.
  const double measured[][2] = {{0.5, 2.06}, {1.0, 4.03}, {2.0, 6.49}, {3.0, 8.06}, {4.0, 8.83}, {5.0, 9.09}};
  for (const auto& [diameter, speed] : measured)
    EXPECT_NEAR(rainSpeed(static_cast<float>(diameter)), speed, 0.15) << diameter << " mm";
  EXPECT_GT(rainSpeed(0.0f), 0.0f) << "nothing falls upward";
}

TEST(Snow, FallsByAboutAMetreASecond) {
  for (const float flake : {2.0f, 4.0f, 10.0f}) EXPECT_NEAR(snowSpeed(flake / kSnowSwelling), 1.0, 0.2) << flake;
}

TEST(Rain, ItsDropsCarryItsWater) {
  for (const float rate : {1.0f, 5.0f, 25.0f, 100.0f}) {
    // mm^3 of water through a m^2 in a second; 1 mm of rain is 10^6 mm^3 on a m^2.
    const double flux = integral(
        0.0, [&](double d) { return rainDrops(d, rate) * rainSpeed(static_cast<float>(d)) * M_PI / 6.0 * d * d * d; });
    EXPECT_NEAR(flux * 3600.0 / 1e6 / rate, 1.0, 0.25) << rate << " mm/h; the fit is not exact";
  }
}

TEST(Rain, ClosedFormsAreItsIntegrals) {
  for (const float rate : {0.5f, 4.0f, 40.0f})
    for (const float least : {0.0f, 0.6f, 1.0f}) {
      const double area = 0.25e-6 * M_PI;
      const double rain = integral(least, [&](double d) { return area * d * d * rainDrops(d, rate); });
      const double snow =
          integral(least, [&](double d) { return area * kSnowSwelling * kSnowSwelling * d * d * flakes(d, rate); });
      EXPECT_NEAR(rainExtinction(rate) * sectionAbove(rainSlope(rate), least) / rain, 1.0, 2e-3);
      EXPECT_NEAR(snowExtinction(rate) * sectionAbove(snowSlope(rate), least) / snow, 1.0, 2e-3);
      const double count = integral(least, [&](double d) { return rainDrops(d, rate); });
      EXPECT_NEAR(countAbove(rainIntercept(rate), rainSlope(rate), least) / count, 1.0, 2e-3);
    }
}

TEST(Rain, SizesDivideItsDropsAsTheyShould) {
  const float rate = 8.0f, slope = rainSlope(rate), least = 1.0f;
  for (const float u : {0.1f, 0.5f, 0.9f}) {
    const double above = integral(sizeAt(u, slope, least), [&](double d) { return rainDrops(d, rate); });
    const double all = integral(least, [&](double d) { return rainDrops(d, rate); });
    EXPECT_NEAR(1.0 - above / all, u, 2e-3);
  }
  EXPECT_LE(sizeAt(1.0f, slope, least), kLargestDrop);
}

TEST(Rain, LightRainDriesUpOnItsWayAndHeavyRainHardlyLoses) {
  const float lost = std::sqrt(2.0f);  // of 2 mm/h nothing arrives
  EXPECT_FLOAT_EQ(leftOf(2.0f, 0.0f, lost), 2.0f) << "nothing is lost at the cloud";
  EXPECT_NEAR(leftOf(2.0f, 1.0f, lost), 0.0f, 1e-6);
  EXPECT_EQ(leftOf(0.5f, 0.6f, lost), 0.0f) << "virga ends above the ground";
  EXPECT_GT(leftOf(0.5f, 0.4f, lost), 0.0f);
  EXPECT_GT(leftOf(50.0f, 1.0f, lost), 0.6f * 50.0f);
  float before = 20.0f;
  for (float fallen = 0.0f; fallen <= 1.0f; fallen += 0.05f) {
    EXPECT_LE(leftOf(20.0f, fallen, lost), before);
    before = leftOf(20.0f, fallen, lost);
  }
}

TEST(Snow, MeltsBelowTheFreezingLevel) {
  EXPECT_EQ(snowShare(1500.0f, 1000.0f), 1.0f);
  EXPECT_EQ(snowShare(500.0f, 1000.0f), 0.0f);
  EXPECT_GT(fallingExtinction(1.0f, 1.0f), 10.0f * fallingExtinction(1.0f, 0.0f)) << "the bright band's reason";
  EXPECT_EQ(fallingExtinction(0.0f, 1.0f), 0.0f);
}

TEST(Flakes, FlutterInCirclesAndShowTheirSides) {
  double area = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const float turn = static_cast<float>(i) * 0.01f;
    const glm::vec3 offset = flutter(turn, 0.3f, 0.02f);
    EXPECT_NEAR(std::hypot(offset.x, offset.y), 0.02f, 1e-5f);
    const glm::vec3 again = flutter(turn + 1.0f, 0.3f, 0.02f);
    EXPECT_NEAR(again.x, offset.x, 1e-4f);
    area += tumbled(turn, 0.3f) / 1000.0;
  }
  EXPECT_NEAR(area, 0.68, 0.02);
}

TEST(Streaks, CoverTheAreaOfTheirParticle) {
  // The integral of the peak times 1 - r^2 over an ellipse is pi/2 a b.
  EXPECT_NEAR(streakOpacity(0.4f, 6.0f, 0.8f) * M_PI / 2.0 * 6.0 * 0.8, 0.4, 1e-4);
  EXPECT_LT(streakOpacity(100.0f, 1.0f, 1.0f), 1.0f);
}

}  // namespace
}  // namespace welkin::law
