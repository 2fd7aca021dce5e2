// Height maps: the octave scheme of 002.
#include "welkin/density/classical/height_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace welkin {
namespace {

constexpr HeightMapSettings kRough{.squares = 50, .step = 1.0f, .smoothing = 0, .elements = 256};

double largestDifference(const HeightMap& map) {
  double most = 0.0;
  const int n = map.size;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const float here = map.heights[std::size_t(y * n + x)];
      most = std::max<double>(most, std::abs(here - map.heights[std::size_t(y * n + (x + 1) % n)]));
      most = std::max<double>(most, std::abs(here - map.heights[std::size_t((y + 1) % n * n + x)]));
    }
  return most;
}

TEST(HeightMap, IsTheMeanOfItsOctavesOfSquares) {
  HeightMapSettings s = kRough;
  s.octaves = 1;
  const HeightMap one = bakeHeightMap(s, 3);
  // Squares of 50 elements, the last one cut off: 6 x 6 of them.
  std::set<float> values;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const float v = one.heights[std::size_t(y * 256 + x)];
      values.insert(v);
      ASSERT_EQ(v, one.heights[std::size_t(y / 50 * 50 * 256 + x / 50 * 50)]);
      ASSERT_GE(v, 0.0f);
      ASSERT_LE(v, 1.0f);
    }
  EXPECT_EQ(values.size(), 36u);
  // The second octave has half the squares' side and half the amplitude; the result is the mean of both.
  s.octaves = 2;
  const HeightMap two = bakeHeightMap(s, 3);
  float least = 1.0f, most = 0.0f;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const std::size_t i = std::size_t(y * 256 + x);
      const float second = 2.0f * two.heights[i] - one.heights[i];
      least = std::min(least, second);
      most = std::max(most, second);
      ASSERT_NEAR(second,
                  2.0f * two.heights[std::size_t(y / 25 * 25 * 256 + x / 25 * 25)] -
                      one.heights[std::size_t(y / 25 * 25 * 256 + x / 25 * 25)],
                  1e-6f);
    }
  EXPECT_GE(least, -1e-6f);
  EXPECT_LE(most, 0.5f);
  EXPECT_GT(most - least, 0.4f);
  s.amplitude = 0.5f;
  EXPECT_NEAR(bakeHeightMap(s, 3).heights[777], 0.5f * two.heights[777], 1e-6f);
}

TEST(HeightMap, NeighboursOfADenseMapDifferByTheStepAtMost) {
  for (const float step : {0.05f, 0.3f, 1.0f}) {
    HeightMapSettings s = kRough;
    s.squares = 8;
    s.octaves = 1;
    s.step = step;
    const double most = largestDifference(bakeHeightMap(s, 9));
    EXPECT_LE(most, step + 1e-5);
    EXPECT_GT(most, 0.9 * std::min(step, 0.9f));
  }
}

// Slow: each element the mean of the nine round it, round the edges too.
HeightMap naivelySmoothed(HeightMap map, int times) {
  const int n = map.size;
  for (int t = 0; t < times; ++t) {
    const HeightMap before = map;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        double sum = 0.0;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) sum += before.heights[std::size_t((y + j + n) % n * n + (x + i + n) % n)];
        map.heights[std::size_t(y * n + x)] = static_cast<float>(sum / 9.0);
      }
  }
  return map;
}

TEST(HeightMap, SmoothingIsTheMeanOfNeighboursManyTimes) {
  for (const int squares : {2, 9, 50, 300})
    for (const int times : {1, 12}) {
      HeightMapSettings s = kRough;
      s.squares = squares;
      const HeightMap slow = naivelySmoothed(bakeHeightMap(s, 4), times);
      s.smoothing = times;
      const HeightMap fast = bakeHeightMap(s, 4);
      float most = 0.0f;
      for (std::size_t i = 0; i < slow.heights.size(); ++i)
        most = std::max(most, std::abs(slow.heights[i] - fast.heights[i]));
      EXPECT_LT(most, 2e-5f) << squares << " " << times;
    }
}

TEST(HeightMap, RepeatsAndIsFilteredAcrossItsEdges) {
  HeightMapSettings s = kRough;
  s.smoothing = 12;
  const HeightMap map = bakeHeightMap(s, 1);
  for (const double x : {0.1, 0.5, 128.25, 255.9})
    for (const double y : {0.0, 255.99, 31.5}) {
      EXPECT_NEAR(map.at(x, y), map.at(x - 256.0, y + 512.0), 1e-5f);
      EXPECT_NEAR(map.at(x, y), map.at(x + 1e-4, y), 1e-4f);
    }
  EXPECT_EQ(map.at(3.5, 7.5), map.heights[7 * 256 + 3]);
  EXPECT_NEAR(map.at(256.0, 7.5), 0.5f * (map.heights[7 * 256 + 255] + map.heights[7 * 256]), 1e-6f);
}

TEST(HeightMap, SameSeedSameMap) {
  EXPECT_EQ(bakeHeightMap(kRough, 1).heights, bakeHeightMap(kRough, 1).heights);
  EXPECT_NE(bakeHeightMap(kRough, 1).heights, bakeHeightMap(kRough, 2).heights);
}

TEST(HeightMap, CoverIsTheShareAboveAHeight) {
  HeightMapSettings s = kRough;
  s.smoothing = 12;
  const HeightMap map = bakeHeightMap(s, 1);
  for (const float cover : {0.1f, 0.5f, 0.9f}) {
    const float height = heightOfCover(map, cover);
    const auto above = std::count_if(map.heights.begin(), map.heights.end(), [&](float h) { return h > height; });
    EXPECT_NEAR(static_cast<double>(above) / 65536.0, cover, 0.01);
  }
  EXPECT_EQ(heightOfCover(map, 1.0f), 0.0f);
}

}  // namespace
}  // namespace welkin
