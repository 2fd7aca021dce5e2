#include "welkin/base/image.hpp"

#include <cmath>
#include <limits>

#include "welkin/base/error.hpp"

namespace welkin {

double psnr(const Image& a, const Image& b, double peak) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw Error(ErrorKind::badInput, "", "two pictures can only be compared when they have the same size and channels");
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double d = static_cast<double>(a.pixels[i]) - b.pixels[i];
    sum += d * d;
  }
  if (sum == 0) return std::numeric_limits<double>::infinity();
  return 10.0 * std::log10(peak * peak * static_cast<double>(a.pixels.size()) / sum);
}

}  // namespace welkin
