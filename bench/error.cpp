// How far the real-time frame is from the path-traced one: twelve views (four kinds of cloud, the sun high, low and
// behind the clouds), quality "high", 32 frames against a path-traced, denoised picture with the air as a medium
// (traced.hpp). References are kept in the folder and traced again only when the sky, the size or the samples change.
// Then the mean again with one approximation at a time switched off.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <map>
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
  bool keep = false, known = false, ablations = true;
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

// One approximation done without. `frames`: so many do where each marches every pixel; 0 for as many as ever.
struct Ablation {
  const char* name;
  void (*apply)(Scene&);
  int frames;
};
constexpr Ablation kAblations[] = {
    {"every_pixel_every_frame", [](Scene& s) { s.quality.interleave = s.quality.historyScale = 1; }, 4},
    {"steps_of_a_quarter", [](Scene& s) { s.quality.stepScale = 0.25f; }, 0},
    {"rays_to_their_end", [](Scene& s) { s.quality.earlyExit = false; }, 0},
    {"no_refined_first_hit", [](Scene& s) { s.quality.refine = false; }, 0},
    {"octaves_for_light_volume", [](Scene& s) { s.quality.lightVolume = false; }, 0},
    {"lobes_for_droplets", [](Scene& s) { s.lighting.phase = PhaseModel::lobes; }, 0},
};

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
  app.add_flag("--ablations,!--no-ablations", o.ablations, "also without one approximation at a time");
  CLI11_PARSE(app, argc, argv);
  o.height = o.width * 9 / 16;
  std::filesystem::create_directories(o.folder);

  const bench::Reference reference{o.folder, o.width, o.height, o.samples};
  realtime::Offscreen screen(o.width, o.height);
  fmt::print("{:<24}{:>8}{:>12}{:>10}{:>12}\n", "view", "FLIP", "of cloud", "relMSE", "luminance");
  std::string rows, without;
  std::map<std::string, std::vector<bench::Error>> ablated;
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
    if (!o.ablations) continue;
    for (const Ablation& a : kAblations) {
      Scene scene = view.scene;
      a.apply(scene);
      const int frames = a.frames > 0 ? std::min(a.frames, o.frames) : o.frames;
      ablated[a.name].push_back(
          bench::compare(truth, bench::stillPicture(screen, scene, o.width, o.height, frames), ""));
    }
  }
  if (count == 0) return 1;
  for (const auto& [name, errors] : ablated) {
    double flip = 0.0, worstRatio = 1.0;
    for (const bench::Error& e : errors) flip += e.flip, worstRatio = std::max(worstRatio, spread(e.ratio));
    flip /= static_cast<double>(errors.size());
    fmt::print("{:<24}{:>8.4f}{:>34.3f} at worst\n", name, flip, worstRatio);
    without += fmt::format("{}\"{}\": {{\"flip_mean\": {:.4f}, \"luminance_ratio_worst\": {:.4f}}}",
                           without.empty() ? "" : ", ", name, flip, worstRatio);
  }
  fmt::print(
      "{{\"flip_mean\": {:.4f}, \"flip_worst\": {:.4f}, \"luminance_ratio_worst\": {:.4f}, \"views\": {{{}}}, "
      "\"ablations\": {{{}}}}}\n",
      sum / count, worst, ratio, rows, without);
}
