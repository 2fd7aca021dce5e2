#include "apps/viewer/picture/thumbnails.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/gl/state.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/realtime/offscreen.hpp"

namespace welkin::viewer {

namespace {

struct Drawn {
  std::size_t index = 0;
  std::vector<std::uint8_t> rgba;
  std::string trouble;
};

// Whatever the sky asks for, a thumbnail is done in a moment.
Scene madeSmall(Scene scene) {
  scene.quality = qualityPreset(QualityPreset::low);
  scene.quality.historyScale = 1;
  scene.quality.interleave = 2;
  return scene;
}

std::vector<std::uint8_t> shown(const Image& light, const Film& film) {
  const double ev = film.exposure == ExposureMode::automatic ? automaticEv(light) : film.ev;
  const std::vector<std::uint8_t> rgb = displayBytes(light, {.ev = static_cast<float>(ev) - film.compensation,
                                                             .whiteBalance = film.whiteBalance,
                                                             .saturation = film.saturation,
                                                             .curve = film.tone});
  std::vector<std::uint8_t> rgba;
  rgba.reserve(rgb.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
  return rgba;
}

}  // namespace

struct Thumbnails::State {
  std::vector<std::string> files;
  std::function<realtime::CustomTextures(const Scene&)> loadTextures;
  std::vector<gl::Texture> textures;
  std::vector<std::string> troubles;
  std::size_t collected = 0;
  std::mutex mutex;
  std::vector<Drawn> ready;  // guarded by the mutex
  std::atomic<bool> stop{false};
  bool started = false;
  std::thread thread;

  void hand(Drawn drawn) {
    const std::lock_guard lock(mutex);
    ready.push_back(std::move(drawn));
  }

  void drawOne(realtime::Offscreen& screen, std::size_t index) {
    const Scene scene = madeSmall(loadSky(files[index]));
    screen.renderer().setScene(scene, loadTextures(scene));
    screen.view().reset();
    constexpr int kFrames = 12;
    for (int i = 0; i < kFrames && !stop; ++i) {
      screen.draw(scene, scene.time);
      screen.finish();
    }
    if (!stop) hand({index, shown(screen.read(), scene.film), ""});
  }

  void drawAll() {
    // The picture in the window goes first: this thread, and those that its driver starts, take what is left.
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 15);
    std::size_t index = 0;
    std::string trouble;
    try {
      realtime::Offscreen screen(kWidth, kHeight);
      for (; index < files.size() && !stop; ++index) try {
          drawOne(screen, index);
        } catch (const Error& e) {
          hand({index, {}, e.what()});
        }
    } catch (const std::exception& e) {
      trouble = e.what();
    }
    for (; index < files.size() && !stop; ++index) hand({index, {}, trouble});
  }
};

Thumbnails::Thumbnails(std::vector<std::string> files,
                       std::function<realtime::CustomTextures(const Scene&)> loadTextures)
    : state_(std::make_unique<State>()) {
  state_->textures.resize(files.size());
  state_->troubles.resize(files.size());
  state_->files = std::move(files);
  state_->loadTextures = std::move(loadTextures);
}

Thumbnails::~Thumbnails() {
  state_->stop = true;
  if (state_->thread.joinable()) state_->thread.join();
}

void Thumbnails::start() {
  if (state_->started) return;
  state_->started = true;
  state_->thread = std::thread([state = state_.get()] { state->drawAll(); });
}

bool Thumbnails::collect(const gl::Api& gl) {
  State& s = *state_;
  std::vector<Drawn> ready;
  {
    const std::lock_guard lock(s.mutex);
    std::swap(ready, s.ready);
  }
  if (ready.empty()) return false;
  const gl::StateGuard guard(gl);
  for (Drawn& d : ready) {
    ++s.collected;
    s.troubles[d.index] = std::move(d.trouble);
    if (!d.rgba.empty())
      s.textures[d.index] = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba8, kWidth, kHeight, 0,
                                        gl::Filter::linear, gl::Addressing::clamp, d.rgba.data());
  }
  return true;
}

unsigned Thumbnails::texture(std::size_t index) const {
  return state_->textures[index] ? state_->textures[index].id() : 0;
}
const std::string& Thumbnails::trouble(std::size_t index) const { return state_->troubles[index]; }
bool Thumbnails::complete() const { return !state_->started || state_->collected == state_->files.size(); }

}  // namespace welkin::viewer
