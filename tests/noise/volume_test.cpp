// Rounding to half floats: to nearest even, with subnormals and infinities.
#include "welkin/noise/volume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace welkin {
namespace {

TEST(RoundToHalf, ExactValuesStay) {
  for (const float v : {0.0f, 1.0f, -2.5f, 65504.0f, 0x1p-14f, 0x1p-24f, -0x1.8p-20f, 0x1.ffcp-1f})
    EXPECT_EQ(roundedToHalf(v), v) << v;
}

TEST(RoundToHalf, TiesGoToEven) {
  EXPECT_EQ(roundedToHalf(1.0f + 0x1p-11f), 1.0f);                        // between 1 and 1 + 2^-10: even is 1
  EXPECT_EQ(roundedToHalf(1.0f + 0x1.8p-10f), 1.0f + 0x1p-9f);            // odd below, even above
  EXPECT_EQ(roundedToHalf(1.0f + 0x1p-11f + 0x1p-23f), 1.0f + 0x1p-10f);  // just above the tie
  EXPECT_EQ(roundedToHalf(0x1.8p-24f), 0x1p-23f);                         // subnormal tie
  EXPECT_EQ(roundedToHalf(0x1p-25f), 0.0f);
  EXPECT_EQ(roundedToHalf(2047.5f * 0x1p-24f), 2048.0f * 0x1p-24f);
}

TEST(RoundToHalf, LargeValuesAndNan) {
  EXPECT_EQ(roundedToHalf(65519.9f), 65504.0f);
  EXPECT_EQ(roundedToHalf(65520.0f), std::numeric_limits<float>::infinity());
  EXPECT_EQ(roundedToHalf(-1e9f), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(roundedToHalf(std::nanf(""))));
}

TEST(RoundToHalf, IsTheNearestHalf) {
  for (int i = 0; i < 20000; ++i) {
    const float v = std::ldexp(1.0f + static_cast<float>(i % 997) / 997.0f, i % 30 - 20);
    const float ulp = std::ldexp(1.0f, std::max(std::ilogb(v), -14) - 10);
    EXPECT_LE(std::abs(roundedToHalf(v) - v), 0.5f * ulp) << v;
    EXPECT_EQ(std::remainder(roundedToHalf(v), ulp), 0.0f) << v;
  }
}

TEST(RoundToHalf, RoundsEveryTexelOfAVolume) {
  Volume v(2, 1, 1, 2);
  v.texels = {0.1f, 0.2f, 0.3f, 0.4f};
  roundToHalf(v);
  EXPECT_EQ(v.texels, (std::vector<float>{0.0999755859375f, 0.199951171875f, 0.300048828125f, 0.39990234375f}));
}

}  // namespace
}  // namespace welkin
