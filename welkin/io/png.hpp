#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "welkin/base/image.hpp"

namespace welkin {

// Reads a PNG of 8 or 16 bits, grey, RGB or palette, with or without alpha: 1 to 4 channels with values in [0, 1], as
// stored (no transfer curve is undone), and the text "welkin:features". Throws Error (badInput) for anything that is
// not a whole PNG of at most 16384 pixels a side and 2^26 pixels in all.
Image loadPng(const std::string& path);
Image parsePng(std::string_view bytes, const std::string& name);

// Writes 8-bit samples, rows from the top, 1 to 4 interleaved channels; marked as sRGB. `features`: see Image; kept as
// the text "welkin:features". Throws Error (failed).
void savePng(const std::string& path, int width, int height, int channels, std::span<const std::uint8_t> samples,
             const std::string& features = "");
// The same with 16 bits a sample, unmarked: for data such as weather maps.
void savePng16(const std::string& path, int width, int height, int channels, std::span<const std::uint16_t> samples);

// The version of libpng in use.
std::string pngVersion();

}  // namespace welkin
