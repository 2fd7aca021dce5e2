#pragma once
// What stands before the sky and is drawn by somebody else: a land, an aircraft.
#include <functional>

#include "welkin/realtime/renderer.hpp"

namespace welkin::viewer {

class Foreground {
 public:
  virtual ~Foreground() = default;

  // Gives a program what the include for hosts reads, on units 0 to 8 and uniform block 0.
  using Bind = std::function<void(unsigned program)>;

  // Where it draws: a framebuffer of linear light, depth and stencil, and the texture of the latter two.
  struct Target {
    unsigned framebuffer = 0, depth = 0;
  };

  // Of the eye, m/s: rain and snow streak along with it.
  virtual glm::dvec3 velocity() const = 0;
  // Draws opaque surfaces: linear light without clouds, and depth. The target is bound and cleared, depth is near /
  // distance and tested. Positions are relative to the eye, whose place is frame.origin and whose altitude is
  // frame.position.z.
  virtual void drawSurfaces(const realtime::Frame& frame, const Target& target, const Bind& bind) = 0;
  // Draws what one sees through, over the finished sky: premultiplied light, blended; depth is tested, not written.
  virtual void drawGlass(const realtime::Frame& frame, const Bind& bind) = 0;
};

}  // namespace welkin::viewer
