#include "welkin/base/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

Image flat(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    image.pixels[i] = r, image.pixels[i + 1] = g, image.pixels[i + 2] = b;
  return image;
}

Image noise(int width, int height, unsigned seed) {
  Image image(width, height, 3);
  std::mt19937 random(seed);
  for (float& v : image.pixels) v = static_cast<float>(random() % 256) / 255.0f;
  return image;
}

// The paper's equations word for word, in double precision and with filters of two dimensions.
namespace paper {

struct Picture {
  int width, height;
  std::vector<std::array<double, 3>> pixels;
  const std::array<double, 3>& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width + std::clamp(x, 0, width - 1)];
  }
};

constexpr double kM[3][3] = {
    {0.4123908, 0.3575843, 0.1804808}, {0.2126390, 0.7151687, 0.0721923}, {0.0193308, 0.1191948, 0.9505322}};
double white(int i) { return kM[i][0] + kM[i][1] + kM[i][2]; }

std::array<double, 3> xyz(const std::array<double, 3>& rgb) {
  std::array<double, 3> out{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) out[i] += kM[i][k] * rgb[k];
  return out;
}

std::array<double, 3> rgb(const std::array<double, 3>& v) {  // Cramer's rule
  const auto det = [](const double(&m)[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) {
    double m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = j == k ? v[i] : kM[i][j];
    out[k] = det(m) / det(kM);
  }
  return out;
}

std::array<double, 3> hunt(const std::array<double, 3>& linear) {
  const auto f = [](double t) { return t > 0.008856452 ? std::cbrt(t) : 7.787037 * t + 16.0 / 116.0; };
  const auto v = xyz(linear);
  const double x = f(v[0] / white(0)), y = f(v[1]), z = f(v[2] / white(2)), l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

double hyab(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Picture opponent(const Image& image) {
  Picture p{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    std::array<double, 3> linear{};
    for (int k = 0; k < 3; ++k) {
      const double s = image.pixels[i + k];
      linear[k] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    const auto v = xyz(linear);
    const double x = v[0] / white(0), y = v[1], z = v[2] / white(2);
    p.pixels.push_back({116 * y - 16, 500 * (x - y), 200 * (y - z)});
  }
  return p;
}

double csf(int channel, double r2) {
  const double a[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}}, b[3][2] = {{.0047, 1e-5}, {.0053, 1e-5}, {.04, .025}};
  double sum = 0;
  for (int i = 0; i < 2; ++i)
    sum += a[channel][i] * std::sqrt(std::numbers::pi / b[channel][i]) *
           std::exp(-std::numbers::pi * std::numbers::pi * r2 / b[channel][i]);
  return sum;
}

std::array<double, 3> filtered(const Picture& p, int x, int y, double ppd) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(.04 / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) {
    double sum = 0, whole = 0;
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) {
        const double w = csf(k, (i * i + j * j) / (ppd * ppd));
        sum += w * p.at(x + i, y + j)[k];
        whole += w;
      }
    out[k] = sum / whole;
  }
  const double yy = (out[0] + 16) / 116;
  auto linear = rgb({(yy + out[1] / 500) * white(0), yy, (yy - out[2] / 200) * white(2)});
  for (double& v : linear) v = std::clamp(v, 0.0, 1.0);
  return hunt(linear);
}

// order 1: edges, 2: points.
double feature(const Picture& p, int x, int y, double ppd, int order) {
  const double s = .5 * .082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * s));
  double length2 = 0;
  for (const bool vertical : {false, true}) {
    double plus = 0, minus = 0, sumPlus = 0, sumMinus = 0;
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) {
        const double t = vertical ? j : i, g = std::exp(-(i * i + j * j) / (2 * s * s));
        const double w = order == 1 ? -t * g : (t * t / (s * s) - 1) * g;
        const double v = (p.at(x + i, y + j)[0] + 16) / 116;
        (w > 0 ? plus : minus) += std::abs(w);
        (w > 0 ? sumPlus : sumMinus) += w * v;
      }
    length2 += std::pow(sumPlus / plus + sumMinus / minus, 2);
  }
  return std::sqrt(length2);
}

