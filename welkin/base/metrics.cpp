#include "welkin/base/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "welkin/base/law_tone.hpp"

namespace welkin {

namespace {

int colourCount(const Image& image) { return image.channels < 3 ? 1 : 3; }

}  // namespace

double meanLuminance(const Image& image) {
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float* c = image.pixels.data() + i * image.channels;
    sum += colourCount(image) == 1 ? c[0] : law::luminanceOf({c[0], c[1], c[2]});
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

double relMse(const Image& reference, const Image& test) {
  requireSameShape(reference, test);
  const std::size_t count = static_cast<std::size_t>(reference.width) * reference.height;
  const int colours = colourCount(reference);
  const double mean = meanLuminance(reference), epsilon = 0.01 * mean * mean;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < colours; ++k) {
      const double r = reference.pixels[i * reference.channels + k];
      const double d = test.pixels[i * reference.channels + k] - r;
      if (d != 0) sum += d * d / (r * r + epsilon);
    }
  return count == 0 ? 0.0 : sum / (static_cast<double>(count) * colours);
}

Image heatMap(const Image& map) {
  Image out(map.width, map.height, 3);
  for (std::size_t i = 0; i < static_cast<std::size_t>(map.width) * map.height; ++i) {
    const double x = std::clamp(static_cast<double>(map.pixels[i * map.channels]), 0.0, 1.0);
    const double angle = 2.0 * std::numbers::pi * (0.5 / 3.0 + 1.0 - 1.5 * x), amplitude = 0.5 * x * (1.0 - x);
    const double c = std::cos(angle), s = std::sin(angle);
    const double rgb[] = {x + amplitude * (-0.14861 * c + 1.78277 * s), x + amplitude * (-0.29227 * c - 0.90649 * s),
                          x + amplitude * (1.97294 * c)};
    for (int k = 0; k < 3; ++k) out.pixels[i * 3 + k] = static_cast<float>(std::clamp(rgb[k], 0.0, 1.0));
  }
  return out;
}

}  // namespace welkin
