// The path tracer on the default sky at 160x90: paths, scatterings and density lookups a second of one core, and how
// much noise is left for the time (1 / (relative variance of a pixel x seconds)), for the air as a medium and from
// tables. CPU seconds of all threads.
#include <fmt/format.h>

#include <string>

#include "bench/harness.hpp"
#include "welkin/trace/path_tracer.hpp"

int main() {
  using namespace welkin;
  using bench::cpuSeconds;
  const Scene scene;
  std::string json;
  fmt::print("{:<8} {:>7} {:>9} {:>13} {:>12} {:>10} {:>11} {:>11}\n", "air", "bake s", "paths/s", "scatters/path",
             "lookups/path", "lookups/s", "lanes used", "efficiency");
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
    const double efficiency = (sum / n) * (sum / n) / (variance / n * seconds);
    const double paths = static_cast<double>(s.paths), lookups = static_cast<double>(s.lookups);
    const double scatterings = static_cast<double>(s.scatterings);
    const double used = lookups / static_cast<double>(s.turns * trace::laneCount());
    const char* name = air == trace::AirModel::medium ? "medium" : "tables";
    fmt::print("{:<8} {:>7.2f} {:>9.0f} {:>13.1f} {:>12.1f} {:>10.3g} {:>10.0f}% {:>11.3g}\n", name, baked - begin,
               paths / seconds, scatterings / paths, lookups / paths, lookups / seconds, 100.0 * used, efficiency);
    json += fmt::format(
        "{}\"{}\": {{\"bake_cpu_seconds\": {:.3f}, \"paths_per_second\": {:.0f}, \"scatterings_per_path\": {:.2f}, "
        "\"lookups_per_path\": {:.1f}, \"lookups_per_second\": {:.0f}, \"efficiency\": {:.4f}}}",
        json.empty() ? "" : ", ", name, baked - begin, paths / seconds, scatterings / paths, lookups / paths,
        lookups / seconds, efficiency);
  }
  fmt::print("{{\"lanes\": {}, {}}}\n", trace::laneCount(), json);
}
