// Generation of the classic textures of 000 ch. 4.3.1 on the GPU and on the CPU, and of those of the shape "profile".
// Medians of five; CPU seconds are summed over all threads (and are the driver's too, where the GPU is software).
#include <fmt/format.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/harness.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/noise/textures.hpp"
#include "welkin/realtime/noise_textures.hpp"

namespace {

using namespace welkin;

struct Cost {
  double wall = 0, cpu = 0;
};

Cost measure(const std::function<void()>& work) {
  work();  // the first run compiles shaders and wakes threads
  std::vector<double> wall, cpu;
  for (int i = 0; i < 5; ++i) {
    const double w = bench::wallSeconds(), c = bench::cpuSeconds();
    work();
    wall.push_back(bench::wallSeconds() - w);
    cpu.push_back(bench::cpuSeconds() - c);
  }
  return {bench::median(wall), bench::median(cpu)};
}

struct Row {
  const char* name;
  const char* key;
  const char* set;  // which sum of the last line it belongs to
  std::function<gl::Texture(const gl::Api&)> gpu;
  std::function<Volume()> cpu;
};

}  // namespace

int main() {
  const gl::Context context;
  const gl::Api gl = gl::loadApi(context.loader());
  const std::vector<Row> rows = {
      {"base shape 128^3 RGBA", "base", "", [](const gl::Api& a) { return realtime::generateBaseShape(a, {}); },
       [] { return bakeBaseShape({}); }},
      {"detail 32^3 RGB", "detail", "", [](const gl::Api& a) { return realtime::generateDetail(a, {}); },
       [] { return bakeDetail({}); }},
      {"curl 128^2 RG", "curl", "", [](const gl::Api& a) { return realtime::generateCurl(a, {}); },
       [] { return bakeCurl({}); }},
      {"profile base 128^3 R", "profile_base", "profile_",
       [](const gl::Api& a) { return realtime::generateProfileBasePacked(a, {}, 0.75f); },
       [] { return bakeProfileBasePacked({}, 0.75f); }},
      {"profile detail 64^3 RG", "profile_detail", "profile_",
       [](const gl::Api& a) { return realtime::generateProfileDetail(a, {}); }, [] { return bakeProfileDetail({}); }},
      {"profile warp 32^3 RG", "profile_warp", "profile_",
       [](const gl::Api& a) { return realtime::generateProfileWarp(a, {}); }, [] { return bakeProfileWarp({}); }},
  };

  std::map<std::string, double> result;
  fmt::print("{:<26}{:>14}{:>14}{:>14}{:>14}\n", "", "GPU wall, ms", "GPU CPU, ms", "CPU wall, ms", "CPU CPU, ms");
  for (const Row& row : rows) {
    const Cost gpu = measure([&] {
      const gl::Texture texture = row.gpu(gl);
      gl.Finish();
    });
    const Cost cpu = measure([&] { row.cpu(); });
    fmt::print("{:<26}{:>14.2f}{:>14.2f}{:>14.2f}{:>14.2f}\n", row.name, 1e3 * gpu.wall, 1e3 * gpu.cpu, 1e3 * cpu.wall,
               1e3 * cpu.cpu);
    const std::string key = row.key, set = row.set;
    result[key + "_gpu_cpu_s"] = gpu.cpu;
    result[key + "_cpu_cpu_s"] = cpu.cpu;
    result[set + "gpu_cpu_s"] += gpu.cpu;
    result[set + "cpu_cpu_s"] += cpu.cpu;
    result[set + "gpu_wall_s"] += gpu.wall;
    result[set + "cpu_wall_s"] += cpu.wall;
  }
  std::string json;
  for (const auto& [key, value] : result) json += fmt::format("{}\"{}\": {:.5f}", json.empty() ? "" : ", ", key, value);
  fmt::print("{{{}}}\n", json);
}
