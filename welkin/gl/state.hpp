#pragma once
// Saves the OpenGL state that Welkin's passes touch and puts it back.
#include <array>

#include "welkin/gl/api.hpp"

namespace welkin::gl {

// Records on construction, restores on destruction: program, vertex array, framebuffers, viewport, scissor, colour and
// depth masks, blending, culling, depth, stencil, polygon mode, sRGB writes, active texture, textures and samplers of
// units 0 to 15, uniform buffers 0 to 7, unpack alignment. In between the state is what full-screen passes need: all
// tests, blending and culling off, samplers unbound.
class StateGuard {
 public:
  explicit StateGuard(const Api& gl);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  static constexpr int kUnits = 16, kBuffers = 8, kToggles = 9;
  struct Unit {
    GLint plane, volume, array, sampler;
  };
  const Api& gl_;
  GLint program_, vertexArray_, drawFramebuffer_, readFramebuffer_, activeTexture_, uniformBuffer_, unpackAlignment_;
  std::array<GLint, 4> viewport_, scissor_;
  std::array<GLint, 6> blend_;
  std::array<GLint, 2> polygonMode_{};
  std::array<GLint, kBuffers> buffers_;
  std::array<Unit, kUnits> units_;
  std::array<GLboolean, kToggles> toggles_;
  std::array<GLboolean, 4> colourMask_;
  GLboolean depthMask_;
};

}  // namespace welkin::gl
