#pragma once
// A context of either kind with a renderer and a float target: what the picture tests draw on.
#include <memory>

#include "welkin/base/image.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/renderer.hpp"

namespace welkin::realtime::test {

constexpr int kWidth = 64, kHeight = 36;  // of small pictures

class Stage {
 public:
  Stage(int width, int height, gl::ContextKind kind = gl::ContextKind::desktop);

  // Sets the scene and draws `frames` of its camera into a target cleared to `clear`; RGBA, top row first.
  Image draw(const Scene& scene, int frames = 1, double time = 0.0);
  Image draw(View& view, Frame frame, const glm::vec4& clear = glm::vec4(0.0f));
  // The scene's camera over this target.
  Frame frame(const Scene& scene) const;
  // A depth texture that holds `texels`, bottom row first, as large as the target.
  gl::Texture depth(const std::vector<float>& texels) const;

  gl::Context context;
  gl::Api gl;
  std::unique_ptr<Renderer> sky;
  View view;

 private:
  gl::Texture target_;
  gl::Framebuffer framebuffer_;
  GLint name_ = 0;
};

// A sky with the given shape whose picture needs no history: full resolution, one ray a pixel, no jitter. Its noise and
// weather are small, so that a test spends its time on rays.
Scene plainScene(LayerShape shape);

// Smaller noise textures and clip levels for any scene.
void makeSmall(Scene& scene);

// Tone-mapped with the scene's default film, values in [0, 1].
Image displayed(const Image& light);
double displayedPsnr(const Image& a, const Image& b);

struct Statistics {
  double mean = 0.0, deviation = 0.0, least = 0.0, most = 0.0;
  bool finite = true;
};
// Of all colour channels together.
Statistics statistics(const Image& light);
// Mean of |right neighbour - pixel| over the mean of the pixels, of the green channel.
double roughness(const Image& light);

}  // namespace welkin::realtime::test
