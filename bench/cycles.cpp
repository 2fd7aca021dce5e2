// Speed at equal error against Blender's Cycles: one cumulus, baked into a VDB file, drawn by both with the same
// medium, sun, sky and camera. CPU time of all threads to the same relMSE against a long picture of ours, with which
// Cycles' own mean must agree; once with all orders of scattering and once with the first alone. docs/path_tracing.md,
// "Against Cycles", says how the two are matched. bench_cycles [FOLDER], where the pictures are kept.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/cycles.hpp"
#include "bench/harness.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/voxel_bake.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/io/vdb.hpp"
#include "welkin/scene/camera.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin {
namespace {

using namespace bench;

constexpr int kWidth = 320, kHeight = 180;
constexpr double kVoxel = 6.25;         // m
constexpr double kOpticalDepth = 45.0;  // along the ray through the picture's middle
constexpr float kAsymmetry = 0.85f;
constexpr double kTarget = 0.01;        // relMSE to which times are given
constexpr double kTrimmed = 0.001;      // share of the worst pixels that the second figure leaves out
constexpr int kManyScatterings = 1024;  // Cycles cannot be told "all"

// How much is drawn for one of the two questions. Errors are those of `pictures` pictures of 4 `few` samples; as many
// of `few` show that errors fall with the number of samples.
struct Question {
  const char* name;
  int scatterings;  // of a path at most; 0 without limit
  int reference;    // samples of our long picture
  int few, pictures;
  int cyclesFew, cyclesPictures;
  double stepRate;      // of the pictures that are timed: whichever of 1, 0.5 and 0.25 serves Cycles best
  double fineStepRate;  // of the picture whose mean is compared: long steps let too much light through
  int fineSamples;
};
constexpr Question kQuestions[] = {
    {"multiple", 0, 512, 8, 8, 8, 2, 1.0, 0.5, 64},
    {"single", 1, 1024, 16, 8, 16, 2, 0.5, 0.125, 64},
};

// A tall cloud of the preset and the camera before it.
Scene cloudScene() {
  Scene scene = clearScene();
  scene.layers.front().cloud.thickness = 3000.0f;
  scene.camera = {.position = {0.0, -3100.0, 1400.0}, .pitch = 0.13f, .fov = 0.76f};
  return scene;
}

// One of the preset's clouds as a file; in the scene it stands in place of the layers, over the world's origin, where
// the planet's curve is a matter of centimetres.
std::vector<PlacedGrid> bakeCloud(Scene& scene, const std::string& path) {
  const DensityField field({.layers = scene.layers,
                            .noise = scene.noise,
                            .drift = {scene.wind.speed, scene.wind.from, scene.time},
                            .seed = scene.seed});
  const glm::dvec3 low(-1950.0, 1600.0, 1100.0), high(50.0, 3300.0, 3500.0);
  const VoxelGrid voxels = bakeVoxels(field, {glm::ivec3((high - low) / kVoxel), low, glm::dvec3(kVoxel)},
                                      {.scale = 1.0f / scene.layers.front().cloud.extinction});
  saveVdb(path, voxels, {}, VolumePrecision::half);
  GridCloud cloud;
  cloud.file = path;
  cloud.position = -0.5 * glm::dvec3(low.x + high.x, low.y + high.y, 0.0);
  cloud.values = GridValues::normalized;
  cloud.extinction = 1.0f;
  cloud.phase = ScatteringPhase::henyey_greenstein;
  cloud.asymmetry = kAsymmetry;
  scene.layers.clear();
  scene.sheets.clear();
  scene.grids = {cloud};
  std::vector<PlacedGrid> grids = loadGrids(scene);
  double depth = 0.0;
  const glm::dvec3 ahead = cameraAxes(scene.camera)[2];
  for (double t = 0.0; t < 10e3; t += 1.0) depth += grids.front().at(scene.camera.position + ahead * t);
  if (!(depth > 0.0)) throw Error(ErrorKind::failed, path, "there is no cloud in the middle of the picture");
  scene.grids.front().extinction = grids.front().extinction = static_cast<float>(kOpticalDepth / depth);
  return grids;
}

// Our long picture, at the pixels that show cloud. All of this is of luminance.
struct Reference {
  std::vector<std::size_t> pixels;
  std::vector<double> values;
  double mean = 0.0, epsilon = 0.0;
  double relMse = 0.0;  // what it has of its own

  explicit Reference(const trace::TraceLayers& layers) {
    for (std::size_t i = 0; i < layers.variance.pixels.size(); ++i) {
      if (layers.transmittance.pixels[i] > 0.99f) continue;
      pixels.push_back(i);
      values.push_back(luminanceOf(layers.radiance.pixels.data() + 3 * i));
      mean += values.back();
    }
    mean /= static_cast<double>(pixels.size());
    epsilon = 0.01 * mean * mean;
    for (std::size_t k = 0; k < pixels.size(); ++k)
      relMse += layers.variance.pixels[pixels[k]] / (values[k] * values[k] + epsilon);
    relMse /= static_cast<double>(pixels.size());
  }
};

// relMSE of a picture, and without its worst pixels.
struct Errors {
  double all = 0.0, trimmed = 0.0;

