#include "welkin/realtime/offscreen.hpp"

#include <algorithm>

#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/frame_params.hpp"

namespace welkin::realtime {

struct Offscreen::State {
  gl::Context context;
  gl::Api gl;
  gl::Texture target;
  gl::Framebuffer framebuffer;
  GLint name = 0;
  Renderer renderer;
  View view;

  State(int width, int height)
      : gl(gl::loadApi(context.loader())), target(gl, gl::Texture::Kind::plane, gl::kRgba32F, width, height, 0,
                                                  gl::Filter::nearest, gl::Addressing::clamp, nullptr),
        framebuffer(gl), renderer(context.loader()) {
    const gl::Texture* targets[] = {&target};
    framebuffer.target(targets);
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name);
  }
};

Offscreen::Offscreen(int width, int height) : state_(std::make_unique<State>(width, height)) {}
Offscreen::~Offscreen() = default;
Renderer& Offscreen::renderer() { return state_->renderer; }
View& Offscreen::view() { return state_->view; }

void Offscreen::draw(const Scene& scene, double time) {
  Frame frame = frameOf(scene.camera, state_->target.width(), state_->target.height());
  frame.time = time;
  draw(frame);
}

void Offscreen::draw(Frame frame) {
  frame.framebuffer = static_cast<unsigned>(state_->name);
  state_->gl.BindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
  state_->gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  state_->gl.Clear(GL_COLOR_BUFFER_BIT);
  state_->renderer.render(state_->view, frame);
}

void Offscreen::finish() const { state_->gl.Finish(); }

Image Offscreen::read() const {
  const int width = state_->target.width(), height = state_->target.height();
  std::vector<float> rgba(static_cast<std::size_t>(width) * height * 4);
  state_->gl.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(state_->name));
  state_->gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  state_->gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
  state_->gl.check("reading a picture back");
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::copy_n(rgba.data() + (static_cast<std::size_t>(height - 1 - y) * width + x) * 4, 3, image.at(x, y));
  return image;
}

}  // namespace welkin::realtime
