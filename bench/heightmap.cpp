// A height map of 002 with its smoothing, 2048 x 2048 elements: the source's own took 40 ms without smoothing at best.
// Medians of nine, each with another seed.
#include <fmt/format.h>

#include "bench/harness.hpp"
#include "welkin/density/classical/height_map.hpp"

int main() {
  using namespace welkin;
  struct Row {
    const char* name;
    HeightMapSettings settings;
  };
  const Row rows[] = {{"cumulus", {.squares = 140, .amplitude = 1.0f, .octaves = 3, .step = 0.3f, .smoothing = 12}},
                      {"cirrus", {.squares = 500, .amplitude = 0.9f, .octaves = 4, .step = 1.0f, .smoothing = 12}}};
  double worst = 0.0;
  for (const Row& row : rows) {
    std::vector<double> wall, cpu;
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
      const double w = bench::wallSeconds(), c = bench::cpuSeconds();
      const HeightMap map = bakeHeightMap(row.settings, seed);
      if (seed == 0) continue;  // wakes the threads
      wall.push_back(1e3 * (bench::wallSeconds() - w));
      cpu.push_back(1e3 * (bench::cpuSeconds() - c));
    }
    fmt::print("{:<8} {} octaves, {} times smoothed: {:6.2f} ms, {:6.2f} ms of CPU\n", row.name, row.settings.octaves,
               row.settings.smoothing, bench::median(wall), bench::median(cpu));
    worst = std::max(worst, bench::median(wall));
  }
  fmt::print("{{\"bench\": \"heightmap\", \"ms_2048\": {:.3f}}}\n", worst);
}
