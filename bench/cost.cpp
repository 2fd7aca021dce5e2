// What a frame costs on the flight of flight.hpp, and what the same frames cost an honest march without shortcuts.
// CPU seconds are those of the process, all threads, for frames that are finished one by one; the rest of the loop is
// not counted, Offscreen's clear of its target is. Samples and fetches come from passes of their own, since counting
// changes the shader.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "bench/flight.hpp"
#include "bench/harness.hpp"
#include "bench/traced.hpp"

namespace welkin {
namespace {

constexpr int kWindow = 12;  // frames on either side of a place
constexpr int kFlipWidth = 160, kFlipHeight = 90, kFlipSamples = 64, kFlipPlaces = 2, kStillFrames = 32;

struct Options : bench::FlightOptions {
  int plainFrames = 8;
  bool plain = true, flip = true;
  std::string folder = "out/bench_cost";
};

// Every pixel marched in every frame with all of its light samples, and nothing reused. Other shortcuts of the quality
// table belong here as they come.
Quality plainQuality(QualityPreset preset) {
  Quality q;
  q.preset = preset;
  q.historyScale = q.interleave = 1;
  q.lightSteps = 9;
  q.ambientSteps = 3;
  q.reprojection = q.lightVolume = q.cheapSearch = q.stepsByAngle = false;
  return q;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void savePicture(const Options& o, const std::string& name, const realtime::Offscreen& screen) {
  if (o.pictures.empty()) return;
  const Image light = screen.read();
  const ToneSettings tone{.ev = static_cast<float>(automaticEv(light))};
  savePng(fmt::format("{}/{}.png", o.pictures, name), light.width, light.height, 3, displayBytes(light, tone));
}

struct Flown {
  std::vector<double> seconds;             // of every frame
  std::vector<realtime::PassCost> passes;  // milliseconds a frame, mean
};

Flown fly(realtime::Offscreen& screen, const Options& o) {
  Flown flown;
  for (int i = 0; i < o.frames; ++i) {
    const bench::Moment moment = o.at(i);
    flown.seconds.push_back(bench::drawTimed(screen, moment));
    const std::vector<realtime::PassCost> passes = screen.renderer().lastCost().passes;
    if (flown.passes.empty()) {
      flown.passes = passes;
      for (realtime::PassCost& pass : flown.passes) pass.milliseconds = 0.0;
    }
    for (std::size_t k = 0; k < passes.size(); ++k) flown.passes[k].milliseconds += passes[k].milliseconds / o.frames;
    if (moment.sinceCut % 25 == 12) savePicture(o, fmt::format("flight_{:03}", i), screen);
  }
  return flown;
}

// The frames of the leg round a place, but for the first ones after the cut.
struct Window {
  int begin, end;
};
Window windowAt(const Options& o, int frame) {
  const int leg = o.legOf(frame), end = o.end(leg);
  return {std::min(std::max(o.begin(leg) + bench::kWarmUp, frame - kWindow), end - 1),
          std::min(end, frame + kWindow + 1)};
}

std::vector<int> placesOf(const Options& o) {
  std::vector<int> places;
  places.reserve(static_cast<std::size_t>(o.plainFrames));
  for (int i = 0; i < o.plainFrames; ++i) places.push_back((2 * i + 1) * o.frames / (2 * o.plainFrames));
  return places;
}

struct Counts {
  double samples = 0.0, fetches = 0.0;  // a pixel of the picture
  void add(const realtime::FrameCost& cost, double pixels) {
    samples += cost.densitySamples / pixels;
    fetches += cost.textureFetches / pixels;
  }
};

// One round of blocks, after another one that has filled them, at every place.
Counts countFlight(realtime::Offscreen& screen, const Options& o, const std::vector<int>& places) {
  Counts sum;
  screen.renderer().countSamples(true);
  for (const int place : places) {
    const int round = o.at(place).scene.quality.interleave * o.at(place).scene.quality.interleave;
    const int leg = o.legOf(place), begin = std::max(o.begin(leg), place - round);
    const int end = std::min(o.end(leg), begin + 2 * round), from = std::max(begin, end - round);
    screen.view().reset();
    screen.renderer().setScene(o.at(begin).scene);
    for (int i = begin; i < end; ++i) {
      bench::draw(screen, o.at(i));
      if (i >= from)
        sum.add(screen.renderer().lastCost(), static_cast<double>(o.width) * o.height * (end - from) * places.size());
    }
  }
  screen.renderer().countSamples(false);
  return sum;
}

// Single frames without shortcuts: seconds of each. What a flight would have at hand, tables of the sky and weather,
// is made by a small frame before.
std::vector<double> drawPlain(realtime::Offscreen& screen, const Options& o, const std::vector<int>& places,
                              Counts& counts) {
  const auto frameOf = [&](const Scene& scene, int share) {
    realtime::Frame frame =
        realtime::frameOf(scene.camera, std::max(o.width / share, 1), std::max(o.height / share, 1));
    frame.time = scene.time;
    return frame;
  };
  std::vector<double> seconds;
  for (const bool counting : {true, false})
    for (const int place : places) {
      Scene scene = o.at(place).scene;
      scene.quality = plainQuality(o.quality);
      screen.renderer().countSamples(counting);
      screen.renderer().setScene(scene);
      const realtime::Frame small = frameOf(scene, 8), whole = frameOf(scene, 1);
      screen.view().reset();
      screen.draw(small);
      screen.finish();
      if (counting) {
        counts.add(screen.renderer().lastCost(), static_cast<double>(small.width) * small.height * places.size());
        continue;
      }
      const double begin = bench::cpuSeconds();
      screen.draw(whole);
      screen.finish();
      seconds.push_back(bench::cpuSeconds() - begin);
      savePicture(o, fmt::format("plain_{:03}", place), screen);
    }
  return seconds;
}

struct Flip {
  double fast = 0.0, plain = 0.0;
};

// Both against path-traced pictures of a few of the places: the flight's march after 32 frames, the plain one's single
// frame.
Flip flipOf(const Options& o, const std::vector<int>& places) {
  const bench::Reference reference{o.folder, kFlipWidth, kFlipHeight, kFlipSamples};
  realtime::Offscreen screen(kFlipWidth, kFlipHeight);
  const int count = std::min<int>(kFlipPlaces, static_cast<int>(places.size()));
  Flip flip;
  for (int i = 0; i < count; ++i) {
    // Spread over the flight.
    const int place = places[static_cast<std::size_t>(i) * places.size() / static_cast<std::size_t>(count)];
    Scene scene = o.at(place).scene;
    const Image truth = reference.of(fmt::format("flight_{:03}", place), scene);
    const auto against = [&](const char* name, int frames) {
      const Image picture = bench::stillPicture(screen, scene, kFlipWidth, kFlipHeight, frames);
      const std::string stem = o.pictures.empty() ? "" : fmt::format("{}/flip_{:03}_{}", o.pictures, place, name);
      return bench::compare(truth, picture, stem).flip / count;
    };
    flip.fast += against("fast", kStillFrames);
    scene.quality = plainQuality(o.quality);
    flip.plain += against("plain", 1);
  }
  return flip;
}

std::string legRows(const Options& o, const std::vector<double>& seconds, std::vector<double>& warmUp) {
  std::string json;
  fmt::print("{:<12}{:>14}{:>14}{:>16}{:>16}{:>16}\n", "leg", "mean CPU s", "median", "first frame", "next 7, mean",
             "worst later");
  for (int leg = 0; leg < static_cast<int>(bench::kLegs.size()); ++leg) {
    const auto at = [&](int frame) { return seconds.begin() + std::min(frame, o.end(leg)); };
    const int begin = o.begin(leg);
    const std::vector<double> all(at(begin), at(o.end(leg))), next(at(begin + 1), at(begin + bench::kWarmUp));
    warmUp.insert(warmUp.end(), at(begin), at(begin + bench::kWarmUp));
    const char* name = bench::kLegs[static_cast<std::size_t>(leg)].name;
    const double worst = all.size() > bench::kWarmUp ? *std::max_element(all.begin() + bench::kWarmUp, all.end()) : 0.0;
    fmt::print("{:<12}{:>14.3f}{:>14.3f}{:>16.3f}{:>16.3f}{:>16.3f}\n", name, mean(all), bench::median(all),
               all.front(), mean(next), worst);
    json += fmt::format(
        "{}\"{}\": {{\"cpu_s\": {:.4f}, \"cpu_s_median\": {:.4f}, \"cpu_s_first\": {:.4f}, \"cpu_s_next\": {:.4f}, "
        "\"cpu_s_worst\": {:.4f}}}",
        json.empty() ? "" : ", ", name, mean(all), bench::median(all), all.front(), mean(next), worst);
  }
  std::fflush(stdout);
  return json;
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  using namespace welkin;
  Options o;
  CLI::App app{"Cost of a frame on a flight over the default sky, against a march without shortcuts."};
  o.addTo(app);
  app.add_option("--plain-frames", o.plainFrames, "places of the flight that are counted and drawn plain")
      ->check(CLI::Range(1, 300));
  app.add_flag("--plain,!--no-plain", o.plain, "draws the plain frames, which take half a minute each");
  app.add_flag("--flip,!--no-flip", o.flip, "path-traces two small pictures and compares");
  app.add_option("--folder", o.folder, "where path-traced pictures are kept");
  CLI11_PARSE(app, argc, argv);
  if (!o.pictures.empty()) std::filesystem::create_directories(o.pictures);
  const std::vector<int> places = placesOf(o);

  std::string json;
  {
    const double before = bench::cpuSeconds();
    realtime::Offscreen screen(o.width, o.height);
    // Elsewhere first: programs are compiled, and the flight still begins with nothing known of its place.
    bench::Moment elsewhere = o.at(0);
    elsewhere.scene.camera.position.x -= 1e6;
    for (int i = 0; i < bench::kWarmUp; ++i) {
      bench::draw(screen, elsewhere);
      elsewhere.sinceCut = 1;
      elsewhere.newScene = false;
    }
    screen.finish();
    const double setUp = bench::cpuSeconds() - before;
    const Flown flown = fly(screen, o);
    std::vector<double> warmUp;
    const std::string legs = legRows(o, flown.seconds, warmUp);
    std::string passes;
    for (const realtime::PassCost& pass : flown.passes)
      passes += fmt::format("{}\"{}\": {:.3f}", passes.empty() ? "" : ", ", pass.name, pass.milliseconds);
    std::size_t bytes = 0;
    for (const realtime::MemoryRow& row : screen.renderer().memory(screen.view())) bytes += row.bytes;
    fmt::print("passes, ms: {}\n{} bytes\n", passes, bytes);
    const Counts counts = countFlight(screen, o, places);
    fmt::print("{:.2f} density samples and {:.2f} fetches a pixel\n", counts.samples, counts.fetches);
    std::fflush(stdout);
    json = fmt::format(
        "\"cpu_s_per_frame\": {:.4f}, \"cpu_s_median\": {:.4f}, \"cpu_s_warm_up\": {:.4f}, \"cpu_s_set_up\": {:.3f}, "
        "\"samples_per_pixel\": {:.3f}, \"fetches_per_pixel\": {:.3f}, \"passes\": {{{}}}, \"memory_bytes\": {}, "
        "\"legs\": {{{}}}",
        mean(flown.seconds), bench::median(flown.seconds), mean(warmUp), setUp, counts.samples, counts.fetches, passes,
        bytes, legs);
    if (o.plain) {
      Counts plainCounts;
      const std::vector<double> plain = drawPlain(screen, o, places, plainCounts);
      std::vector<double> fast;
      fmt::print("{:<8}{:>12}{:>12}{:>8}\n", "frame", "CPU s", "plain", "ratio");
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Window window = windowAt(o, places[i]);
        fast.push_back(mean({flown.seconds.begin() + window.begin, flown.seconds.begin() + window.end}));
        fmt::print("{:<8}{:>12.3f}{:>12.3f}{:>8.1f}\n", places[i], fast.back(), plain[i], plain[i] / fast.back());
      }
      json += fmt::format(
          ", \"ratio_to_plain\": {:.2f}, \"plain_cpu_s_per_frame\": {:.3f}, \"plain_samples_per_pixel\": {:.2f}, "
          "\"samples_ratio\": {:.2f}",
          mean(plain) / mean(fast), mean(plain), plainCounts.samples, plainCounts.samples / counts.samples);
    }
  }
  if (o.flip) {
    const Flip flip = flipOf(o, places);
    json += fmt::format(", \"flip_fast\": {:.4f}, \"flip_plain\": {:.4f}", flip.fast, flip.plain);
  }
  fmt::print("{{\"width\": {}, \"height\": {}, \"frames\": {}, {}}}\n", o.width, o.height, o.frames, json);
}
