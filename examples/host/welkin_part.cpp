#include "welkin_part.hpp"

using namespace welkin::realtime;

static Frame frameOf(const host::Engine& engine, const host::Eye& eye, const host::Target& target, double time) {
  return {.width = target.width,
          .height = target.height,
          .framebuffer = target.colourOnly,
          .view = eye.view(),
          .projection = engine.projection(eye, target),
          .position = eye.position,
          .up = UpAxis::y,
          .background = Background::sky,  // the land is ours
          .depthTexture = target.depth,
          .depthRange = engine.zeroToOne() ? DepthRange::zeroToOne : DepthRange::minusOneToOne,
          .time = time,
          .preExposure = host::Engine::kExposure};
}

Clouds::Clouds(const welkin::Scene& sky) : renderer_(host::getProcAddress) { renderer_.setScene(sky); }

void Clouds::light(std::size_t view, const host::Engine& engine, const host::Eye& eye, const host::Target& target,
                   double time) {
  renderer_.prepare(views_[view], frameOf(engine, eye, target, time));
  renderer_.bindHost(views_[view], engine.landProgram(), {.firstUnit = 0, .uniformBlock = 0});
}

void Clouds::draw(std::size_t view, const host::Engine& engine, const host::Eye& eye, const host::Target& target,
                  double time) {
  renderer_.render(views_[view], frameOf(engine, eye, target, time));
  renderer_.bindHost(views_[view], engine.glassProgram(), {.firstUnit = 0, .uniformBlock = 0});
}
