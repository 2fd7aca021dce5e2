// What `welkin view` and `welkin fly` take for a frame while something moves: scripts of two lengths without a window,
// so that the difference is that of the frames alone, once light and governor have settled. With the sky's own quality,
// and with quality that gives way for 25 frames a second. And how long a run of a single frame takes, start and end of
// the process included.
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

Run run(const std::string& command, const std::string& size, const std::string& text, int rounds) {
  const std::filesystem::path script = std::filesystem::temp_directory_path() / "welkin_bench_viewer.txt";
  std::ofstream(script) << text;
  const std::string whole = fmt::format("'{}/bin/welkin' {} --headless --size {} --script {}", WELKIN_BINARY_DIR,
                                        command, size, script.string());
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
  app.add_option("--frames", frames, "counted of each run; of those that are governed ten times as many")
      ->check(CLI::Range(4, 10000));
  app.add_option("--rounds", rounds, "of which the median counts")->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);

  struct Case {
    const char *name, *command, *script;
  };
  constexpr Case kCases[] = {{"view", "view", "key f9\nhold w {}\n"},
                             {"fly", "fly --start below", "fly {} throttle=0.8 bank=0.2\n"}};
  constexpr int kSettling = 80;  // frames after which light is complete and the governor has found its way
  constexpr int kGoverned = 10;  // times as many of those that are governed, which are short beside the process's start
  std::string rows;
  for (const Case& c : kCases)
    for (const char* size : {"640x360", "1280x720"})
      for (const bool governed : {false, true}) {
        const std::string command = std::string(c.command) + (governed ? " --rate 25" : " --scale 1");
        const auto measure = [&](int drawn) {
          return run(command, size, fmt::format(fmt::runtime(c.script), drawn), rounds);
        };
        run(command, size, "frames 1\n", 1);  // compiles the shaders
        const int counted = governed ? kGoverned * frames : frames;
        const Run first = measure(kSettling), all = measure(kSettling + counted);
        const double wall = (all.wall - first.wall) / counted, cpu = (all.cpu - first.cpu) / counted;
        const std::string what = fmt::format("{} {}{}", c.name, size, governed ? " governed" : "");
        std::string start, startJson;
        if (!governed) {
          const double seconds = run(command + " --rate 25", size, "frames 1\n", rounds).wall;
          start = fmt::format(", one frame alone {:.2f} s", seconds);
          startJson = fmt::format(", \"start_s\": {:.3f}", seconds);
        }
        fmt::print("{}: {:.1f} frames a second, {:.3f} CPU s a frame{}\n", what, 1.0 / wall, cpu, start);
        std::fflush(stdout);
        rows += fmt::format(
            "{}{{\"what\": \"{}\", \"size\": \"{}\", \"governed\": {}, \"frames_a_second\": {:.2f}, "
            "\"cpu_s_a_frame\": {:.4f}{}}}",
            rows.empty() ? "" : ", ", c.name, size, governed, 1.0 / wall, cpu, startJson);
      }
  fmt::print("{{\"frames\": {}, \"rows\": [{}]}}\n", frames, rows);
}
