#include "apps/welkin/film_frames.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/welkin/exposure_curve.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/io/png.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/scene/features.hpp"
#include "welkin/scene/sections.hpp"
#include "welkin/trace/denoise.hpp"

namespace welkin::app {

namespace {

constexpr int kStretch = 48;    // frames that depend on each other
constexpr int kWarmRounds = 2;  // of the interleave, drawn before a stretch begins
constexpr int kMeterWidth = 64, kMeterHeight = 36, kMeterSamples = 8;

// Draws until every pixel has been marched.
int interleaveOf(const Scene& scene) {
  const int edge = scene.quality.reprojection ? scene.quality.interleave : 1;
  return edge * edge;
}

// A film waits for its light.
Scene sceneOf(const Shot& shot, int frame) {
  Scene scene = shot.at(std::max(frame, 0));
  scene.quality.lightFrames = 1;
  return scene;
}

// The scene without what the renderer is told with every frame, or not at all.
Scene lightOf(Scene scene) {
  scene.title.clear();
  scene.film = Film{};
  scene.camera = Camera{};
  scene.time = 0.0f;
  return scene;
}

bool sameFiles(const Scene& a, const Scene& b) {
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                    [](const Layer& x, const Layer& y) {
                      return x.weather.map == y.weather.map && x.weather.precipitation == y.weather.precipitation &&
                             x.weather.type == y.weather.type;
                    }) &&
         std::equal(a.grids.begin(), a.grids.end(), b.grids.begin(), b.grids.end(),
                    [](const GridCloud& x, const GridCloud& y) { return sameFields(x, y); });
}

// A renderer that is told of a scene only what has changed.
class Stage {
 public:
  Stage(int width, int height) : screen_(width, height) {}
  void draw(const Scene& scene) {
    Scene light = lightOf(scene);
    if (!known_ || !sameScene(*known_, light)) {
      if (!known_ || !sameFiles(*known_, light)) textures_ = texturesOf(scene);
      screen_.renderer().setScene(scene, textures_);
      known_ = std::move(light);
    }
    screen_.draw(scene, scene.time);
    screen_.finish();
  }
  Image read() const { return screen_.read(); }

 private:
  realtime::Offscreen screen_;
  realtime::CustomTextures textures_;
  std::optional<Scene> known_;
};

void save(const Image& light, const Film& film, double ev, SampleDepth depth, const std::string& path) {
  const ToneSettings tone = toneOf(film, ev);
  if (depth == SampleDepth::bits8)
    return savePng(path, light.width, light.height, 3, displayBytes(light, tone), light.features);
  const Image shown = displayValues(light, tone);
  std::vector<std::uint16_t> samples(shown.pixels.size());
  std::transform(shown.pixels.begin(), shown.pixels.end(), samples.begin(),
                 [](float v) { return static_cast<std::uint16_t>(std::lround(65535.0f * v)); });
  savePng16(path, shown.width, shown.height, 3, samples);
}

// Small pictures of moments, coarse but for their light.
ExposureCurve meterDrawn(const Shot& shot, const Progress& progress) {
  std::optional<Stage> stage;
  return ExposureCurve(shot, [&](int frame) {
    report(progress, 0.0);
    if (!stage) stage.emplace(kMeterWidth, kMeterHeight);
    Scene scene = sceneOf(shot, frame);
    scene.quality = qualityPreset(QualityPreset::medium);
    scene.quality.lightFrames = scene.quality.historyScale = scene.quality.interleave = 1;
    stage->draw(scene);
    return stage->read();
  });
}

Image traced(const Scene& scene, int frame, const TraceOptions& options, const Progress& progress) {
  trace::TraceSettings settings = traceSettings(options);
  settings.frame = frame;
  const std::vector<Volume> maps = weatherMaps(scene);
  const std::vector<PlacedGrid> grids = loadGrids(scene);
  trace::PathTracer tracer(scene, {.weatherMaps = maps, .grids = grids}, settings);
  if (!tracer.run(progress)) throw Cancelled();
  const trace::TraceLayers layers = tracer.layers();
  Image light = options.denoise ? trace::denoise(layers) : layers.radiance;
  light.features = tracedFeaturesOf(scene);
  return light;
}

struct Span {
  int begin = 0, end = 0;
};

// The frames of a stretch that must be drawn: all up to the last one that the folder lacks.
Span missingIn(const FrameFolder& folder, int begin) {
  Span span{begin, begin};
  for (int i = begin; i < std::min(begin + kStretch, folder.frames()); ++i)
    if (!folder.has(i)) span.end = i + 1;
  return span;
}

}  // namespace

int drawsOf(const Shot& shot, const FrameOptions& options) {
  return options.draws > 0 ? options.draws : interleaveOf(shot.scene);
}

void drawFrames(const Shot& shot, const FrameOptions& options, FrameFolder& folder) {
  const int draws = drawsOf(shot, options);
  const int warmUp = (kWarmRounds * interleaveOf(shot.scene) + draws - 1) / draws;  // frames
  std::vector<Span> stretches;
  double all = 0.0, done = 0.0;  // draws
  for (int begin = 0; begin < folder.frames(); begin += kStretch) {
    const Span span = missingIn(folder, begin);
    if (span.begin == span.end) continue;
    stretches.push_back(span);
    all += static_cast<double>(span.end - span.begin + warmUp) * draws;
  }
  if (stretches.empty()) return;
  const ExposureCurve exposure = meterDrawn(shot, options.progress);
  for (const Span& span : stretches) {
    Stage stage(options.width, options.height);  // one that knows nothing of what was drawn before
    for (int frame = span.begin - warmUp; frame < span.end; ++frame) {
      const Scene scene = sceneOf(shot, frame);
      for (int i = 0; i < draws; ++i) {
        stage.draw(scene);
        report(options.progress, (done += 1.0) / all);
      }
      if (frame < span.begin || folder.has(frame)) continue;
      Image light = stage.read();
      light.features = featuresOf(scene);
      save(light, scene.film, exposure.ev(scene.film, shot.secondsAt(frame)), options.depth, folder.file(frame));
      folder.saved(frame);
    }
  }
}

void traceFrames(const Shot& shot, const FrameOptions& options, const TraceOptions& trace, FrameFolder& folder) {
  const int missing = folder.missing();
  if (missing == 0) return;
  TraceOptions meter;
  meter.width = kMeterWidth;
  meter.height = kMeterHeight;
  meter.samples = kMeterSamples;
  meter.air = "tables";
  const ExposureCurve exposure(
      shot, [&](int frame) { return traced(shot.at(frame), 0, meter, stageOf(options.progress, 0.0, 0.0)); });
  TraceOptions full = trace;
  full.width = options.width;
  full.height = options.height;
  int done = 0;
  for (int frame = 0; frame < folder.frames(); ++frame) {
    if (folder.has(frame)) continue;
    const Scene scene = shot.at(frame);
    const double begin = static_cast<double>(done) / missing, end = static_cast<double>(++done) / missing;
    const Image light = traced(scene, frame, full, stageOf(options.progress, begin, end));
    save(light, scene.film, exposure.ev(scene.film, shot.secondsAt(frame)), options.depth, folder.file(frame));
    folder.saved(frame);
  }
}

}  // namespace welkin::app
