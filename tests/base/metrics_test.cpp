#include "welkin/base/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

Image flat(float value) {
  Image image(4, 3, 3);
  for (float& v : image.pixels) v = value;
  return image;
}

TEST(Metrics, RelMseOfAUniformErrorFollowsItsFormula) {
  EXPECT_EQ(relMse(flat(2.0f), flat(2.0f)), 0.0);
  // (0.2)^2 / (4 + 0.01 * 4)
  EXPECT_NEAR(relMse(flat(2.0f), flat(2.2f)), 0.04 / 4.04, 1e-8);
}

TEST(Metrics, RelMseKnowsNoUnits) {
  Image a = flat(1.0f), b = a;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    a.pixels[i] = static_cast<float>(i % 5);
    b.pixels[i] = a.pixels[i] + 0.25f * static_cast<float>(i % 3);
  }
  const double before = relMse(a, b);
  for (float& v : a.pixels) v *= 1024.0f;
  for (float& v : b.pixels) v *= 1024.0f;
  EXPECT_NEAR(relMse(a, b), before, 1e-12);
  EXPECT_GT(before, 0.0);
}

TEST(Metrics, AlphaDoesNotCount) {
  Image a(2, 2, 4), b(2, 2, 4);
  for (std::size_t i = 0; i < 16; ++i) a.pixels[i] = b.pixels[i] = 1.0f;
  b.pixels[3] = 0.0f;
  EXPECT_EQ(relMse(a, b), 0.0);
}

TEST(Metrics, ABlackReferenceIsNoReference) {
  EXPECT_TRUE(std::isinf(relMse(flat(0.0f), flat(1.0f))));
  EXPECT_EQ(relMse(flat(0.0f), flat(0.0f)), 0.0);
}

TEST(Metrics, MeanLuminanceWeighsTheColours) {
  Image green(3, 2, 3);
  for (int x = 0; x < 3; ++x) green.at(x, 0)[1] = 2.0f;
  EXPECT_NEAR(meanLuminance(green), 0.7152, 1e-6);
  EXPECT_EQ(meanLuminance(Image()), 0.0);
}

// The order of values must be seen in the picture: luma rises all the way.
TEST(Metrics, HeatMapsGrowLighter) {
  Image ramp(256, 1, 1);
  for (int i = 0; i < 256; ++i) ramp.pixels[i] = static_cast<float>(i) / 255.0f;
  const Image map = heatMap(ramp);
  double before = -1.0;
  for (int i = 0; i < 256; ++i) {
    const float* c = map.at(i, 0);
    const double luma = 0.30 * c[0] + 0.59 * c[1] + 0.11 * c[2];
    EXPECT_GT(luma, before) << i;
    before = luma;
  }
  EXPECT_EQ(map.at(0, 0)[1], 0.0f);
  EXPECT_EQ(map.at(255, 0)[1], 1.0f);
}

}  // namespace
}  // namespace welkin
