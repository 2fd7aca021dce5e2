#pragma once
// Radiance pictures (.hdr, .pic): RGBE of G. Ward, "Real Pixels" (Graphics Gems II, 1991), 8 bits of mantissa a channel
// with an exponent in common.
#include <string>
#include <string_view>

#include "welkin/base/image.hpp"

namespace welkin {

// Writes a picture of 1 or 3 channels, rows from the top, run-length encoded. Each value is kept to 1/256 of the
// pixel's largest channel; negative ones become 0. Values that are not finite, or above 1e38, are refused: Error
// (badInput). Throws Error (failed) when it cannot be written.
void saveHdr(const std::string& path, const Image& image);

// Reads a picture of 3 channels: flat or run-length encoded RGBE, rows from the top. Throws Error (badInput), also for
// other orientations, for XYZE and for more than 2^27 pixels.
Image loadHdr(const std::string& path);
Image parseHdr(std::string_view bytes, const std::string& name);

}  // namespace welkin
