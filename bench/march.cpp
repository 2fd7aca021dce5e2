// The table of optimisations of 000 ch. 4.6 on a "nubis" sky at 640x360: each row adds one shortcut to the rows
// above. Milliseconds are medians of whole frames on this machine; samples are density samples a pixel of the frame.
#include <fmt/format.h>

#include <string>

#include "bench/harness.hpp"
#include "welkin/realtime/offscreen.hpp"

namespace {

struct Row {
  std::string name;
  double milliseconds, samplesPerPixel, fetchesPerPixel;
};

welkin::Scene nubisSky() {
  welkin::Scene scene;
  welkin::Layer& layer = scene.layers.front();
  layer.cloud.shape = welkin::LayerShape::nubis;
  layer.cloud.base = 1500.0f;
  layer.cloud.thickness = 3500.0f;
  layer.cloud.extinction = 0.06f;
  layer.weather.coverage = 0.55f;
  layer.weather.type = 0.8f;
  scene.lighting.model = welkin::LightingModel::nubis;
  scene.lighting.forwardG = 0.2f;
  scene.camera.pitch = 0.35f;
  scene.quality = welkin::qualityPreset(welkin::QualityPreset::ultra);
  scene.quality.stepsByAngle = scene.quality.earlyExit = scene.quality.cheapSearch = scene.quality.reprojection = false;
  scene.quality.interleave = 4;
  return scene;
}

Row measure(const std::string& name, welkin::realtime::Offscreen& screen, const welkin::Scene& scene, int runs,
            double pixels) {
  screen.view().reset();
  screen.renderer().setScene(scene);
  screen.renderer().countSamples(true);
  screen.draw(scene, 0.0);
  const welkin::realtime::FrameCost cost = screen.renderer().lastCost();
  const double samples = cost.densitySamples / pixels, fetches = cost.textureFetches / pixels;
  screen.renderer().countSamples(false);
  screen.view().reset();
  // The first round fills the pixels that no frame has marched yet; after it every frame costs the same.
  const int round = scene.quality.reprojection ? scene.quality.interleave * scene.quality.interleave : 1;
  for (int i = 0; i < round; ++i) screen.draw(scene, 0.0);
  screen.finish();
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    const double begin = welkin::bench::wallSeconds();
    screen.draw(scene, 0.0);
    screen.finish();
    times.push_back(1000.0 * (welkin::bench::wallSeconds() - begin));
  }
  return {name, welkin::bench::median(times), samples, fetches};
}

}  // namespace

int main() {
  constexpr int kWidth = 640, kHeight = 360;
  welkin::realtime::Offscreen screen(kWidth, kHeight);
  welkin::Scene scene = nubisSky();
  std::vector<Row> rows;
  const auto add = [&](const char* name, int runs) {
    rows.push_back(measure(name, screen, scene, runs, static_cast<double>(kWidth) * kHeight));
  };
  add("nothing", 3);
  scene.quality.stepsByAngle = true;
  add("fewer steps by angle", 3);
  scene.quality.earlyExit = true;
  add("early exit", 3);
  scene.quality.cheapSearch = true;
  add("cheap and full samples", 3);
  scene.quality.reprojection = true;
  add("4x4 reprojection", 16);

  fmt::print("{:<26}{:>12}{:>16}{:>16}{:>10}\n", "optimisation", "ms a frame", "samples/pixel", "fetches/pixel",
             "speed-up");
  std::string json;
  for (const Row& row : rows) {
    fmt::print("{:<26}{:>12.1f}{:>16.2f}{:>16.2f}{:>10.2f}\n", row.name, row.milliseconds, row.samplesPerPixel,
               row.fetchesPerPixel, rows.front().milliseconds / row.milliseconds);
    json += fmt::format(
        "{}{{\"name\": \"{}\", \"ms\": {:.2f}, \"samples_per_pixel\": {:.3f}, \"fetches_per_pixel\": {:.3f}}}",
        json.empty() ? "" : ", ", row.name, row.milliseconds, row.samplesPerPixel, row.fetchesPerPixel);
  }
  fmt::print("{{\"speedup_all\": {:.2f}, \"samples_ratio\": {:.2f}, \"rows\": [{}]}}\n",
             rows.front().milliseconds / rows.back().milliseconds,
             rows.front().samplesPerPixel / rows.back().samplesPerPixel, json);
}
