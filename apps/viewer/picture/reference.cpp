#include "apps/viewer/picture/reference.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "welkin/base/error.hpp"
#include "welkin/base/flip.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/gl/state.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::viewer {

namespace {

constexpr double kSecondsApart = 1.0;  // between two pictures
constexpr double kNoise = 0.002;       // where a tile is finished, see TraceSettings
constexpr int kMostSamples = 1 << 14;

// The mean of each 2 x 2 pixels; an odd row or column at the end is left out.
Image halved(const Image& image) {
  Image out(std::max(image.width / 2, 1), std::max(image.height / 2, 1), 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int right = std::min(2 * x + 1, image.width - 1), below = std::min(2 * y + 1, image.height - 1);
        out.at(x, y)[c] = 0.25f * (image.at(2 * x, 2 * y)[c] + image.at(right, 2 * y)[c] + image.at(2 * x, below)[c] +
                                   image.at(right, below)[c]);
      }
  return out;
}

double evOf(const Image& light, const Film& film) {
  return film.exposure == ExposureMode::automatic ? automaticEv(light) : film.ev;
}

}  // namespace

struct Reference::Work {
  struct Result {
    Image light, samples;
    ReferenceState state;
  };
  Scene scene;
  realtime::CustomTextures textures;
  Image realtime;
  std::mutex mutex;
  std::optional<Result> result;  // guarded by the mutex
  std::atomic<bool> stop{false};
  std::thread thread;

  void hand(const trace::PathTracer& tracer, bool complete) {
    trace::TraceLayers layers = tracer.layers();
    Result next{std::move(layers.radiance), std::move(layers.samples), {}};
    std::size_t traced = 0;
    double sum = 0.0;
    for (const float samples : next.samples.pixels) {
      sum += samples;
      traced += samples > 0.0f ? 1 : 0;
    }
    const auto pixels = static_cast<double>(next.samples.pixels.size());
    next.state.samples = sum / pixels;
    next.state.share = static_cast<double>(traced) / pixels;
    next.state.complete = complete;
    if (traced == next.samples.pixels.size()) {
      const ToneSettings tone{.ev = static_cast<float>(evOf(realtime, scene.film)) - scene.film.compensation,
                              .whiteBalance = scene.film.whiteBalance,
                              .saturation = scene.film.saturation,
                              .curve = scene.film.tone};
      next.state.flip = meanOf(flipMap(displayValues(next.light, tone), displayValues(realtime, tone)));
    }
    const std::lock_guard lock(mutex);
    result = std::move(next);
  }

  void trace() {
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
    try {
      trace::PathTracer tracer(scene, {.weatherMaps = textures.weatherMaps, .grids = textures.grids},
                               {.width = realtime.width,
                                .height = realtime.height,
                                .samples = kMostSamples,
                                .noise = kNoise,
                                .checkpointSeconds = kSecondsApart});
      const bool complete = tracer.run([this](double) { return !stop; },
                                       [&] {
                                         if (!stop) hand(tracer, false);
                                       });
      if (complete) hand(tracer, true);
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex);
      result = Result{};
      result->state.trouble = e.what();
    }
  }
};

Reference::Reference() = default;
Reference::~Reference() { stop(); }

void Reference::start(const Scene& scene, const realtime::CustomTextures& textures, Image realtime) {
  stop();
  state_ = {};
  work_ = std::make_unique<Work>();
  work_->scene = scene;
  work_->textures = textures;
  work_->realtime = halved(realtime);
  work_->thread = std::thread([work = work_.get()] { work->trace(); });
}

void Reference::stop() {
  if (!work_) return;
  work_->stop = true;
  work_->thread.join();
  work_.reset();
  texture_ = gl::Texture();
}

bool Reference::running() const { return work_ != nullptr; }

bool Reference::collect(const gl::Api& gl) {
  if (!work_) return false;
  std::optional<Work::Result> result;
  {
    const std::lock_guard lock(work_->mutex);
    std::swap(result, work_->result);
  }
  if (!result) return false;
  state_ = result->state;
  const Image& light = result->light;
  if (light.pixels.empty()) return true;
  std::vector<float> rgba(static_cast<std::size_t>(light.width) * light.height * 4);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      float* to = rgba.data() + (static_cast<std::size_t>(light.height - 1 - y) * light.width + x) * 4;
      std::copy_n(light.at(x, y), 3, to);
      to[3] = *result->samples.at(x, y) > 0.0f ? 1.0f : 0.0f;
    }
  const gl::StateGuard guard(gl);
  texture_ = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba32F, light.width, light.height, 0, gl::Filter::linear,
                         gl::Addressing::clamp, rgba.data());
  return true;
}

const gl::Texture& Reference::texture() const { return texture_; }
const ReferenceState& Reference::state() const { return state_; }

}  // namespace welkin::viewer
