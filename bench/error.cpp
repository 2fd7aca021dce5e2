// How far the real-time frame is from the path-traced one: twelve views (four kinds of cloud, the sun high, low and
// behind the clouds), quality "high", 32 frames against a path-traced, denoised picture with the air as a medium. Both
// without the sun's disc, which would outshine all else. References are kept in the folder and traced again only when
// the sky, the size or the samples change.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "welkin/base/flip.hpp"
#include "welkin/base/metrics.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/trace/denoise.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin {
namespace {

struct Options {
  std::string folder = "out/bench_error";
  int width = 640, height = 360;
  int samples = 256;
  int frames = 32;
  std::string only{};  // views whose name holds this
  bool keep = false, known = false;
};

struct Viewpoint {
  std::string name;
  Scene scene;
};

struct Error {
  double flip = 0.0, flipCloud = 0.0, relMse = 0.0;
  double ratio = 1.0;  // of mean luminances, real-time over path-traced
};

std::vector<Viewpoint> viewpoints() {
  std::vector<Viewpoint> views;
  for (const std::string kind : {"cumulus", "stratocumulus", "cumulonimbus", "cirrus"}) {
    const Scene scene = loadSky(WELKIN_SOURCE_DIR "/presets/" + kind + ".sky.toml");
    const auto add = [&](const std::string& light, float elevation, float turn) {
      Viewpoint view{kind + "_" + light, scene};
      view.scene.sun.elevation = glm::radians(elevation);
      view.scene.sun.azimuth = scene.camera.heading + glm::radians(turn);
      views.push_back(view);
    };
    add("high", 60.0f, 110.0f);
    add("low", 6.0f, 100.0f);
    add("behind", glm::degrees(scene.camera.pitch) + 9.0f, 4.0f);
  }
  return views;
}

std::string referenceFile(const Viewpoint& view, const Options& o) {
  const std::string key = fmt::format("{}\n{}x{} {}", writeSky(view.scene), o.width, o.height, o.samples);
  return fmt::format("{}/{}_{}x{}_{:016x}.exr", o.folder, view.name, o.width, o.height, std::hash<std::string>{}(key));
}

// RGB, and the share of paths that met a cloud.
Image reference(const Viewpoint& view, const Options& o) {
  const std::string path = referenceFile(view, o);
  if (std::filesystem::exists(path)) return loadExr(path);
  trace::PathTracer tracer(
      view.scene, {}, {.width = o.width, .height = o.height, .samples = o.samples, .sunDisc = trace::SunDisc::leftOut});
  tracer.run({});
  const trace::TraceLayers layers = tracer.layers();
  const Image smooth = trace::denoise(layers);
  Image result(o.width, o.height, 4);
  for (std::size_t i = 0; i < layers.transmittance.pixels.size(); ++i) {
    std::copy_n(&smooth.pixels[3 * i], 3, &result.pixels[4 * i]);
    result.pixels[4 * i + 3] = 1.0f - layers.transmittance.pixels[i];
  }
  saveExr(path, result, ExrPrecision::full);
  return result;
}

Image realtimeFrame(const Viewpoint& view, realtime::Offscreen& screen, const Options& o) {
  screen.view().reset();
  screen.renderer().setScene(view.scene);
  realtime::Frame frame = realtime::frameOf(view.scene.camera, o.width, o.height);
  frame.output = realtime::Output::lightWithoutSunDisc;
  for (int i = 0; i < o.frames; ++i) screen.draw(frame);
  return screen.read();
}

Error compare(const Viewpoint& view, const Image& truth, const Image& frame, const Options& o) {
  const Image rgb = withoutAlpha(truth);
  const ToneSettings tone{.ev = static_cast<float>(automaticEv(rgb))};
  const Image a = displayValues(rgb, tone), b = displayValues(frame, tone);
  const Image map = flipMap(a, b);
  Error e;
  e.flip = meanOf(map);
  double sum = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    if (truth.pixels[4 * i + 3] > 0.5f) sum += map.pixels[i], pixels += 1.0;
  e.flipCloud = pixels > 0.0 ? sum / pixels : 0.0;
  e.relMse = relMse(rgb, frame);
  e.ratio = meanLuminance(frame) / meanLuminance(rgb);
  if (o.keep) {
    const std::string stem = o.folder + "/" + view.name;
    savePng(stem + "_path.png", o.width, o.height, 3, displayBytes(rgb, tone));
    savePng(stem + "_realtime.png", o.width, o.height, 3, displayBytes(frame, tone));
    savePng(stem + "_flip.png", o.width, o.height, 3, bytesOf(heatMap(map)));
  }
  return e;
}

double spread(double ratio) { return std::max(ratio, 1.0 / ratio); }

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  using namespace welkin;
  Options o;
  CLI::App app{"Error of the real-time frame against the path-traced one."};
  app.add_option("--folder", o.folder, "where references and pictures are kept");
  app.add_option("--width", o.width)->check(CLI::Range(16, 4096));
  app.add_option("--samples", o.samples, "of a pixel of the reference")->check(CLI::Range(1, 1000000));
  app.add_option("--frames", o.frames)->check(CLI::Range(1, 1000));
  app.add_option("--only", o.only, "views whose name holds this");
  app.add_flag("--known", o.known, "leaves out views whose reference is not in the folder");
  app.add_flag("--pictures", o.keep, "keeps both pictures and their difference");
  CLI11_PARSE(app, argc, argv);
  o.height = o.width * 9 / 16;
  std::filesystem::create_directories(o.folder);

  realtime::Offscreen screen(o.width, o.height);
  fmt::print("{:<24}{:>8}{:>12}{:>10}{:>12}\n", "view", "FLIP", "of cloud", "relMSE", "luminance");
  std::string rows;
  double sum = 0.0, worst = 0.0, ratio = 1.0;
  int count = 0;
  for (const Viewpoint& view : viewpoints()) {
    if (view.name.find(o.only) == std::string::npos) continue;
    if (o.known && !std::filesystem::exists(referenceFile(view, o))) continue;
    const Image truth = reference(view, o);
    const Error e = compare(view, truth, realtimeFrame(view, screen, o), o);
    fmt::print("{:<24}{:>8.4f}{:>12.4f}{:>10.4f}{:>12.3f}\n", view.name, e.flip, e.flipCloud, e.relMse, e.ratio);
    std::fflush(stdout);
    rows += fmt::format(
        "{}\"{}\": {{\"flip\": {:.4f}, \"flip_cloud\": {:.4f}, \"relmse\": {:.4f}, "
        "\"luminance_ratio\": {:.4f}}}",
        rows.empty() ? "" : ", ", view.name, e.flip, e.flipCloud, e.relMse, e.ratio);
    sum += e.flip;
    worst = std::max(worst, e.flip);
    ratio = std::max(ratio, spread(e.ratio));
    ++count;
  }
  if (count == 0) return 1;
  fmt::print(
      "{{\"flip_mean\": {:.4f}, \"flip_worst\": {:.4f}, \"luminance_ratio_worst\": {:.4f}, \"views\": {{{}}}}}\n",
      sum / count, worst, ratio, rows);
}