double flip(const Picture& a, const Picture& b, int x, int y, double ppd) {
  const double largest = std::pow(hyab(hunt({0, 1, 0}), hunt({0, 0, 1})), .7);
  const double d = std::pow(hyab(filtered(a, x, y, ppd), filtered(b, x, y, ppd)), .7);
  const double colour =
      d < .4 * largest ? .95 / (.4 * largest) * d : .95 + (d - .4 * largest) / (largest - .4 * largest) * .05;
  double f = 0;
  for (const int order : {1, 2}) f = std::max(f, std::abs(feature(a, x, y, ppd, order) - feature(b, x, y, ppd, order)));
  return std::pow(colour, 1 - std::sqrt(f / std::numbers::sqrt2));
}

}  // namespace paper

TEST(Flip, IsWhatThePaperSaysPixelByPixel) {
  const Image a = noise(13, 9, 1), b = noise(13, 9, 2);
  const paper::Picture pa = paper::opponent(a), pb = paper::opponent(b);
  for (const double ppd : {20.0, 67.0}) {
    const Image map = flipMap(a, b, ppd);
    double differ = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        differ = std::max(differ, std::abs(paper::flip(pa, pb, x, y, ppd) - static_cast<double>(map.at(x, y)[0])));
    EXPECT_LT(differ, 2e-4) << ppd;  // floats: the square root of a feature difference of 1e-7 is 3e-4 at the worst
    EXPECT_GT(meanOf(map), 0.1);
  }
}

TEST(Flip, OfEqualPicturesIsZero) {
  const Image a = noise(40, 30, 3);
  for (const float v : flipMap(a, a).pixels) ASSERT_EQ(v, 0.0f);
}

// Uniform pictures have no features: only the remapped HyAB distance is left. Green (L 87.737, a -86.18, b 83.18) and
// blue (32.297, 79.19, -107.86) span the largest distance; black and white are 100^0.7 apart.
TEST(Flip, OfUniformPicturesIsTheRemappedDistanceOfTheirColours) {
  const Image green = flat(8, 8, 0, 1, 0), blue = flat(8, 8, 0, 0, 1), black = flat(8, 8, 0, 0, 0),
              white = flat(8, 8, 1, 1, 1);
  EXPECT_NEAR(meanOf(flipMap(green, blue)), 1.0, 1e-5);
  const double hunted =
      87.737 - 32.297 + std::hypot(-86.18 * .87737 - 79.19 * .32297, 83.18 * .87737 + 107.86 * .32297);
  const double largest = std::pow(hunted, .7), knee = .4 * largest;
  EXPECT_NEAR(meanOf(flipMap(black, white)), .95 + (std::pow(100.0, .7) - knee) / (largest - knee) * .05, 1e-4);
}

TEST(Flip, IsSymmetricAndMovesWithThePicture) {
  Image a = flat(96, 64, 0.5f, 0.6f, 0.7f), b = a;
  for (const auto& [picture, left] : {std::pair(&a, 30), std::pair(&b, 36)})
    for (int y = 24; y < 40; ++y)
      for (int x = left; x < left + 12; ++x) picture->at(x, y)[0] = 1.0f;
  const Image map = flipMap(a, b), other = flipMap(b, a);
  EXPECT_EQ(map.pixels, other.pixels);
  Image a2 = a, b2 = b;
  for (const auto& [from, to] : {std::pair(&a, &a2), std::pair(&b, &b2)})
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x) std::copy_n(from->at((x + 91) % 96, y), 3, to->at(x, y));
  const Image moved = flipMap(a2, b2);
  for (int y = 0; y < 64; ++y)
    for (int x = 12; x < 84; ++x) ASSERT_NEAR(moved.at(x + 5, y)[0], map.at(x, y)[0], 1e-4) << x << " " << y;
  EXPECT_GT(meanOf(map), 0.001);
}

// What one pixel shows is blurred away for an eye that stands far off.
TEST(Flip, FineNoiseIsLessVisibleFromAfar) {
  const Image a = noise(64, 64, 5), b = noise(64, 64, 6);
  EXPECT_GT(meanOf(flipMap(a, b, 10)), 1.5 * meanOf(flipMap(a, b, 67)));
}

TEST(Flip, RefusesWhatItCannotCompare) {
  EXPECT_THROW(flipMap(Image(3, 3, 3), Image(3, 4, 3)), Error);
  EXPECT_THROW(flipMap(Image(3, 3, 3), Image(3, 3, 3), 0.0), Error);
  EXPECT_THROW(flipMap(Image(3, 3, 3), Image(3, 3, 3), std::nan("")), Error);
}

}  // namespace
}  // namespace welkin
