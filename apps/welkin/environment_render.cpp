// The pictures of an environment by either renderer.
#include <algorithm>

#include "apps/welkin/environment_file.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/atmosphere/tables.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/scene/features.hpp"
#include "welkin/trace/denoise.hpp"

namespace welkin::app {

namespace {

// The largest target: with the renderer's own, 48 bytes a pixel or 100 MB.
constexpr int kTileWidth = 2048, kTileHeight = 1024;
constexpr int kMarches = 4;  // a pixel, unless told otherwise

// The light of the sun at the camera, before the clouds.
DirectionalLight sunLight(const Scene& scene) {
  const glm::vec3 direction = sunDirection(scene.sun);
  const SkyParams sky = makeSkyParams(scene.atmosphere, direction, scene.camera.position.z, scene.ground.albedo);
  const AirTables air = bakeAir(sky.air);
  const glm::vec3 through =
      law::lookupTransmittanceToSun(air.transmittance.view(), sky.air, sky.air.cameraAltitude, sky.air.sunDirection.z);
  return {glm::dvec3(direction), glm::dvec3(glm::vec3(sky.air.sunIrradiance) * through)};
}

void finish(Environment& out, const EnvironmentPixels& pixels, const DirectionalLight& sun,
            const std::vector<SunPixel>& disc, const EnvironmentOptions& options) {
  out.lost = addSun(out.light, pixels, sun, disc, options.sun);
  out.upward = upwardIrradiance(out.light, pixels);
  if (out.lost) out.upward += out.lost->illuminance * std::max(out.lost->direction.z, 0.0);
}

}  // namespace

Environment renderEnvironment(const Scene& source, const EnvironmentOptions& options) {
  Scene scene = source;
  // A picture that stands still needs none of the shortcuts between frames.
  scene.quality.historyScale = scene.quality.interleave = 1;
  scene.quality.reprojection = scene.quality.jitter = true;
  scene.quality.averageHistory = false;
  const std::vector<Camera> cameras = environmentCameras(scene.camera, options.layout, options.centerHeading);
  const bool cube = options.layout == EnvironmentLayout::cube;
  const EnvironmentPixels pixels(cameras, cube ? options.size / 4 : options.size);
  const DirectionalLight sun = sunLight(scene);
  std::vector<SunPixel> disc = sunPixels(pixels, sun);

  const int width = pixels.width(), height = pixels.pictureHeight();
  const int tileWidth = std::min(width, kTileWidth), tileHeight = std::min(height, kTileHeight);
  const int columns = (width + tileWidth - 1) / tileWidth, rows = (height + tileHeight - 1) / tileHeight;
  const int frames = options.frames > 0 ? options.frames : kMarches;
  Environment out{Image(pixels.width(), pixels.height(), 3), {}, {}};
  out.light.features = featuresOf(scene);

  // Tiles at the right and lower edges may reach over them: they are moved back in, so that all have one size.
  realtime::Offscreen screen(tileWidth, tileHeight);
  screen.renderer().setScene(scene, texturesOf(scene));
  const double turns = static_cast<double>(cameras.size()) * columns * rows * frames;
  double done = 0.0;
  for (std::size_t picture = 0; picture < cameras.size(); ++picture)
    for (int tile = 0; tile < columns * rows; ++tile) {
      const int left = std::min(tile % columns * tileWidth, width - tileWidth);
      const int top = std::min(tile / columns * tileHeight, height - tileHeight);
      realtime::Frame frame = realtime::tileOf(realtime::frameOf(cameras[picture], width, height), left,
                                               height - top - tileHeight, tileWidth, tileHeight);
      frame.time = scene.time;
      frame.output = realtime::Output::lightWithoutSunDisc;
      screen.view().reset();
      for (int i = 0; i < frames; ++i) {
        screen.draw(frame);
        screen.finish();
        report(options.progress, ++done / turns);
      }
      const int firstRow = static_cast<int>(picture) * height + top;
      const Image light = screen.read();
      for (int y = 0; y < tileHeight; ++y)
        std::copy_n(light.at(0, y), static_cast<std::size_t>(tileWidth) * 3, out.light.at(left, firstRow + y));

      const auto inTile = [&](const SunPixel& p) {
        const int x = static_cast<int>(p.index % width) - left, y = static_cast<int>(p.index / width) - firstRow;
        return x >= 0 && x < tileWidth && y >= 0 && y < tileHeight;
      };
      if (std::none_of(disc.begin(), disc.end(), inTile)) continue;
      frame.output = realtime::Output::transmittance;
      screen.draw(frame);
      const Image through = screen.read();
      for (SunPixel& p : disc)
        if (inTile(p))
          p.transmittance = std::clamp(
              through.at(static_cast<int>(p.index % width) - left, static_cast<int>(p.index / width) - firstRow)[0],
              0.0f, 1.0f);
    }
  finish(out, pixels, sun, disc, options);
  return out;
}

Environment traceEnvironment(const Scene& source, const EnvironmentOptions& options, const TraceOptions& trace) {
  Scene scene = source;
  const std::vector<Camera> cameras = environmentCameras(scene.camera, options.layout, options.centerHeading);
  const EnvironmentPixels pixels(cameras, options.layout == EnvironmentLayout::cube ? options.size / 4 : options.size);
  const DirectionalLight sun = sunLight(scene);
  std::vector<SunPixel> disc = sunPixels(pixels, sun);
  const int width = pixels.width(), height = pixels.pictureHeight();
  trace::TraceSettings settings = traceSettings(trace);
  settings.width = width;
  settings.height = height;
  settings.sunDisc = trace::SunDisc::leftOut;
  settings.seconds /= static_cast<double>(cameras.size());
  const std::vector<Volume> maps = weatherMaps(scene);
  const std::vector<PlacedGrid> grids = loadGrids(scene);
  Environment out{Image(pixels.width(), pixels.height(), 3), {}, {}};
  out.light.features = tracedFeaturesOf(scene);
  for (std::size_t picture = 0; picture < cameras.size(); ++picture) {
    scene.camera = cameras[picture];
    trace::PathTracer tracer(scene, {.weatherMaps = maps, .grids = grids}, settings);
    const double share = 1.0 / static_cast<double>(cameras.size());
    const Progress stage =
        stageOf(options.progress, share * static_cast<double>(picture), share * static_cast<double>(picture + 1));
    if (!tracer.run(stage)) throw Cancelled();
    const trace::TraceLayers layers = tracer.layers();
    const std::size_t first = picture * static_cast<std::size_t>(height);
    const Image light = trace.denoise ? trace::denoise(layers) : layers.radiance;
    std::copy(light.pixels.begin(), light.pixels.end(), out.light.at(0, static_cast<int>(first)));
    for (SunPixel& p : disc) {
      const std::size_t row = p.index / static_cast<std::size_t>(width);
      if (row < first || row >= first + static_cast<std::size_t>(height)) continue;
      p.transmittance = *layers.transmittance.at(static_cast<int>(p.index % width), static_cast<int>(row - first));
    }
  }
  finish(out, pixels, sun, disc, options);
  return out;
}

}  // namespace welkin::app
