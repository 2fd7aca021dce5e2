// How far the real-time frame is from the path-traced one: twelve views (four kinds of cloud, the sun high, low and
// behind the clouds), quality "high", 32 frames against a path-traced, denoised picture with the air as a medium
// (traced.hpp). References are kept in the folder and traced again only when the sky, the size or the samples change.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "bench/traced.hpp"

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

  const bench::Reference reference{o.folder, o.width, o.height, o.samples};
  realtime::Offscreen screen(o.width, o.height);
  fmt::print("{:<24}{:>8}{:>12}{:>10}{:>12}\n", "view", "FLIP", "of cloud", "relMSE", "luminance");
  std::string rows;
  double sum = 0.0, worst = 0.0, ratio = 1.0;
  int count = 0;
  for (const Viewpoint& view : viewpoints()) {
    if (view.name.find(o.only) == std::string::npos) continue;
    if (o.known && !std::filesystem::exists(reference.file(view.name, view.scene))) continue;
    const Image truth = reference.of(view.name, view.scene);
    const Image frame = bench::stillPicture(screen, view.scene, o.width, o.height, o.frames);
    const bench::Error e = bench::compare(truth, frame, o.keep ? o.folder + "/" + view.name : "");
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
