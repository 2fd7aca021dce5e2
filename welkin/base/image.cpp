#include "welkin/base/image.hpp"

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
