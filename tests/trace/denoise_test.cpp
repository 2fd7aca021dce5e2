// The denoiser on pictures whose truth is known: layers made of samples as the tracer makes them.
#include "welkin/trace/denoise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "welkin/base/error.hpp"

namespace welkin::trace {
namespace {

constexpr int kWidth = 96, kHeight = 64, kSamples = 32;
constexpr int kRare = 3000;       // one path in so many finds the sun
constexpr double kFound = 150.0;  // and is brighter by this factor
constexpr double kSpread = 1.0;   // of the other paths, relative

TraceLayers emptyLayers() {
  const Image one(kWidth, kHeight, 1), three(kWidth, kHeight, 3);
  return {three, one, three, three, one, one, one};
}

// Light is that of the usual paths; of it come kSamples with noise, of them few with spikes where `spiky`.
TraceLayers tracedOf(const std::function<double(int, int)>& light, bool spiky) {
  TraceLayers layers = emptyLayers();
  std::mt19937 random(7);
  std::normal_distribution<double> normal(1.0, kSpread);
  std::uniform_int_distribution<int> rare(1, kRare);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0.0, square = 0.0;
      for (int i = 0; i < kSamples; ++i) {
        const double s = light(x, y) * (spiky && rare(random) == 1 ? kFound : normal(random));
        sum += s;
        square += s * s;
      }
      const double mean = sum / kSamples;
      for (int c = 0; c < 3; ++c) layers.radiance.at(x, y)[c] = static_cast<float>(mean);
      *layers.variance.at(x, y) = static_cast<float>((square / kSamples - mean * mean) / (kSamples - 1));
      *layers.samples.at(x, y) = kSamples;
      *layers.depth.at(x, y) = 1000.0f;
    }
  return layers;
}

double squaredError(const Image& image, const std::function<double(int, int)>& truth) {
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) sum += std::pow(image.at(x, y)[0] - truth(x, y), 2);
  return sum;
}

double meanOf(const Image& image, int firstColumn, int endColumn) {
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = firstColumn; x < endColumn; ++x) sum += image.at(x, y)[0];
  return sum / (kHeight * (endColumn - firstColumn));
}

double stepAt48(int x, int) { return x < 48 ? 10.0 : 2.0; }

TEST(Denoise, LeavesACleanPictureAsItIs) {
  TraceLayers layers = tracedOf([](int x, int y) { return 3.0 + std::sin(0.1 * x * y); }, false);
  std::fill(layers.variance.pixels.begin(), layers.variance.pixels.end(), 0.0f);
  EXPECT_EQ(denoise(layers).pixels, layers.radiance.pixels);
}

// Clean are those whose 5 x 5 neighbours are so too.
TEST(Denoise, LeavesCleanPixelsOfANoisyPictureAsTheyAre) {
  TraceLayers layers = tracedOf(stepAt48, false);
  for (int y = 0; y < kHeight; ++y) std::fill_n(layers.variance.at(18, y), 5, 0.0f);
  const Image out = denoise(layers);
  for (int y = 0; y < kHeight; ++y) {
    EXPECT_EQ(out.at(20, y)[0], layers.radiance.at(20, y)[0]);
    EXPECT_NE(out.at(23, y)[0], layers.radiance.at(23, y)[0]);
  }
}

// A few samples that happen to agree, on too little light, are noise as everything around them: neither their error nor
// any of it may stay as a speck. The standard error of a pixel is 1.8 before
// denoising and at most a quarter of it after; allowed are three.
TEST(Denoise, SmoothsPixelsWhoseSamplesHappenToAgree) {
  TraceLayers layers = tracedOf([](int, int) { return 10.0; }, false);
  for (int y = 8; y < kHeight; y += 16)
    for (int x = 8; x < kWidth; x += 16) {
      std::fill_n(layers.radiance.at(x, y), 3, 6.4f);
      *layers.variance.at(x, y) = 0.0f;
    }
  const Image out = denoise(layers);
  for (int y = 8; y < kHeight; y += 16)
    for (int x = 8; x < kWidth; x += 16) EXPECT_NEAR(out.at(x, y)[0], 10.0, 1.35) << x << ' ' << y;
}

// A sixteenth of the squared error is what sixteen times the paths would give: 64 that look like a reference of 1024.
TEST(Denoise, IsWorthSixteenTimesThePaths) {
  const TraceLayers layers = tracedOf(stepAt48, false);
  EXPECT_LT(squaredError(denoise(layers), stepAt48), squaredError(layers.radiance, stepAt48) / 16.0);
}

TEST(Denoise, SpreadsSpikesAndKeepsTheirLight) {
  const auto truth = [](int x, int y) { return stepAt48(x, y) * (1.0 + (kFound - 1.0) / kRare); };
  const TraceLayers layers = tracedOf(stepAt48, true);
  const Image out = denoise(layers);
  EXPECT_LT(squaredError(out, truth), squaredError(layers.radiance, truth) / 16.0);

  // Cut off, the spikes would take 5 % of the light with them; 2 % is what an eye can tell (Weber).
  EXPECT_NEAR(meanOf(out, 0, kWidth) / meanOf(layers.radiance, 0, kWidth), 1.0, 0.02);
}

// One path of 32 that is 1200 times as bright as the others: spread, it raises the 17 x 17 pixels around it by up
// to 13 % (1200 / 32 of 289); dimmed, it leaves nothing that an eye could tell (Weber's 2 %).
TEST(Denoise, DimsSpikesThatWouldBeDiscs) {
  TraceLayers layers = tracedOf([](int, int) { return 10.0; }, false);
  const float excess = 10.0f * 1200.0f / kSamples;
  std::fill_n(layers.radiance.at(48, 32), 3, 10.0f + excess);
  *layers.variance.at(48, 32) = excess * excess;
  const auto square = [](const Image& image) {
    double sum = 0.0;
    for (int y = 24; y <= 40; ++y)
      for (int x = 40; x <= 56; ++x) sum += image.at(x, y)[0];
    return sum / (17 * 17);
  };
  EXPECT_GT(square(denoise(layers)), 10.6);
  EXPECT_NEAR(square(denoise(layers, Outliers::dimmed)), 10.0, 0.2);
}

