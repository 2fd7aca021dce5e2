// What drops cost: a rainy sky at 640x360 with so many drops held in the picture, standing still and with the eye and
// the time moving on. Milliseconds are medians of whole frames, by the clock and of CPU time of all threads.
#include <fmt/format.h>

#include <string>

#include "bench/harness.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/offscreen.hpp"

namespace {

struct Row {
  int asked, drawn;
  double milliseconds, cpu;  // of a frame
};

welkin::Scene rainySky() {
  welkin::Scene scene;
  welkin::Layer& layer = scene.layers.front();
  layer.cloud.base = 900.0f;
  layer.cloud.thickness = 2500.0f;
  layer.weather.population = welkin::Population::uniform;
  layer.weather.coverage = 1.0f;
  layer.weather.precipitation = 1.0f;
  scene.precipitation.rate = 12.0f;
  scene.precipitation.evaporation = 0.0f;
  scene.camera.position.z = 40.0;
  scene.quality = welkin::qualityPreset(welkin::QualityPreset::low);
  return scene;
}

Row measure(welkin::realtime::Offscreen& screen, welkin::Scene scene, int particles, int width, int height) {
  constexpr int kWarm = 16, kRuns = 24;
  constexpr double kFrameTime = 1.0 / 30.0;  // s
  scene.precipitation.particles = particles;
  screen.renderer().setScene(scene);
  screen.view().reset();
  std::vector<double> times, cpu;
  int drawn = 0;
  for (int i = 0; i < kWarm + kRuns; ++i) {
    welkin::realtime::Frame frame = welkin::realtime::frameOf(scene.camera, width, height);
    frame.time = kFrameTime * i;
    frame.position.y += 0.1 * i;
    const double begin = welkin::bench::wallSeconds(), cpuBegin = welkin::bench::cpuSeconds();
    screen.draw(frame);
    screen.finish();
    if (i < kWarm) continue;
    times.push_back(1000.0 * (welkin::bench::wallSeconds() - begin));
    cpu.push_back(1000.0 * (welkin::bench::cpuSeconds() - cpuBegin));
    drawn = screen.renderer().lastCost().particles;
  }
  return {particles, drawn, welkin::bench::median(times), welkin::bench::median(cpu)};
}

}  // namespace

int main() {
  constexpr int kWidth = 640, kHeight = 360;
  welkin::realtime::Offscreen screen(kWidth, kHeight);
  const welkin::Scene scene = rainySky();
  fmt::print("{:>10}{:>10}{:>14}{:>12}{:>10}\n", "asked for", "drawn", "ms a frame", "CPU ms", "frames/s");
  std::string json;
  for (const int particles : {0, 2000, 20000, 200000}) {
    const Row row = measure(screen, scene, particles, kWidth, kHeight);
    fmt::print("{:>10}{:>10}{:>14.1f}{:>12.1f}{:>10.1f}\n", row.asked, row.drawn, row.milliseconds, row.cpu,
               1000.0 / row.milliseconds);
    json += fmt::format("{}{{\"asked\": {}, \"drawn\": {}, \"ms\": {:.2f}, \"ms_cpu\": {:.2f}, \"fps\": {:.2f}}}",
                        json.empty() ? "" : ", ", row.asked, row.drawn, row.milliseconds, row.cpu,
                        1000.0 / row.milliseconds);
  }
  fmt::print("{{\"width\": {}, \"height\": {}, \"rows\": [{}]}}\n", kWidth, kHeight, json);
}
