#include "welkin/base/image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/base/error.hpp"

namespace welkin {

namespace {

std::string shapeOf(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height) + "x" + std::to_string(image.channels);
}

}  // namespace

void requireSameShape(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw Error(ErrorKind::badInput, "",
                "two pictures can only be compared when they have the same size and channels: " + shapeOf(a) +
                    " is not " + shapeOf(b));
}

Image withoutAlpha(const Image& image) {
  if (image.channels == 1 || image.channels == 3) return image;
  Image out(image.width, image.height, image.channels - 1);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = image.pixels[i / out.channels * image.channels + i % out.channels];
  return out;
}

std::vector<std::uint8_t> bytesOf(const Image& values) {
  std::vector<std::uint8_t> bytes(values.pixels.size());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(values.pixels[i], 0.0f, 1.0f)));
  return bytes;
}

double psnr(const Image& a, const Image& b, double peak) {
  requireSameShape(a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double d = static_cast<double>(a.pixels[i]) - b.pixels[i];
    sum += d * d;
  }
  if (sum == 0) return std::numeric_limits<double>::infinity();
  return 10.0 * std::log10(peak * peak * static_cast<double>(a.pixels.size()) / sum);
}

}  // namespace welkin
