#pragma once
#include <map>
#include <string>
#include <string_view>

#include "welkin/base/image.hpp"

namespace welkin {

enum class ExrPrecision { half, full };
enum class ExrEnvironment { none, latlong, cube };

// Attributes that not every picture has. Standard ones (see openexr.com, "Standard Optional Attributes") unless said
// otherwise.
struct ExrMetadata {
  ExrEnvironment environment = ExrEnvironment::none;
  std::string captureDate{};                // local time, "2026:06:21 12:00:00"; empty for none
  double utcOffset = 0.0;                   // s, civil time less universal time; written with captureDate
  bool placed = false;                      // whether latitude and longitude are written
  double latitude = 0.0;                    // degrees north
  double longitude = 0.0;                   // degrees east
  std::map<std::string, double> numbers{};  // of Welkin's own, written as welkin:NAME
};

// Writes a scanline OpenEXR file, ZIP: linear Rec.709, 1 (Y), 3 (RGB) or 4 (RGBA) channels; its whiteLuminance says
// that 1 is 1000 cd/m^2, its welkin:features what the picture's renderer drew. Values that are not finite, or in half
// precision above 65504, are refused rather than spoilt: Error (badInput). Throws Error (failed) when it cannot be
// written.
void saveExr(const std::string& path, const Image& image, ExrPrecision precision, const ExrMetadata& metadata = {});

// Reads the channels Y, or R, G, B and A, of the first part, and welkin:features. Throws Error (badInput), also for
// pictures of more than 32768 pixels a side or 2^27 in all.
Image loadExr(const std::string& path);
Image parseExr(std::string_view bytes, const std::string& name);

// The version of OpenEXR that Welkin was built with.
std::string exrVersion();

}  // namespace welkin
