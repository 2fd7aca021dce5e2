// Steps a second of the automaton of 256 x 256 x 64 cells, in regions and in a whole box where every cell is drawn for.
#include <fmt/format.h>

#include <limits>

#include "bench/harness.hpp"
#include "welkin/density/classical/automaton.hpp"

int main() {
  using namespace welkin;
  constexpr int kSteps = 100;
  double least = std::numeric_limits<double>::infinity();
  for (const int regions : {8, 0}) {
    AutomatonSettings settings{.width = 256, .breadth = 256, .height = 64, .regions = regions};
    Automaton automaton(settings, 1);
    for (int i = 0; i < 60; ++i) automaton.advance();
    std::vector<double> seconds;
    const double cpu = bench::cpuSeconds();
    for (int round = 0; round < 5; ++round) {
      const double start = bench::wallSeconds();
      for (int i = 0; i < kSteps; ++i) automaton.advance();
      seconds.push_back((bench::wallSeconds() - start) / kSteps);
    }
    const double cpuStep = (bench::cpuSeconds() - cpu) / (5 * kSteps);
    const double start = bench::wallSeconds();
    double share = 0.0;
    for (const float v : smoothCloud(settings, std::span(&automaton.clouds(), 1))) share += v;
    share /= 256.0 * 256.0 * 64.0;
    const double rate = 1.0 / bench::median(seconds);
    fmt::print(
        "{:<9} {:6.0f} steps a second, {:.2f} ms of CPU each; cloud in {:.1f} % of the cells; smooth density {:.0f} "
        "ms\n",
        regions ? "regions" : "whole box", rate, 1e3 * cpuStep, 100.0 * share, 1e3 * (bench::wallSeconds() - start));
    least = std::min(least, rate);
  }
  fmt::print("{{\"bench\": \"automaton\", \"steps_per_second\": {:.1f}}}\n", least);
}
