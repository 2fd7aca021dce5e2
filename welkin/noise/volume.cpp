#include "welkin/noise/volume.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace welkin {

float roundedToHalf(float value) {
  const float size = std::abs(value);
  if (!(size < 65520.0f))
    return std::isnan(value) ? value : std::copysign(std::numeric_limits<float>::infinity(), value);
  // Below 2^-14 halves are multiples of 2^-24, which is how far apart floats from .5 to 1 are.
  if (size < 0x1p-14f) return std::copysign((size + 0.5f) - 0.5f, value);
  std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  bits += 0xFFFu + ((bits >> 13) & 1u);
  return std::bit_cast<float>(bits & ~0x1FFFu);
}

void roundToHalf(Volume& volume) {
  for (float& t : volume.texels) t = roundedToHalf(t);
}

}  // namespace welkin
