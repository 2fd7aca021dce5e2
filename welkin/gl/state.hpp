#pragma once
// Saves the OpenGL state that Welkin's passes touch and puts it back.
#include <array>

#include "welkin/gl/api.hpp"

namespace welkin::gl {

// Records on construction, restores on destruction: program, vertex array, framebuffers, viewport, scissor, colour and
// depth masks, blending, culling, depth, stencil, polygon mode, sRGB writes, active texture, textures and samplers of
// units 0 to 23, uniform buffers 0 to 7 with their ranges, pixel store and pixel buffers. In between the state is what
// full-screen passes need: all tests, blending and culling off, samplers and pixel buffers unbound, pixels tightly
// packed.
class StateGuard {
 public:
  explicit StateGuard(const Api& gl);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  static constexpr int kUnits = 24, kBuffers = 8, kToggles = 9, kStores = 10;
  struct Unit {
    GLint plane, volume, array, sampler;
  };
  struct Buffer {
    GLint name, start, size;
  };
  const Api& gl_;
  GLint program_, vertexArray_, drawFramebuffer_, readFramebuffer_, activeTexture_, uniformBuffer_, packBuffer_,
      unpackBuffer_;
  std::array<GLint, 4> viewport_, scissor_;
  std::array<GLint, 6> blend_;
  std::array<GLint, 2> polygonMode_{};
  std::array<Buffer, kBuffers> buffers_;
  std::array<GLint, kStores> stores_;
  std::array<Unit, kUnits> units_;
  std::array<GLboolean, kToggles> toggles_;
  std::array<GLboolean, 4> colourMask_;
  GLboolean depthMask_;
};

}  // namespace welkin::gl
