// Generation of the four classic textures of 000 ch. 4.3.1 on the GPU and on the CPU, and of those of the shape
// "profile". Weather is what the renderer caches: four clip levels of one layer.
// Medians of five; CPU seconds are summed over all threads (and are the driver's too, where the GPU is software).
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/harness.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/noise/textures.hpp"
#include "welkin/realtime/noise_textures.hpp"
#include "welkin/realtime/shader_sources.hpp"
#include "welkin/realtime/weather_levels.hpp"

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
  std::function<void()> gpu, cpu;
};

constexpr WeatherExtent kWeather;

// Draws the clip levels.
class WeatherOnTheGpu {
 public:
  WeatherOnTheGpu(const gl::Api& gl, LayerShape shape) : gl_(gl) {
    layer_.cloud.shape = shape;
    program_ =
        gl::Program(gl, "weather", "", std::string(realtime::shaderSource("welkin/realtime/shaders/weather.frag.glsl")),
                    realtime::shaderSource);
    white_ = realtime::textureFromVolume(gl, Volume(1, 1, 1, 4));
  }
  void draw() const {
    realtime::WeatherLevels levels(gl_, kWeather, 1, false);
    gl::Framebuffer framebuffer(gl_);
    gl::UniformBuffer buffer(gl_);
    const gl::VertexArray triangle(gl_);
    gl_.BindVertexArray(triangle.id());
    levels.update(0, layer_, {0.0, 0.0}, {}, 1, program_, framebuffer, buffer, white_);
  }

 private:
  const gl::Api& gl_;
  Layer layer_;
  gl::Program program_;
  gl::Texture white_;
};

void bakeLevels(LayerShape shape) {
  Layer layer;
  layer.cloud.shape = shape;
  for (int level = 0; level < kWeather.levels; ++level)
    bakeWeather(layer, {0.0, 0.0}, kWeather.finest * std::pow(kWeather.ratio, level), kWeather.texels, {}, 1);
}

}  // namespace

int main() {
  const gl::Context context;
  const gl::Api gl = gl::loadApi(context.loader());
  const WeatherOnTheGpu nubisWeather(gl, LayerShape::nubis), profileWeather(gl, LayerShape::profile);
  const std::vector<Row> rows = {
      {"base shape 128^3 RGBA", "base", "", [&] { realtime::generateBaseShape(gl, {}); }, [] { bakeBaseShape({}); }},
      {"detail 32^3 RGB", "detail", "", [&] { realtime::generateDetail(gl, {}); }, [] { bakeDetail({}); }},
      {"curl 128^2 RG", "curl", "", [&] { realtime::generateCurl(gl, {}); }, [] { bakeCurl({}); }},
      {"weather 512^2 RGBA x 4", "weather", "", [&] { nubisWeather.draw(); }, [] { bakeLevels(LayerShape::nubis); }},
      {"profile base 128^3 R", "profile_base", "profile_", [&] { realtime::generateProfileBasePacked(gl, {}, 0.75f); },
       [] { bakeProfileBasePacked({}, 0.75f); }},
      {"profile detail 64^3 RG", "profile_detail", "profile_", [&] { realtime::generateProfileDetail(gl, {}); },
       [] { bakeProfileDetail({}); }},
      {"profile warp 32^3 RG", "profile_warp", "profile_", [&] { realtime::generateProfileWarp(gl, {}); },
       [] { bakeProfileWarp({}); }},
      {"profile weather, as above", "profile_weather", "profile_", [&] { profileWeather.draw(); },
       [] { bakeLevels(LayerShape::profile); }},
  };

  std::map<std::string, double> result;
  fmt::print("{:<26}{:>14}{:>14}{:>14}{:>14}\n", "", "GPU wall, ms", "GPU CPU, ms", "CPU wall, ms", "CPU CPU, ms");
  for (const Row& row : rows) {
    const Cost gpu = measure([&] {
      row.gpu();
      gl.Finish();
    });
    const Cost cpu = measure(row.cpu);
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
