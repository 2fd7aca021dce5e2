#pragma once
// A context, a renderer and a float target in one: pictures without a window.
#include <memory>

#include "welkin/base/image.hpp"
#include "welkin/realtime/renderer.hpp"

namespace welkin::realtime {

class Offscreen {
 public:
  // Throws Error (noOpenGl) when the system offers no context.
  Offscreen(int width, int height);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  Renderer& renderer();
  View& view();
  // Draws one frame of the scene's camera at this time into the target.
  void draw(const Scene& scene, double time);
  void draw(Frame frame);
  // The target: linear RGB in kcd/m^2, top row first. Waits for the driver.
  Image read() const;
  void finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::realtime
