#pragma once
#include <string>

#include "welkin/base/image.hpp"

namespace welkin {

enum class ExrPrecision { half, full };

// Writes a scanline OpenEXR file, ZIP: linear Rec.709, 1 (Y), 3 (RGB) or 4 (RGBA) channels; its whiteLuminance says
// that 1 is 1000 cd/m^2. Values that are not finite, or in half precision above 65504, are refused rather than spoilt:
// Error (badInput). Throws Error (failed) when it cannot be written.
void saveExr(const std::string& path, const Image& image, ExrPrecision precision);

// Reads the channels Y, or R, G, B and A, of the first part. Throws Error (badInput).
Image loadExr(const std::string& path);

// The version of OpenEXR that Welkin was built with.
std::string exrVersion();

}  // namespace welkin