  Errors& operator+=(const Errors& e) {
    all += e.all, trimmed += e.trimmed;
    return *this;
  }
  Errors operator/(double n) const { return {all / n, trimmed / n}; }
};

Errors errorsOf(const Image& picture, const Reference& reference) {
  std::vector<double> squares;
  for (std::size_t k = 0; k < reference.pixels.size(); ++k) {
    const double r = reference.values[k];
    const double d = luminanceOf(picture.at(0, 0) + reference.pixels[k] * picture.channels) - r;
    squares.push_back(d * d / (r * r + reference.epsilon));
  }
  std::sort(squares.begin(), squares.end());
  const auto mean = [&](std::size_t n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += squares[i];
    return sum / static_cast<double>(n);
  };
  const double kept = (1.0 - kTrimmed) * static_cast<double>(squares.size());
  return {mean(squares.size()) - reference.relMse, mean(static_cast<std::size_t>(kept)) - reference.relMse};
}

// How far the mean of a picture is from the reference's, and the standard error of that, both as shares of it.
struct Agreement {
  double difference = 0.0, error = 0.0;
};

Agreement agreementOf(const Image& picture, const Reference& reference) {
  Agreement a;
  const double n = static_cast<double>(reference.pixels.size());
  for (std::size_t k = 0; k < reference.pixels.size(); ++k) {
    const double d = luminanceOf(picture.at(0, 0) + reference.pixels[k] * picture.channels) - reference.values[k];
    a.difference += d / (n * reference.mean);
    a.error += d * d;
  }
  // Pixels err independently of each other.
  a.error = std::sqrt(a.error) / (n * reference.mean);
  return a;
}

// What one renderer made of a question: means over its pictures.
struct Score {
  Errors few, many;
  double seconds = 0.0;  // CPU, of a picture of many samples

  // CPU seconds to a relMSE of kTarget, as errors fall with 1 / samples.
  double secondsTo(double Errors::*which) const { return seconds * many.*which / kTarget; }
};

class Comparison {
 public:
  explicit Comparison(std::string folder) : folder_(std::move(folder)), scene_(cloudScene()) {
    std::filesystem::create_directories(folder_);
    grids_ = bakeCloud(scene_, folder_ + "/cloud.vdb");
    const glm::ivec3 n = grids_.front().voxels->dims();
    fmt::print("{} x {} x {} voxels of {} m, extinction {:.4f}/m; {} x {} pixels\n", n.x, n.y, n.z, kVoxel,
               scene_.grids.front().extinction, kWidth, kHeight);
    std::fflush(stdout);
  }

  // All of Cycles' pictures, by one Blender.
  void drawCycles() {
    std::vector<Shot> shots{{"warm-up", 1, 1, 0, 1.0}};
    for (const Question& q : kQuestions) {
      const int scatterings = q.scatterings > 0 ? q.scatterings : kManyScatterings;
      for (int i = 0; i < q.cyclesPictures; ++i)
        for (const int factor : {1, 4})
          shots.push_back({shotName(q, factor, i), factor * q.cyclesFew, scatterings, 10 * i + factor, q.stepRate});
      shots.push_back({fmt::format("{}_fine", q.name), q.fineSamples, scatterings, 0, q.fineStepRate});
    }
    const GridCloud& cloud = scene_.grids.front();
    cyclesSeconds_ = runCycles(
        scene_, mediumText(cloud.extinction, kAsymmetry) + ", " + volumeText(cloud.file, cloud.position, kVoxel),
        kWidth, kHeight, folder_, shots);
  }

