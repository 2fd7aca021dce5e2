#pragma once
// The real-time picture against the path-traced one. Both without the sun's disc, which would outshine all else.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include "welkin/base/flip.hpp"
#include "welkin/base/metrics.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/trace/denoise.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::bench {

// Where references are kept, and what they are like.
struct Reference {
  std::string folder;
  int width = 640, height = 360;
  int samples = 256;

  std::string file(const std::string& name, Scene scene) const {
    scene.quality = {};  // a path tracer has none
    const std::string key = fmt::format("{}\n{}x{} {}", writeSky(scene), width, height, samples);
    return fmt::format("{}/{}_{}x{}_{:016x}.exr", folder, name, width, height, std::hash<std::string>{}(key));
  }

  // RGB, and the share of paths that met a cloud: path-traced with the air as a medium and denoised, once; a second
  // time it is read from the folder.
  Image of(const std::string& name, const Scene& scene) const {
    const std::string path = file(name, scene);
    if (std::filesystem::exists(path)) return loadExr(path);
    trace::PathTracer tracer(
        scene, {}, {.width = width, .height = height, .samples = samples, .sunDisc = trace::SunDisc::leftOut});
    tracer.run({});
    const trace::TraceLayers layers = tracer.layers();
    const Image smooth = trace::denoise(layers);
    Image result(width, height, 4);
    for (std::size_t i = 0; i < layers.transmittance.pixels.size(); ++i) {
      std::copy_n(&smooth.pixels[3 * i], 3, &result.pixels[4 * i]);
      result.pixels[4 * i + 3] = 1.0f - layers.transmittance.pixels[i];
    }
    std::filesystem::create_directories(folder);
    saveExr(path, result, ExrPrecision::full);
    return result;
  }
};

// The scene after so many frames of a camera that stands still. `screen` is of that size.
inline Image stillPicture(realtime::Offscreen& screen, const Scene& scene, int width, int height, int frames) {
  screen.view().reset();
  screen.renderer().setScene(scene);
  realtime::Frame frame = realtime::frameOf(scene.camera, width, height);
  frame.time = scene.time;
  frame.output = realtime::Output::lightWithoutSunDisc;
  for (int i = 0; i < frames; ++i) screen.draw(frame);
  return screen.read();
}

struct Error {
  double flip = 0.0, flipCloud = 0.0, relMse = 0.0;
  double ratio = 1.0;  // of mean luminances, real-time over path-traced
};

// How far a picture is from what Reference::of answers. `stem`: where both pictures and their difference are kept, if
// it is not empty.
inline Error compare(const Image& truth, const Image& frame, const std::string& stem) {
  const Image rgb = withoutAlpha(truth);
  const ToneSettings tone{.ev = static_cast<float>(automaticEv(rgb))};
  const Image a = displayValues(rgb, tone), b = displayValues(frame, tone);
  const Image map = flipMap(a, b);
  Error e;
  e.flip = meanOf(map);
  double sum = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    if (truth.pixels[4 * i + 3] > 0.5f) sum += map.pixels[i], pixels += 1.0;
  e.flipCloud = pixels > 0.0 ? sum / pixels : 0.0;
  e.relMse = relMse(rgb, frame);
  e.ratio = meanLuminance(frame) / meanLuminance(rgb);
  if (!stem.empty()) {
    savePng(stem + "_path.png", rgb.width, rgb.height, 3, displayBytes(rgb, tone));
    savePng(stem + "_realtime.png", rgb.width, rgb.height, 3, displayBytes(frame, tone));
    savePng(stem + "_flip.png", rgb.width, rgb.height, 3, bytesOf(heatMap(map)));
  }
  return e;
}

}  // namespace welkin::bench
