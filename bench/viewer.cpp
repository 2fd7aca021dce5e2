// What `welkin view` and `welkin fly` take for a frame while something moves, and until their first one: scripts of two
// lengths without a window, so that the difference is that of the frames alone.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/harness.hpp"

namespace welkin {
namespace {

struct Run {
  double wall = 0.0, cpu = 0.0;  // s
};

Run run(const std::string& command, const std::string& size, const std::string& line, int frames, int rounds) {
  const std::filesystem::path script = std::filesystem::temp_directory_path() / "welkin_bench_viewer.txt";
  std::ofstream(script) << fmt::format(fmt::runtime(line), frames);
  const std::string whole = fmt::format("'{}/bin/welkin' {} --headless --scale 1 --size {} --script {}",
                                        WELKIN_BINARY_DIR, command, size, script.string());
  std::vector<double> walls, cpus;
  for (int i = 0; i < rounds; ++i) {
    const double wall = bench::wallSeconds(), cpu = bench::childSeconds();
    if (std::system(whole.c_str()) != 0) {
      fmt::print(stderr, "'{}' has failed\n", whole);
      std::exit(1);
    }
    walls.push_back(bench::wallSeconds() - wall);
    cpus.push_back(bench::childSeconds() - cpu);
  }
  std::filesystem::remove(script);
  return {bench::median(walls), bench::median(cpus)};
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  using namespace welkin;
  int frames = 40, rounds = 3;
  CLI::App app{"Frames a second of `welkin view` and `welkin fly`, and how long until the first."};
  app.add_option("--frames", frames, "of the longer script")->check(CLI::Range(4, 10000));
  app.add_option("--rounds", rounds, "of which the median counts")->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);

  struct Case {
    const char *name, *command, *script;
  };
  constexpr Case kCases[] = {{"view", "view", "key f9\nhold w {}\n"},
                             {"fly", "fly --start below", "fly {} throttle=0.8 bank=0.2\n"}};
  std::string rows;
  for (const Case& c : kCases)
    for (const char* size : {"640x360", "1280x720"}) {
      const Run first = run(c.command, size, c.script, 2, rounds),
                all = run(c.command, size, c.script, 2 + frames, rounds);
      const double wall = (all.wall - first.wall) / frames, cpu = (all.cpu - first.cpu) / frames;
      const double start = first.wall - 2.0 * wall;
      fmt::print("{} {}: {:.1f} frames a second, {:.3f} CPU s a frame, first frame after {:.2f} s\n", c.name, size,
                 1.0 / wall, cpu, start);
      std::fflush(stdout);
      rows += fmt::format(
          "{}{{\"what\": \"{}\", \"size\": \"{}\", \"frames_a_second\": {:.2f}, \"cpu_s_a_frame\": {:.4f}, "
          "\"start_s\": {:.3f}}}",
          rows.empty() ? "" : ", ", c.name, size, 1.0 / wall, cpu, start);
    }
  fmt::print("{{\"frames\": {}, \"rows\": [{}]}}\n", frames, rows);
}