  // Answers the line's part of the JSON object.
  std::string answer(const Question& q) {
    double seconds = 0.0;
    const trace::TraceLayers layers = trace(q, q.reference, 1, seconds);
    const Reference reference(layers);
    saveExr(fmt::format("{}/{}_reference.exr", folder_, q.name), layers.radiance, ExrPrecision::full);
    fmt::print("\n{} scattering: our reference of {} samples took {:.0f} CPU s, its own relMSE is {:.2g}\n", q.name,
               q.reference, seconds, reference.relMse);

    Score ours, cycles;
    for (int i = 0; i < q.pictures; ++i)
      for (const int factor : {1, 4}) {
        const Image picture = trace(q, factor * q.few, 10 + 2 * i + factor, seconds).radiance;
        (factor == 1 ? ours.few : ours.many) += errorsOf(picture, reference) / q.pictures;
        if (factor == 4) ours.seconds += seconds / q.pictures;
      }
    Image mean(kWidth, kHeight, 3);
    for (int i = 0; i < q.cyclesPictures; ++i) {
      for (const int factor : {1, 4}) {
        const Image picture = loadExr(fmt::format("{}/{}.exr", folder_, shotName(q, factor, i)));
        (factor == 1 ? cycles.few : cycles.many) += errorsOf(picture, reference) / q.cyclesPictures;
        for (std::size_t p = 0; p < mean.pixels.size() / 3; ++p)
          for (std::size_t c = 0; c < 3; ++c)
            mean.pixels[3 * p + c] +=
                picture.pixels[p * picture.channels + c] * static_cast<float>(factor / (5.0 * q.cyclesPictures));
      }
      // Starting up cancels in the difference.
      cycles.seconds +=
          4.0 / 3.0 / q.cyclesPictures * (cyclesSeconds_.at(shotName(q, 4, i)) - cyclesSeconds_.at(shotName(q, 1, i)));
    }
    saveExr(fmt::format("{}/{}_cycles.exr", folder_, q.name), mean, ExrPrecision::full);

    fmt::print("{:<8} {:>7} {:>8} {:>8} {:>8} {:>11} {:>8} {:>15} {:>8}\n", "", "samples", "CPU s", "relMSE", "trimmed",
               "1/4 samples", "trimmed", "s to relMSE .01", "trimmed");
    print("Welkin", 4 * q.few, ours);
    print("Cycles", 4 * q.cyclesFew, cycles);
    const Agreement timed = agreementOf(mean, reference);
    const Agreement fine = agreementOf(loadExr(fmt::format("{}/{}_fine.exr", folder_, q.name)), reference);
    for (const auto& [rate, a] : {std::pair(q.stepRate, timed), std::pair(q.fineStepRate, fine)})
      fmt::print("mean of Cycles over {} pixels of cloud, step rate {}: {:+.2f} % of ours, standard error {:.2f} %\n",
                 reference.pixels.size(), rate, 100.0 * a.difference, 100.0 * a.error);
    if (std::abs(fine.difference) > 3.0 * fine.error) fmt::print("THE MEANS DO NOT AGREE\n");
    const double ratio = cycles.secondsTo(&Errors::all) / ours.secondsTo(&Errors::all);
    const double trimmed = cycles.secondsTo(&Errors::trimmed) / ours.secondsTo(&Errors::trimmed);
    fmt::print("Cycles needs {:.1f} times our CPU time; {:.1f} times without the worst {} of the pixels\n", ratio,
               trimmed, kTrimmed);
    std::fflush(stdout);
    return fmt::format(
        "\"ratio_{0}\": {1:.2f}, \"ratio_{0}_trimmed\": {2:.2f}, \"seconds_{0}\": {3:.2f}, "
        "\"cycles_seconds_{0}\": {4:.1f}, \"slope_{0}\": {5:.2f}, \"cycles_slope_{0}\": {6:.2f}, "
        "\"mean_difference_{0}\": {7:.5f}, \"mean_error_{0}\": {8:.5f}",
        q.name, ratio, trimmed, ours.secondsTo(&Errors::all), cycles.secondsTo(&Errors::all),
        ours.few.all / ours.many.all, cycles.few.all / cycles.many.all, fine.difference, fine.error);
  }

 private:
  static std::string shotName(const Question& q, int factor, int i) {
    return fmt::format("{}_{}_{}", q.name, factor, i);
  }

  trace::TraceLayers trace(const Question& q, int samples, int seed, double& seconds) const {
    Scene scene = scene_;
    scene.seed = seed;
    trace::PathTracer tracer(scene, {.grids = grids_},
                             {.width = kWidth,
                              .height = kHeight,
                              .samples = samples,
                              .sunDisc = trace::SunDisc::leftOut,
                              .scatterings = q.scatterings});
    const double begin = bench::cpuSeconds();
    tracer.run({});
    seconds = bench::cpuSeconds() - begin;
    return tracer.layers();
  }

  static void print(const char* name, int samples, const Score& s) {
    fmt::print("{:<8} {:>7} {:>8.2f} {:>8.4f} {:>8.4f} {:>10.2f}x {:>7.2f}x {:>15.1f} {:>8.1f}\n", name, samples,
               s.seconds, s.many.all, s.many.trimmed, s.few.all / s.many.all, s.few.trimmed / s.many.trimmed,
               s.secondsTo(&Errors::all), s.secondsTo(&Errors::trimmed));
  }

  std::string folder_;
  Scene scene_;
  std::vector<PlacedGrid> grids_;
  std::map<std::string, double> cyclesSeconds_;
};

int run(const std::string& folder) {
  requireBlender();
  Comparison comparison(folder);
  comparison.drawCycles();
  std::string json;
  for (const Question& q : kQuestions) json += (json.empty() ? "" : ", ") + comparison.answer(q);
  fmt::print("{{\"lanes\": {}, {}}}\n", trace::laneCount(), json);
  return 0;
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  try {
    return welkin::run(std::filesystem::absolute(argc > 1 ? argv[1] : "out/cycles").string());
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_cycles: {}\n", e.what());
    return 1;
  }
}
