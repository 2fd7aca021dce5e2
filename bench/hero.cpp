// The case of 003 figure 39: one cloud of its two nodes, 512 x 512 pixels, 300 samples, 2 volume bounces (paths of
// three scatterings); as live nodes in Cycles (integrations/blender), baked by us into a VDB file in Cycles, and in our
// path tracer, which asks the law itself. All three have the same box, curve, parameters, medium, sun, sky and camera
// (bench/cycles.hpp); single billows of the nodes stand elsewhere (docs/blender.md), so the pictures agree in their
// means. Figures are CPU seconds of all threads; noise is relMSE, from the picture and one of a quarter of its samples.
// The live nodes, which take hours, are drawn with fewer samples (--live-samples): time goes with samples, noise with
// 1 / samples. bench_hero [--size N] [--samples N] [--live-samples N] [FOLDER], where the pictures are kept.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bench/cycles.hpp"
#include "bench/harness.hpp"
#include "welkin/density/voxel_bake.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/vdb.hpp"
#include "welkin/scene/sections.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin {
namespace {

using namespace bench;

constexpr int kScatterings = 3;
constexpr int kVoxels = 256;  // along the box's longest side
constexpr float kAsymmetry = 0.85f;
// Of the extinction: the formula's largest densities are about 1.
constexpr float kExtinction = 0.05f;  // 1/m

Scene heroScene() {
  Scene scene = clearScene();
  scene.layers.clear();
  scene.sheets.clear();
  Hero hero;
  hero.form.shape = HeroShape::classic;
  hero.form.lean = 0.0f;
  hero.cloud.extinction = kExtinction;
  hero.cloud.phase = ScatteringPhase::henyey_greenstein;
  hero.cloud.asymmetry = kAsymmetry;
  scene.heroes = {hero};
  scene.camera = {.position = {0.0, -7000.0, 1300.0}, .pitch = 0.19f, .fov = 0.62f};
  return scene;
}

template <class T>
std::string tableText(const T& values) {
  std::string text;
  for (const Field& f : fieldsOf<T>())
    text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", f.name, formatValue(f, f.get(&values)));
  return "{" + text + "}";
}

// What one renderer was timed at.
struct Times {
  std::string name;
  double seconds = 0.0;  // CPU
  double mean = 0.0;     // luminance of the picture, kcd/m^2
  double noise = 0.0;    // relMSE
};

double luminanceAt(const Image& a, std::size_t pixel) {
  return luminanceOf(a.pixels.data() + pixel * static_cast<std::size_t>(a.channels));
}

struct Options {
  int size = 512, samples = 300, liveSamples = 20;
  std::string folder = "out/hero";
};

int fewerThan(int samples) { return std::max(samples / 4, 1); }

class Figure39 {
 public:
  explicit Figure39(const Options& options) : o_(options), scene_(heroScene()) {
    std::filesystem::create_directories(o_.folder);
  }

  Times live() {
    if (std::system(("WELKIN='" WELKIN_BINARY_DIR "/bin/welkin' '" WELKIN_SOURCE_DIR "/scripts/blender_addon' '" +
                     o_.folder + "/welkin_sky.zip' >/dev/null && cd '" + o_.folder +
                     "' && python3 -m zipfile -e welkin_sky.zip add_on")
                        .c_str()) != 0)
      throw Error(ErrorKind::failed, "scripts/blender_addon", "the add-on could not be made");
    const Hero& hero = scene_.heroes.front();
    return cycles("live",
                  fmt::format("\"live\": {{\"add_on\": \"{}/add_on\", \"location\": {}, \"form\": {}, "
                              "\"classic\": {}}}",
                              o_.folder, listOf(hero.cloud.position), tableText(hero.form), tableText(hero.classic)),
                  std::min(o_.liveSamples, o_.samples));
  }

  Times volume(double& bakeSeconds) {
    const double begin = cpuSeconds();
    const DensityField field({.seed = scene_.seed, .heroes = scene_.heroes});
    const HeroBody& body = field.heroes().front();
    const glm::dvec3 low = body.lowest(), size = body.highest() - low;
    const double voxel = std::max({size.x, size.y, size.z}) / kVoxels;
    const VoxelBox box{glm::ivec3(glm::ceil(size / voxel)), low, glm::dvec3(voxel)};
    const std::string file = o_.folder + "/cloud.vdb";
    saveVdb(file, bakeVoxels(field, box, {.scale = 1.0f / kExtinction}), {}, VolumePrecision::half);
    bakeSeconds = cpuSeconds() - begin;
    return cycles("vdb", volumeText(file, glm::dvec3(0.0), voxel), o_.samples);
  }

  Times ours() const {
    draw(fewerThan(o_.samples), 1, "welkin_fewer");
    const double seconds = draw(o_.samples, 2, "welkin");
    return timesOf("welkin", seconds, o_.samples);
  }

