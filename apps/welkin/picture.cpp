#include "apps/welkin/picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/welkin/usage_error.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/io/hdr.hpp"
#include "welkin/io/png.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/scene/features.hpp"

namespace welkin::app {

namespace {

constexpr int kSamplesPerPixel = 4;  // marches a pixel of a still picture, unless --frames says otherwise

// A picture as an authoring map, south row first. What the picture has no channel for comes from the settings.
Volume weatherMap(const WeatherSettings& weather) {
  const Image picture = loadPng(weather.map);
  Volume map(picture.width, picture.height, 1, 4);
  const bool grey = picture.channels < 3, alpha = picture.channels == 2 || picture.channels == 4;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float* from = picture.at(x, picture.height - 1 - y);
      float* to = map.texels.data() + (static_cast<std::size_t>(y) * picture.width + x) * 4;
      to[0] = from[0];
      to[1] = grey ? weather.precipitation : from[1];
      to[2] = grey ? weather.type : from[2];
      to[3] = alpha ? from[picture.channels - 1] : 0.0f;
    }
  return map;
}

}  // namespace

std::vector<Volume> weatherMaps(const Scene& scene) {
  std::vector<Volume> maps(scene.layers.size());
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    if (!scene.layers[i].weather.map.empty()) maps[i] = weatherMap(scene.layers[i].weather);
  return maps;
}

realtime::CustomTextures texturesOf(const Scene& scene) {
  realtime::CustomTextures textures;
  // Without pictures the renderer keeps the weather that it has.
  const bool pictures = std::any_of(scene.layers.begin(), scene.layers.end(),
                                    [](const Layer& layer) { return !layer.weather.map.empty(); });
  if (pictures) textures.weatherMaps = weatherMaps(scene);
  textures.grids = loadGrids(scene);
  return textures;
}

Image renderSky(const Scene& scene, const RenderOptions& options) {
  realtime::Offscreen screen(options.width, options.height);
  screen.renderer().setScene(scene, texturesOf(scene));
  const int interleave = scene.quality.reprojection ? scene.quality.interleave : 1;
  const int frames = options.frames > 0 ? options.frames : kSamplesPerPixel * interleave * interleave;
  for (int i = 0; i < frames; ++i) {
    screen.draw(scene, scene.time);
    screen.finish();
    report(options.progress, static_cast<double>(i + 1) / frames);
  }
  Image light = screen.read();
  light.features = featuresOf(scene);
  return light;
}

bool isDisplayPicture(const std::string& path) { return path.ends_with(".png"); }

Image loadPicture(const std::string& path) {
  if (isDisplayPicture(path)) return loadPng(path);
  if (path.ends_with(".exr")) return loadExr(path);
  if (path.ends_with(".hdr")) return loadHdr(path);
  throw UsageError(fmt::format("'{}': a picture's name ends in .png, .exr or .hdr", path));
}

void requirePictureFile(const std::string& path) {
  if (!path.ends_with(".png") && !path.ends_with(".exr"))
    throw UsageError(fmt::format("'{}': a picture's name ends in .png or .exr", path));
  requireWritable(path);
}

ToneSettings toneOf(const Film& film, double ev) {
  return {.ev = static_cast<float>(ev) - film.compensation,
          .whiteBalance = film.whiteBalance,
          .saturation = film.saturation,
          .curve = film.tone};
}

void savePicture(const std::string& path, const Image& light, const Film& film) {
  if (path.ends_with(".exr")) return saveExr(path, light, ExrPrecision::full);
  const ToneSettings tone = toneOf(film, film.exposure == ExposureMode::automatic ? automaticEv(light) : film.ev);
  savePng(path, light.width, light.height, light.channels, displayBytes(light, tone), light.features);
}

}  // namespace welkin::app
