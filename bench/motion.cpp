// How near the frames of the flight of flight.hpp come to what they would be if nothing had to be reused: PSNR of the
// tone-mapped frame (AgX, exposed for the truth) against the mean of 256 differently jittered marches of every pixel of
// the history, at that very place and time; and the same for a camera that has stood still there for 32 frames.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "bench/flight.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

constexpr int kStillFrames = 32;

struct Options : bench::FlightOptions {
  int every = 25, samples = 256;
  bool full = false;
};

// Adds up frames; without reprojection each stands for itself.
void addFrames(realtime::Offscreen& screen, const Scene& scene, int frames, Image& sum) {
  for (int i = 0; i < frames; ++i) {
    screen.draw(scene, scene.time);
    const Image light = screen.read();
    if (sum.pixels.empty()) sum = Image(light.width, light.height, light.channels);
    for (std::size_t k = 0; k < sum.pixels.size(); ++k) sum.pixels[k] += light.pixels[k];
  }
}

Image scaled(Image image, float factor) {
  for (float& value : image.pixels) value *= factor;
  return image;
}

// The mean of many marches, and how near the mean of the first half of them is to that of the second.
struct Truth {
  Image light;
  double halves = 0.0;  // dB
};

double psnrShown(const Image& truth, const Image& picture, const ToneSettings& tone) {
  return psnr(displayValues(truth, tone), displayValues(picture, tone));
}

ToneSettings toneFor(const Image& truth) { return {.ev = static_cast<float>(automaticEv(truth))}; }

Truth truthOf(realtime::Offscreen& screen, Scene scene, const Options& o) {
  scene.quality.reprojection = false;
  if (o.full) scene.quality.historyScale = 1;
  screen.view().reset();
  screen.renderer().setScene(scene);
  const int half = o.samples / 2;
  Image first, second;
  addFrames(screen, scene, half, first);
  addFrames(screen, scene, half, second);
  const float share = 1.0f / static_cast<float>(half);
  first = scaled(std::move(first), share);
  second = scaled(std::move(second), share);
  Truth truth{first, 0.0};
  for (std::size_t k = 0; k < first.pixels.size(); ++k)
    truth.light.pixels[k] = 0.5f * (first.pixels[k] + second.pixels[k]);
  truth.halves = psnrShown(first, second, toneFor(truth.light));
  return truth;
}

Image stillFrame(realtime::Offscreen& screen, const Scene& scene) {
  screen.view().reset();
  for (int i = 0; i < kStillFrames; ++i) screen.draw(scene, scene.time);
  return screen.read();
}

void savePicture(const Options& o, int frame, const char* name, const Image& light, const ToneSettings& tone) {
  if (o.pictures.empty()) return;
  savePng(fmt::format("{}/motion_{:03}_{}.png", o.pictures, frame, name), light.width, light.height, 3,
          displayBytes(light, tone));
}

// Of values in dB.
struct Summary {
  double sum = 0.0, worst = 1e9;
  int count = 0, worstAt = 0;
  void add(double value, int frame) {
    sum += value;
    ++count;
    if (value < worst) worst = value, worstAt = frame;
  }
  double mean() const { return count ? sum / count : 0.0; }
};

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  using namespace welkin;
  Options o;
  o.width = 256;
  o.height = 144;
  CLI::App app{"Frames of a flight against the mean of many marches at the same place."};
  o.addTo(app);
  app.add_option("--every", o.every, "judges one frame in so many, the last of them; none right after a cut")
      ->check(CLI::Range(1, bench::kLegFrames));
  app.add_option("--samples", o.samples, "marches of a pixel in the truth")->check(CLI::Range(2, 65536));
  app.add_flag("--full", o.full, "the truth marches every pixel of the picture, not of the history");
  CLI11_PARSE(app, argc, argv);
  if (!o.pictures.empty()) std::filesystem::create_directories(o.pictures);

  realtime::Offscreen screen(o.width, o.height);
  realtime::View apart;  // of the still camera and the truth
  Summary moving, still, halves;
  std::string legs;
  fmt::print("{:<8}{:<12}{:>12}{:>12}{:>12}\n", "frame", "leg", "moving dB", "still dB", "halves dB");
  Summary leg;
  for (int i = 0; i < o.frames; ++i) {
    bench::Moment moment = o.at(i);
    moment.newScene = true;  // the truth has changed it
    bench::draw(screen, moment);
    if (moment.sinceCut % o.every == o.every - 1) {
      const Image frame = screen.read();
      std::swap(screen.view(), apart);
      const Image rested = stillFrame(screen, moment.scene);
      const Truth truth = truthOf(screen, moment.scene, o);
      std::swap(screen.view(), apart);
      const ToneSettings tone = toneFor(truth.light);
      const double inMotion = psnrShown(truth.light, frame, tone), atRest = psnrShown(truth.light, rested, tone);
      moving.add(inMotion, i);
      leg.add(inMotion, i);
      still.add(atRest, i);
      halves.add(truth.halves, i);
      savePicture(o, i, "frame", frame, tone);
      savePicture(o, i, "still", rested, tone);
      savePicture(o, i, "truth", truth.light, tone);
      fmt::print("{:<8}{:<12}{:>12.2f}{:>12.2f}{:>12.2f}\n", i, moment.leg->name, inMotion, atRest, truth.halves);
      std::fflush(stdout);
    }
    if (i + 1 == o.end(o.legOf(i))) {
      legs += fmt::format("{}\"{}\": {{\"psnr_mean\": {:.2f}, \"psnr_worst\": {:.2f}}}", legs.empty() ? "" : ", ",
                          moment.leg->name, leg.mean(), leg.worst);
      leg = {};
    }
  }
  if (moving.count == 0) {
    fmt::print(stderr, "no frame was judged: legs of {} frames are shorter than --every {}\n", o.legFrames(), o.every);
    return 1;
  }
  fmt::print(
      "{{\"psnr_mean\": {:.2f}, \"psnr_worst\": {:.2f}, \"worst_frame\": {}, \"psnr_still\": {:.2f}, "
      "\"psnr_still_worst\": {:.2f}, \"psnr_halves_of_truth\": {:.2f}, \"frames_judged\": {}, \"width\": {}, "
      "\"height\": {}, \"samples\": {}, \"legs\": {{{}}}}}\n",
      moving.mean(), moving.worst, moving.worstAt, still.mean(), still.worst, halves.mean(), moving.count, o.width,
      o.height, o.samples, legs);
}
