// Blue noise: every value once, no low frequencies, the same for the same seed.
#include "welkin/noise/blue_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace welkin {
namespace {

// Mean power at spatial frequencies of `low` to `high` cycles a tile; white noise has 1 everywhere.
double power(const std::vector<float>& values, int size, double low, double high) {
  const double all = static_cast<double>(values.size());
  double sum = 0.0, count = 0.0;
  for (int v = -size / 2; v < size / 2; ++v)
    for (int u = 0; u < size / 2; ++u) {
      const double f = std::hypot(u, v);
      if (f < low || f >= high) continue;
      std::complex<double> c = 0.0;
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
          c += (static_cast<double>(values[static_cast<std::size_t>(y * size + x)]) - 0.5) *
               std::polar(1.0, -2.0 * 3.14159265358979 * (u * x + v * y) / size);
      sum += std::norm(c) / all * 12.0;
      count += 1.0;
    }
  return sum / count;
}

TEST(BlueNoise, EveryValueOnce) {
  std::vector<float> values = blueNoise(32, 1);
  ASSERT_EQ(values.size(), 1024u);
  std::sort(values.begin(), values.end());
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i] * 1024.0f, static_cast<float>(i) + 0.5f);
}

TEST(BlueNoise, HasNoLowFrequencies) {
  const std::vector<float> values = blueNoise(32, 1);
  // Below a quarter of the sampling rate's half there is next to nothing; the power has gone to the highest.
  EXPECT_LT(power(values, 32, 1.0, 5.0), 0.05);
  EXPECT_GT(power(values, 32, 12.0, 16.0), 1.2);
  std::vector<float> white = values;
  std::mt19937 random(3);
  std::shuffle(white.begin(), white.end(), random);
  EXPECT_GT(power(white, 32, 1.0, 5.0), 0.5);
}

TEST(BlueNoise, SeedDecides) {
  EXPECT_EQ(blueNoise(16, 5), blueNoise(16, 5));
  EXPECT_NE(blueNoise(16, 5), blueNoise(16, 6));
}

}  // namespace
}  // namespace welkin
