#pragma once
// What a texture unit is to the law's C++ readings: a view of texels and an addressing mode.
#include <cstdint>

namespace welkin {

enum class Wrap : std::int32_t { repeat, clamp };

// A view of a 2D texture, a stack of 2D textures (`depth` layers) or a 3D texture with 1 to 4 float channels, x
// fastest, channels interleaved. Filtering is linear, texel centres at (i + 1/2) / size, as OpenGL's GL_LINEAR.
// `wrap` holds for x and y, and for z of a volume; the layers of a stack are not filtered across.
struct TextureView {
  const float* texels = nullptr;
  std::int32_t width = 0, height = 0, depth = 1, channels = 1;
  Wrap wrap = Wrap::repeat;
  Wrap wrapY = Wrap::repeat;
};

}  // namespace welkin
