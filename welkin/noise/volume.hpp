#pragma once
// Texels on the CPU: what generators make, files hold and textures are uploaded from.
#include <cstddef>
#include <vector>

#include "welkin/base/sampler.hpp"

namespace welkin {

// A 3D texture, or a plane when depth is 1: 1 to 4 channels interleaved, x fastest. A generator of one's own is any
// function that answers a Volume.
struct Volume {
  int width = 0, height = 0, depth = 1, channels = 1;
  std::vector<float> texels;

  Volume() = default;
  Volume(int w, int h, int d, int c)
      : width(w), height(h), depth(d), channels(c), texels(static_cast<std::size_t>(w) * h * d * c) {}
  const float* at(int x, int y, int z) const {
    return texels.data() + ((static_cast<std::size_t>(z) * height + y) * width + x) * channels;
  }
  // For the law's samplers, repeating on every axis; valid while the volume lives unchanged.
  TextureView view() const { return {texels.data(), width, height, depth, channels, Wrap::repeat, Wrap::repeat}; }
};

// The value that a half float holds after rounding to nearest even, as a float; infinite beyond 65504.
float roundedToHalf(float value);

// Rounds every texel so: what a half float texture of the volume holds.
void roundToHalf(Volume& volume);

}  // namespace welkin