// What is spread fades like a soft spot: between neighbours it falls by a fifth of its height; a window that kept its
// weight to near its edge fell by .3 and drew discs, one with edges ends at once.
TEST(Denoise, SpreadsWithoutAnEdge) {
  TraceLayers layers = tracedOf([](int, int) { return 10.0; }, false);
  const float excess = 10.0f * 1200.0f / kSamples;
  std::fill_n(layers.radiance.at(48, 32), 3, 10.0f + excess);
  *layers.variance.at(48, 32) = excess * excess;
  const Image with = denoise(layers);
  std::fill_n(layers.radiance.at(48, 32), 3, 10.0f);
  *layers.variance.at(48, 32) = *layers.variance.at(47, 32);
  const Image without = denoise(layers);
  const auto raised = [&](int x) { return with.at(x, 32)[0] - without.at(x, 32)[0]; };
  float most = 0.0f, edge = 0.0f;
  for (int x = 30; x < 66; ++x) {
    most = std::max(most, raised(x));
    edge = std::max(edge, std::abs(raised(x + 1) - raised(x)));
  }
  EXPECT_GT(most, 0.3f);
  EXPECT_LT(edge, 0.25f * most);
}

// Twelve pixels in a thousand hold a bright path, alone or beside another. None stays a speck, brighter by a tenth
// than everything around it; with their own noise kept at full weight twelve did.
TEST(Denoise, LeavesNoSpecks) {
  const TraceLayers layers = tracedOf(stepAt48, true);
  const auto specks = [](const Image& image) {
    int count = 0;
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        float around = 0.0f;
        for (int k = 0; k < 9; ++k)
          if (k != 4) around = std::max(around, image.at(x - 1 + k % 3, y - 1 + k / 3)[0]);
        count += image.at(x, y)[0] > 1.1f * around;
      }
    return count;
  };
  ASSERT_GT(specks(layers.radiance), 50);
  EXPECT_EQ(specks(denoise(layers)), 0);
}

// The columns beside the step are right to 3 % of it: a blur over three pixels would be wrong by 33 %, and the standard
// error of a column is 0.22 before denoising.
TEST(Denoise, KeepsAStep) {
  const Image out = denoise(tracedOf(stepAt48, false));
  EXPECT_NEAR(meanOf(out, 47, 48), 10.0, 0.03 * 8.0);
  EXPECT_NEAR(meanOf(out, 48, 49), 2.0, 0.03 * 8.0);
}

// A step of half the noise cannot be told from it by the light alone: most of it is smoothed away. With a feature it is
// right to two standard errors, 0.2 each, of the columns' difference before denoising.
TEST(Denoise, KeepsAFaintStepWhereTransmittanceOrDepthTells) {
  const TraceLayers layers = tracedOf([](int x, int) { return x < 48 ? 10.0 : 9.0; }, false);
  const auto contrast = [](const TraceLayers& traced) {
    const Image out = denoise(traced);
    return meanOf(out, 46, 48) - meanOf(out, 48, 50);
  };
  TraceLayers cloud = layers, far = layers;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 48; x < kWidth; ++x) {
      *cloud.transmittance.at(x, y) = 1.0f;
      *far.depth.at(x, y) = 3000.0f;
    }
  EXPECT_LT(contrast(layers), 0.5);
  EXPECT_NEAR(contrast(cloud), 1.0, 0.4);
  EXPECT_NEAR(contrast(far), 1.0, 0.4);
}

TEST(Denoise, KeepsWhatIsBrightForCertain) {
  TraceLayers layers = tracedOf(stepAt48, false);
  std::fill_n(layers.radiance.at(30, 30), 3, 5000.0f);
  *layers.variance.at(30, 30) = 500.0f * 500.0f;
  const Image out = denoise(layers);
  EXPECT_GT(out.at(30, 30)[0], 4900.0f);
  EXPECT_LT(out.at(31, 30)[0], 15.0f);
}

// An interrupted picture: 16 x 16 pixels have nothing yet.
TEST(Denoise, PixelsWithoutSamplesStayBlackAndSpreadNothing) {
  TraceLayers layers = tracedOf([](int, int) { return 10.0; }, false);
  for (int y = 16; y < 32; ++y)
    for (int x = 16; x < 32; ++x) {
      std::fill_n(layers.radiance.at(x, y), 3, 0.0f);
      for (Image* layer : {&layers.variance, &layers.samples, &layers.depth}) *layer->at(x, y) = 0.0f;
    }
  const Image out = denoise(layers);
  double border = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool empty = x >= 16 && x < 32 && y >= 16 && y < 32;
      ASSERT_TRUE(std::isfinite(out.at(x, y)[0]));
      EXPECT_EQ(out.at(x, y)[0] == 0.0f, empty);
      if (x == 15 && y >= 16 && y < 32) border += out.at(x, y)[0] / 16.0;
    }
  EXPECT_NEAR(border, 10.0, 0.5);  // without a bias of the standard error of one pixel, 1.8, or towards black
}

TEST(Denoise, RefusesLayersOfDifferentSizes) {
  TraceLayers layers = emptyLayers();
  layers.variance = Image(8, 8, 1);
  EXPECT_THROW(denoise(layers), Error);
}

}  // namespace
}  // namespace welkin::trace
