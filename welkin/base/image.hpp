#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace welkin {

// The attribute of picture files that holds Image::features.
inline constexpr const char* kFeaturesAttribute = "welkin:features";

// A picture: rows from top to bottom, channels interleaved, linear floats unless said otherwise.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<float> pixels;
  // What its renderer drew, as sorted words with commas between them ("clouds,sheets"); empty when nobody has said.
  std::string features;

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), pixels(static_cast<std::size_t>(w) * h * c) {}
  float* at(int x, int y) { return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels; }
  const float* at(int x, int y) const { return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels; }
};

// Refuses two pictures of different width, height or channels: Error (badInput).
void requireSameShape(const Image& a, const Image& b);

// The colours of a picture, a last channel of 2 or 4 left out.
Image withoutAlpha(const Image& image);

// Values in [0, 1] as bytes; what lies outside is clamped. NaN must not come.
std::vector<std::uint8_t> bytesOf(const Image& values);

// Peak signal-to-noise ratio in dB of two pictures of the same shape with values in [0, peak]; infinite when equal.
double psnr(const Image& a, const Image& b, double peak = 1.0);

}  // namespace welkin
