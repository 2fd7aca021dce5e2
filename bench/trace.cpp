// The path tracer on the default sky at 160x90: paths, scatterings and density lookups a second of one core, and how
// much noise is left for the time, for the air as a medium and from tables. CPU seconds of all threads.
#include <fmt/format.h>

#include <ctime>
#include <string>

#include "bench/harness.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace {
double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
}  // namespace

int main() {
  using namespace welkin;
  const Scene scene;
  std::string json;
  fmt::print("{:<8} {:>9} {:>10} {:>12} {:>12} {:>10} {:>10} {:>14}\n", "air", "bake s", "paths/s", "scatter/path",
             "lookup/path", "lookups/s", "lanes used", "efficiency");
  for (const auto air : {trace::AirModel::medium, trace::AirModel::tables}) {
    const double begin = cpuSeconds();
    trace::PathTracer tracer(scene, {}, {.width = 160, .height = 90, .samples = 32, .air = air});
    const double baked = cpuSeconds();
    tracer.run({});
    const double seconds = cpuSeconds() - baked;
    const trace::KernelStatistics& s = tracer.statistics();
    const trace::TraceLayers layers = tracer.layers();
    double variance = 0.0, sum = 0.0;
    for (const float v : layers.variance.pixels) variance += v;
    for (std::size_t i = 0; i < layers.radiance.pixels.size(); i += 3)
      sum += 0.2126 * layers.radiance.pixels[i] + 0.7152 * layers.radiance.pixels[i + 1] +
             0.0722 * layers.radiance.pixels[i + 2];
    const double n = static_cast<double>(layers.variance.pixels.size());
    const double relative = variance / n / ((sum / n) * (sum / n));
    const double paths = static_cast<double>(s.paths), lookups = static_cast<double>(s.lookups);
    const char* name = air == trace::AirModel::medium ? "medium" : "tables";
    fmt::print("{:<8} {:>9.2f} {:>10.0f} {:>12.1f} {:>12.1f} {:>10.3g} {:>10.2f} {:>14.4g}   strides {:.2f}\n", name, baked - begin,
               paths / seconds, static_cast<double>(s.scatterings) / paths, lookups / paths, lookups / seconds,
               lookups / static_cast<double>(s.turns) / static_cast<double>(trace::laneCount()), 1.0 / (relative * seconds), double(s.strides)/double(s.turns));
    json += fmt::format("{}\"{}\": {{\"bake_cpu_seconds\": {:.3f}, \"paths_per_second\": {:.0f}, "
                        "\"scatterings_per_path\": {:.2f}, \"lookups_per_path\": {:.1f}, \"lookups_per_second\": {:.0f}, "
                        "\"efficiency\": {:.4f}}}",
                        json.empty() ? "" : ", ", name, baked - begin, paths / seconds,
                        static_cast<double>(s.scatterings) / paths, lookups / paths, lookups / seconds,
                        1.0 / (relative * seconds));
  }
  fmt::print("{{\"lanes\": {}, {}}}\n", trace::laneCount(), json);
}
