// Random numbers of paths: uniform, independent between neighbours, the same in every lane width.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/trace/lanes.hpp"
#include "welkin/density/law.hpp"

namespace welkin {
namespace {

// xoshiro128+ once more, from its authors' description.
struct Scalar {
  std::uint32_t s[4];
  Scalar(std::uint32_t seed, std::uint32_t index, std::uint32_t sample) {
    for (std::uint32_t k = 0; k < 4; ++k)
      s[k] = law::hashUint(index + law::hashUint(sample + law::hashUint(law::hashSeed(seed) + k)));
    s[0] |= 1u;
  }
  float next() {
    const float u = static_cast<float>((s[0] + s[3]) >> 8) * 0x1p-24f;
    const std::uint32_t t = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = (s[3] << 11) | (s[3] >> 21);
    return u;
  }
};

constexpr std::size_t kPaths = 1 << 16;

std::vector<float> numbers(std::uint32_t seed, std::uint32_t sample, int skip) {
  std::vector<float> u(kPaths);
  lanes::randomNumbers(seed, sample, skip, u);
  return u;
}

// Standard normal if the cells of the unit square (16 x 16) are equally likely: chi-square of 255 degrees of freedom,
// by the approximation of Wilson and Hilferty.
double squareDeviation(const std::vector<float>& x, const std::vector<float>& y) {
  std::vector<double> cells(256);
  for (std::size_t i = 0; i < x.size(); ++i) cells[std::size_t(x[i] * 16) * 16 + std::size_t(y[i] * 16)] += 1.0;
  const double expected = double(x.size()) / 256.0;
  double chi = 0.0;
  for (const double c : cells) chi += (c - expected) * (c - expected) / expected;
  const double k = 255.0;
  return (std::cbrt(chi / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

// Each test looks at a few dozen deviations: 4.5 standard errors happen once in 10,000 such tests.
constexpr double kLimit = 4.5;

TEST(Random, EveryTargetAgreesWithTheScalarReference) {
  for (const int skip : {0, 1, 57}) {
    std::vector<float> expected;
    for (std::uint32_t i = 0; i < 4096; ++i) {
      Scalar s(12345, i, 9);
      for (int k = 0; k < skip; ++k) s.next();
      expected.push_back(s.next());
    }
    lanes::forEachTarget([&](const char* name) {
      std::vector<float> u(4096);
      lanes::randomNumbers(12345, 9, skip, u);
      EXPECT_EQ(u, expected) << name;
    });
  }
}

TEST(Random, OnlyLanesOfTheMaskMove) {
  std::vector<float> expected;
  for (std::uint32_t i = 0; i < 256; ++i) {
    Scalar s(7, i, 0);
    s.next();
    if (i % 2 == 0) s.next();
    expected.push_back(s.next());
  }
  lanes::forEachTarget([&](const char* name) {
    std::vector<float> u(256);
    lanes::maskedNumbers(7, u);
    EXPECT_EQ(u, expected) << name;
  });
}

TEST(Random, NumbersFillTheUnitInterval) {
  for (const int skip : {0, 1, 2, 3, 100}) {
    const std::vector<float> u = numbers(1, 0, skip);
    EXPECT_GE(*std::min_element(u.begin(), u.end()), 0.0f);
    EXPECT_LT(*std::max_element(u.begin(), u.end()), 1.0f);
    EXPECT_LT(std::abs(squareDeviation(u, numbers(1, 0, skip + 1))), kLimit) << "number " << skip << " and the next";
  }
}

TEST(Random, NeighbouringSeedsPathsAndSamplesAreIndependent) {
  for (const int skip : {0, 1, 5}) {
    const std::vector<float> u = numbers(41, 3, skip);
    EXPECT_LT(std::abs(squareDeviation(u, numbers(42, 3, skip))), kLimit) << "seed";
    EXPECT_LT(std::abs(squareDeviation(u, numbers(41, 4, skip))), kLimit) << "sample";
    std::vector<float> neighbour(u.begin() + 1, u.end());
    neighbour.push_back(u.front());
    EXPECT_LT(std::abs(squareDeviation(u, neighbour)), kLimit) << "index";
  }
}

// Negative control: a share of one part in 16 that repeats its neighbour is seen.
TEST(Random, TheTestSeesDependence) {
  const std::vector<float> u = numbers(1, 0, 0);
  std::vector<float> v = numbers(2, 0, 0);
  for (std::size_t i = 0; i < v.size(); i += 16) v[i] = u[i];
  EXPECT_GT(squareDeviation(u, v), kLimit);
}

}  // namespace
}  // namespace welkin