 private:
  Times cycles(const std::string& name, const std::string& cloud, int samples) const {
    const std::vector<Shot> shots{{name + "_warm-up", 1, kScatterings, 0, 1.0},
                                  {name + "_fewer", fewerThan(samples), kScatterings, 1, 1.0},
                                  {name, samples, kScatterings, 2, 1.0}};
    const auto seconds =
        runCycles(scene_, mediumText(kExtinction, kAsymmetry) + ", " + cloud, o_.size, o_.size, o_.folder, shots);
    return timesOf(name, seconds.at(name), samples);
  }

  double draw(int samples, int seed, const std::string& name) const {
    const double begin = cpuSeconds();
    trace::PathTracer tracer(scene_, {},
                             {.width = o_.size,
                              .height = o_.size,
                              .samples = samples,
                              .sunDisc = trace::SunDisc::leftOut,
                              .scatterings = kScatterings,
                              .frame = seed});
    tracer.run({});
    const double spent = cpuSeconds() - begin;
    fmt::print("  Welkin {} {:.1f} s\n", name, spent);
    std::fflush(stdout);
    saveExr(pictureOf(name), tracer.layers().radiance, ExrPrecision::full);
    return spent;
  }

  // Brought from `samples` to those that are asked for. The mean square of the difference of two pictures is the
  // variance of one sample times 1/n + 1/m.
  Times timesOf(const std::string& name, double seconds, int samples) const {
    const Image all = loadExr(pictureOf(name)), fewer = loadExr(pictureOf(name + "_fewer"));
    const auto n = static_cast<std::size_t>(o_.size) * o_.size;
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = luminanceAt(all, i), difference = x - luminanceAt(fewer, i);
      square += difference * difference;
      sum += x;
    }
    const double pixels = static_cast<double>(n), mean = sum / pixels;
    const double variance = square / pixels / (1.0 / samples + 1.0 / fewerThan(samples));
    return {name, seconds * o_.samples / samples, mean, variance / o_.samples / (mean * mean)};
  }

  std::string pictureOf(const std::string& name) const { return o_.folder + "/" + name + ".exr"; }

  Options o_;
  Scene scene_;
};

void run(const Options& options) {
  requireBlender();
  Figure39 figure(options);
  double bakeSeconds = 0.0;
  const Times all[] = {figure.live(), figure.volume(bakeSeconds), figure.ours()};
  fmt::print("\n{:<8} {:>10} {:>14} {:>12}\n", "", "CPU s", "mean, kcd/m^2", "relMSE");
  std::string json;
  for (const Times& t : all) {
    fmt::print("{:<8} {:>10.1f} {:>14.3f} {:>12.2g}\n", t.name, t.seconds, t.mean, t.noise);
    json += fmt::format("\"{0}_cpu_s\": {1:.2f}, \"{0}_mean\": {2:.4f}, \"{0}_rel_mse\": {3:.3g}, ", t.name, t.seconds,
                        t.mean, t.noise);
  }
  const Times& ours = all[2];
  const auto equal = [&](const Times& t) { return t.seconds * t.noise / (ours.seconds * ours.noise); };
  fmt::print("live nodes take {:.1f} times our time, the volume {:.1f} times and {:.1f} s for its baking\n",
             all[0].seconds / ours.seconds, all[1].seconds / ours.seconds, bakeSeconds);
  fmt::print(
      "{{\"bench\": \"hero\", \"size\": {}, \"samples\": {}, \"live_samples\": {}, {}\"bake_cpu_s\": {:.2f}, "
      "\"ratio_live\": {:.2f}, "
      "\"ratio_vdb\": {:.2f}, \"ratio_live_equal_error\": {:.2f}, \"ratio_vdb_equal_error\": {:.2f}}}\n",
      options.size, options.samples, std::min(options.liveSamples, options.samples), json, bakeSeconds,
      all[0].seconds / ours.seconds, all[1].seconds / ours.seconds, equal(all[0]), equal(all[1]));
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  welkin::Options options;
  CLI::App app("003's figure 39 as live nodes in Cycles, as a volume in Cycles, and in our path tracer", "bench_hero");
  app.add_option("--size", options.size, "edge of the pictures in pixels")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  app.add_option("--samples", options.samples, "of a pixel")->check(CLI::Range(4, 65536))->capture_default_str();
  app.add_option("--live-samples", options.liveSamples, "of the live nodes; their figures are brought to --samples")
      ->check(CLI::Range(4, 65536))
      ->capture_default_str();
  app.add_option("folder", options.folder, "where the pictures are kept")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    options.folder = std::filesystem::absolute(options.folder).string();
    welkin::run(options);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_hero: {}\n", e.what());
    return 1;
  }
  return 0;
}
