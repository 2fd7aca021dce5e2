// What the governor's rungs cost and lose on the flight of flight.hpp, and how well it holds a target there. The time
// of a frame is the CPU time of the process for it, all threads.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "bench/flight.hpp"
#include "welkin/base/metrics.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/realtime/governor.hpp"

namespace welkin {
namespace {

struct Options : bench::FlightOptions {
  double share = 0.7;
  int rungLeg = 2, rungFrames = 24;
};

struct Rung {
  double seconds = 0.0;                    // median
  std::vector<realtime::PassCost> passes;  // of the last frame
  Image picture;                           // of the last frame
};

// Some frames of one leg, always of the same quality.
Rung flyRung(realtime::Offscreen& screen, const Options& o, const Quality& quality) {
  Rung rung;
  std::vector<double> seconds;
  const int begin = bench::kLegFrames * o.rungLeg;
  for (int i = 0; i < o.rungFrames + bench::kWarmUp; ++i) {
    bench::Moment moment = bench::FlightOptions{}.at(begin + i);
    moment.scene.quality = quality;
    seconds.push_back(bench::drawTimed(screen, moment));
  }
  rung.seconds = bench::median({seconds.begin() + bench::kWarmUp, seconds.end()});
  rung.passes = screen.renderer().lastCost().passes;
  rung.picture = screen.read();
  return rung;
}

std::string describe(const Quality& q) {
  return fmt::format("history {} interleave {} steps {:.2f} light {}", q.historyScale, q.interleave, q.stepScale,
                     q.lightSteps);
}

// The whole flight with a governor; the table of its decisions goes to the terminal.
std::string flyGoverned(realtime::Offscreen& screen, const Options& o, const realtime::GovernorSettings& settings) {
  realtime::Governor governor(settings);
  int changes = 0, over = 0, longest = 0, run = 0, frames = 0;
  double sum = 0.0, rungs = 0.0;
  for (int i = 0; i < o.frames; ++i) {
    bench::Moment moment = o.at(i);
    moment.scene.quality = governor.quality();
    if (moment.sinceCut == 0) governor.cut();
    const double seconds = bench::drawTimed(screen, moment);
    if (moment.sinceCut >= bench::kWarmUp) {
      ++frames;
      sum += seconds;
      rungs += static_cast<double>(governor.rung());
      const bool late = seconds > 1.1 * settings.target;
      over += late ? 1 : 0;
      run = late ? run + 1 : 0;
      longest = std::max(longest, run);
    }
    if (!governor.take(seconds)) continue;
    ++changes;
    screen.renderer().setQuality(governor.quality());
    fmt::print("frame {:3}, {:.4f} s: rung {}, {}\n", i, seconds, governor.rung(), describe(governor.quality()));
  }
  return fmt::format(
      "\"target_s\": {:.4f}, \"governed_s_mean\": {:.4f}, \"frames_over\": {:.4f}, \"longest_over\": {}, "
      "\"changes\": {}, \"rung_mean\": {:.2f}",
      settings.target, sum / frames, static_cast<double>(over) / frames, longest, changes, rungs / frames);
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  using namespace welkin;
  Options o;
  CLI::App app{"Cost and likeness of the governor's rungs, and a flight that it governs."};
  o.addTo(app);
  app.add_option("--share", o.share, "target of the governed flight, as a share of what the best rung costs")
      ->check(CLI::Range(0.05, 5.0));
  app.add_option("--leg", o.rungLeg, "of the flight on which the rungs are measured")->check(CLI::Range(0, 3));
  CLI11_PARSE(app, argc, argv);

  realtime::GovernorSettings settings;
  settings.best = qualityPreset(o.quality);
  realtime::Offscreen screen(o.width, o.height);
  std::string rows;
  Rung first;
  const std::vector<Quality> rungs = realtime::Governor(settings).rungs();
  for (const Quality& quality : rungs) {
    const Rung rung = flyRung(screen, o, quality);
    if (rows.empty()) first = rung;
    const ToneSettings tone{.ev = static_cast<float>(automaticEv(first.picture))};
    const double like =
        rows.empty() ? 99.0 : psnr(displayValues(first.picture, tone), displayValues(rung.picture, tone));
    fmt::print("{:<48}{:.4f} CPU s, {:.2f} of the best (expected {:.2f}), {:.1f} dB;", describe(quality), rung.seconds,
               rung.seconds / first.seconds, realtime::relativeCost(quality) / realtime::relativeCost(settings.best),
               like);
    for (const realtime::PassCost& pass : rung.passes) fmt::print(" {} {:.1f}", pass.name, pass.milliseconds);
    fmt::print(" ms\n");
    std::fflush(stdout);
    rows += fmt::format("{}{{\"quality\": \"{}\", \"cpu_s\": {:.4f}, \"psnr\": {:.2f}}}", rows.empty() ? "" : ", ",
                        describe(quality), rung.seconds, like);
  }
  settings.target = o.share * first.seconds;
  const std::string governed = flyGoverned(screen, o, settings);
  fmt::print("{{\"width\": {}, \"height\": {}, \"frames\": {}, \"rungs\": [{}], {}}}\n", o.width, o.height, o.frames,
             rows, governed);
}
