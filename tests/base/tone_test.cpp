#include "welkin/base/tone.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace welkin {
namespace {

ToneSettings at(ToneCurve curve, float ev = 0.0f) { return {.ev = ev, .curve = curve}; }

// Display value of grey light that exposes the film to `x`.
float shown(ToneCurve curve, float x) {
  return law::toneMap(glm::vec3(x / 1000.0f * 1.2f), toneParameters(at(curve))).x;
}

TEST(Tone, ExposureSaturatesAtTheStandardLuminance) {
  for (const double ev : {0.0, 10.0, 14.6}) {
    const double saturating = 1.2 * std::exp2(ev) / 1000.0;  // kcd/m^2
    EXPECT_NEAR(toneParameters(at(ToneCurve::none, static_cast<float>(ev))).exposure * saturating, 1.0, 1e-5);
  }
}

TEST(Tone, SrgbTransferIsItsOwnInverseMap) {
  for (int i = 0; i <= 255; ++i) {
    const float v = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(law::srgbFromLinear(law::linearFromSrgb(v)), v, 2e-6f);
  }
  EXPECT_NEAR(law::srgbFromLinear(0.21404114f), 0.5f, 1e-6f);  // IEC 61966-2-1
}

TEST(Tone, CurvesRiseFromBlackToWhiteAndKeepGreyGrey) {
  for (const ToneCurve curve : {ToneCurve::agx, ToneCurve::aces, ToneCurve::filmic, ToneCurve::none}) {
    float last = -1.0f;
    for (float x = 1e-4f; x < 100.0f; x *= 1.1f) {
      const float y = shown(curve, x);
      ASSERT_GE(y, last) << static_cast<int>(curve) << " at " << x;
      ASSERT_LE(y, 1.0f);
      last = y;
    }
    EXPECT_LT(shown(curve, 0.0f), 0.02f);
    EXPECT_GT(last, 0.97f);
    const glm::vec3 grey = law::toneMap(glm::vec3(0.0005f), toneParameters(at(curve)));
    EXPECT_NEAR(grey.x, grey.y, 2e-3f);
    EXPECT_NEAR(grey.x, grey.z, 2e-3f);
  }
}

TEST(Tone, PublishedPointsOfTheCurves) {
  EXPECT_NEAR(shown(ToneCurve::none, 0.18f), 0.4613f, 1e-4f);
  EXPECT_NEAR(shown(ToneCurve::agx, 0.18f), law::srgbFromLinear(0.18f), 3e-3f);  // middle grey stays
  EXPECT_NEAR(shown(ToneCurve::filmic, 5.6f), 1.0f, 1e-3f);                      // Hable's white, 11.2 = 2 * 5.6
  // Hill's fit by hand: (1.0245786 - 0.000090537) / (0.983729 + 0.432951 + 0.238081) = 0.619129, times its row sums.
  EXPECT_NEAR(shown(ToneCurve::aces, 1.0f), law::srgbFromLinear(0.619129f), 2e-3f);
}

TEST(Tone, WhiteBalanceLeaves6504KelvinAndWarmsOrCools) {
  const glm::mat3 same = whiteBalanceMatrix(6504);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(same[i][j], i == j ? 1.0f : 0.0f, 1e-5f);
  const glm::vec3 underTungsten = whiteBalanceMatrix(3200) * glm::vec3(1),
                  underShade = whiteBalanceMatrix(9000) * glm::vec3(1);
  EXPECT_GT(underTungsten.z, 1.5f) << "a setting for yellow light makes white light blue";
  EXPECT_GT(underShade.x, underShade.z);
  EXPECT_NEAR(law::luminanceOf(underTungsten), 1.0f, 0.1f);
  const glm::vec3 below = whiteBalanceMatrix(3999.9) * glm::vec3(1), above = whiteBalanceMatrix(4000.1) * glm::vec3(1);
  EXPECT_NEAR(below.z, above.z, 1e-3f) << "no jump where the loci meet";
}

TEST(Tone, SaturationZeroIsGrey) {
  ToneSettings settings = at(ToneCurve::none);
  settings.saturation = 0.0f;
  const glm::vec3 c = law::toneMap({0.0002f, 0.0005f, 0.0008f}, toneParameters(settings));
  EXPECT_NEAR(c.x, c.y, 1e-6f);
  EXPECT_NEAR(c.y, c.z, 1e-6f);
}

TEST(AutomaticEv, MetersAUniformPictureByTheStandard) {
  Image image(20, 10, 3);
  for (float& v : image.pixels) v = 4.0f;  // kcd/m^2
  EXPECT_NEAR(automaticEv(image), std::log2(4000.0 * 100.0 / 12.5), 1e-4);
}

TEST(AutomaticEv, IsNotSwayedByASunOrByBlackOrBrokenPixels) {
  Image image(20, 10, 3);
  for (float& v : image.pixels) v = 4.0f;
  const double plain = automaticEv(image);
  for (int x = 0; x < 10; ++x)
    for (int c = 0; c < 3; ++c) image.at(x, 3)[c] = 1.6e6f;
  for (int x = 0; x < 5; ++x) image.at(x, 7)[0] = image.at(x, 7)[1] = image.at(x, 7)[2] = 0.0f;
  image.at(9, 9)[1] = std::nanf("");
  EXPECT_NEAR(automaticEv(image), plain, 1e-4);
  EXPECT_EQ(automaticEv(Image(4, 4, 3)), 15.0);
}

// A moonlit cloud of .01 cd/m^2: a meter would say EV -3.6; 2.3 stops darker it looks like night. By day nothing is
// taken off, and on the way there nothing jumps.
TEST(AutomaticEv, LeavesTheNightDark) {
  const auto at = [](double luminance) {
    Image image(8, 8, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<float>(luminance / 1000.0));
    return automaticEv(image);
  };
  const auto metered = [](double luminance) { return std::log2(luminance * 100.0 / 12.5); };
  EXPECT_NEAR(at(0.01) - metered(0.01), 2.32, 0.02);
  EXPECT_NEAR(at(1e-4) - metered(1e-4), 2.43, 0.02);
  EXPECT_NEAR(at(1.5), metered(1.5), 1e-4);
  for (double y = 1e-4; y < 10; y *= 1.1) {
    EXPECT_GT(at(1.1 * y), at(y)) << y;
    EXPECT_LT(at(1.1 * y), at(y) + 0.15) << y;
  }
}

TEST(DisplayBytes, DitherKeepsTheMeanAndIsTheSameEachTime) {
  Image image(256, 256, 3);
  const float light = 0.0000305f;
  for (float& v : image.pixels) v = light;
  const auto bytes = displayBytes(image, at(ToneCurve::none));
  EXPECT_EQ(bytes, displayBytes(image, at(ToneCurve::none)));
  double sum = 0;
  for (const std::uint8_t b : bytes) sum += b;
  const double exact = 255.0 * law::srgbFromLinear(light * 1000.0f / 1.2f);
  EXPECT_NEAR(sum / static_cast<double>(bytes.size()), exact, 0.01);
}

TEST(DisplayBytes, BrokenPixelsAreBlackAndAlphaIsKept) {
  Image image(1, 1, 4);
  image.pixels = {std::nanf(""), std::nanf(""), std::nanf(""), 1.0f};
  const auto bytes = displayBytes(image, at(ToneCurve::none));
  EXPECT_EQ(bytes[0], 0);
  EXPECT_EQ(bytes[3], 255);
}

}  // namespace
}  // namespace welkin
