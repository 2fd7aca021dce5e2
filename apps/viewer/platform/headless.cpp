// A picture in memory in place of a window.
#include <chrono>
#include <thread>

#include "apps/viewer/platform/platform.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::viewer {

namespace {

class Headless final : public Platform {
 public:
  explicit Headless(const WindowOptions& options) : gl_(gl::loadApi(context_.loader())), target_(gl_) {
    make(options.width, options.height);
  }

  const gl::Loader& loader() const override { return context_.loader(); }
  unsigned framebuffer() const override { return static_cast<unsigned>(name_); }
  int width() const override { return colour_.width(); }
  int height() const override { return colour_.height(); }
  std::vector<Event> poll(int milliseconds) override {
    if (events_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    std::vector<Event> events;
    std::swap(events, events_);
    return events;
  }
  void resize(int width, int height) override {
    make(width, height);
    events_.push_back({.kind = EventKind::resize, .x = static_cast<float>(width), .y = static_cast<float>(height)});
  }
  void present() override { gl_.Finish(); }
  void setTitle(const std::string& /*title*/) override {}
  void setClipboard(const std::string& text) override { clipboard_ = text; }
  std::string clipboard() override { return clipboard_; }

 private:
  void make(int width, int height) {
    colour_ = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba8, width, height, 0, gl::Filter::nearest,
                          gl::Addressing::clamp, nullptr);
    const gl::Texture* targets[] = {&colour_};
    target_.target(targets);
    gl_.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name_);
  }

  gl::Context context_;
  gl::Api gl_;
  gl::Texture colour_;
  gl::Framebuffer target_;
  GLint name_ = 0;
  std::vector<Event> events_;
  std::string clipboard_;
};

}  // namespace

std::unique_ptr<Platform> openHeadless(const WindowOptions& options) { return std::make_unique<Headless>(options); }

}  // namespace welkin::viewer
