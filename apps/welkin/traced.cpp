#include "apps/welkin/traced.hpp"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <filesystem>

#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/exr.hpp"

namespace welkin::app {

namespace {

constexpr int kSamples = 64, kMostSamples = 4096;

std::atomic<bool> interrupted{false};

// While it lives, the first Ctrl-C asks for an end and the second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupted = false;
    before_ = std::signal(SIGINT, [](int) {
      interrupted = true;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~InterruptGuard() { std::signal(SIGINT, before_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace

void addRendererOptions(CLI::App& command, Renderer& renderer, TraceOptions& options) {
  command
      .add_option_function<std::string>(
          "--renderer", [&renderer](const std::string& name) { renderer = name == "path" ? Renderer::path : Renderer::realtime; },
          "realtime (OpenGL) or path (path-traced, the reference)")
      ->check(CLI::IsMember({"realtime", "path"}))
      ->type_name("NAME");
  command.add_option("--samples", options.samples, "path: paths of a pixel; 64 unless --noise or --seconds decides")
      ->type_name("N")
      ->check(CLI::Range(1, 1 << 20));
  command.add_option("--noise", options.noise, "path: go on until the noise is this share of the light, e.g. 0.02")
      ->type_name("SHARE")
      ->check(CLI::Range(1e-4, 1.0));
  command.add_option("--seconds", options.seconds, "path: stop after this time")
      ->type_name("S")
      ->check(CLI::Range(0.1, 1e7));
  command
      .add_option("--air", options.air,
                  "path: medium traces light through the air too; tables takes sky and aerial perspective from the "
                  "real-time tables: faster, biased")
      ->check(CLI::IsMember({"medium", "tables"}))
      ->type_name("NAME");
}

void traceToFile(const Scene& scene, const TraceOptions& options, const std::string& output) {
  const bool open = options.noise > 0.0 || options.seconds > 0.0;
  const trace::TraceSettings settings{
      .width = options.width,
      .height = options.height,
      .samples = options.samples > 0 ? options.samples : (open ? kMostSamples : kSamples),
      .noise = options.noise,
      .seconds = options.seconds,
      .air = options.air == "tables" ? trace::AirModel::tables : trace::AirModel::medium};
  const InterruptGuard guard;
  const std::vector<Volume> maps = weatherMaps(scene);
  trace::PathTracer tracer(scene, maps, settings);
  tracer.run([&](double done) { return !interrupted && (!options.progress || options.progress(done)); });
  const trace::TraceLayers layers = tracer.layers();
  const trace::KernelStatistics& s = tracer.statistics();
  fmt::print(stderr, "{} paths, {} scatterings, {} lookups, {} over bound, {} not finite, {} turns {} strides\n", s.paths, s.scatterings,
             s.lookups, s.overBound, s.notFinite, s.turns, s.strides);
  savePicture(output, layers.radiance, scene.film);
}

}  // namespace welkin::app
