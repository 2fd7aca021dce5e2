#include "tests/realtime/march_cpu.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/noise/textures.hpp"
#include "welkin/realtime/falling.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/noise/blue_noise.hpp"
#include "welkin/realtime/march_params.hpp"
#include "welkin/realtime/weather_levels.hpp"
#include "welkin/scene/rain.hpp"
#include "welkin/scene/surface.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"

struct Sky {
  std::vector<LayerParams> layers;
  std::vector<ClipParams> clips;
  std::vector<SheetParams> sheets;
  std::vector<RainParams> rain;  // of each layer; empty where nothing falls
  TextureView weather, extra, base, detail, warp, nubisBase, nubisDetail, curl;
  std::span<const PlacedGrid> grids;
  glm::dvec2 anchor{0.0};
  float dither = 0.0f;
  std::vector<Vec4> segments;  // of rain, of one ray
};

FN Vec3 skyExtinction(IN(Vec3) q, IN(Real) footprint, IN(Mask) full, IN(Sky) sky) {
  Vec3 sum(0.0f, -1.0f, 0.0f);
  for (std::size_t i = 0; i < sky.layers.size(); ++i) {
    const Vec3 found = sky.layers[i].shape == static_cast<int>(LayerShape::nubis)
                           ? nubisExtinction(q, full, sky.dither, sky.layers[i], sky.clips[i], sky.weather, sky.extra,
                                             sky.nubisBase, sky.nubisDetail, sky.curl)
                           : profileExtinction(q, footprint, sky.dither, sky.layers[i], sky.clips[i], sky.weather,
                                               sky.extra, sky.base, sky.detail, sky.warp);
    sum = Vec3(sum.x + found.x, max(sum.y, found.y), sum.z + found.z);
  }
  for (const PlacedGrid& grid : sky.grids) {
    const glm::dvec3 point(glm::dvec2(q) + sky.anchor, q.z);
    // Inside is where the outermost voxels' centres are.
    const glm::dvec3 v =
        (glm::dvec3(grid.fromWorld * glm::dvec4(point, 1.0)) - grid.voxels->origin()) / grid.voxels->voxel() - 0.5;
    const glm::dvec3 last(grid.voxels->dims() - 1);
    if (glm::any(glm::lessThan(v, glm::dvec3(0.0))) || glm::any(glm::greaterThan(v, last))) continue;
    sum = Vec3(sum.x + grid.at(point), max(sum.y, 1.0f), sum.z);
  }
  return sum;
}
// Without a light volume: parity is that of the march.
const int kLightVolume = 0;
FN Real skySunDepth(IN(Vec3), IN(Sky)) { return 0.0f; }
FN Vec2 skyBelow(IN(Vec2), IN(Sky)) { return Vec2(0.0f); }
FN Vec2 skyBelowAir(IN(Vec2), IN(Sky)) { return Vec2(0.0f); }
FN AirShade skyAirShade(IN(Sky)) { return {Vec4(0.0f), Vec4(0.0f)}; }
const int kRains = 1;
FN Vec4 skyRainSegment(int k, IN(Sky) sky) { return sky.segments[static_cast<std::size_t>(k)]; }
FN Vec2 skyRain(IN(Vec3) q, IN(Sky) sky) {
  Vec2 sum(0.0f);
  for (std::size_t i = 0; i < sky.rain.size(); ++i) {
    const bool nubis = sky.layers[i].shape == static_cast<int>(LayerShape::nubis);
    const float rate = rainRate(q, sky.dither, sky.layers[i], sky.clips[i], sky.rain[i], sky.weather, sky.extra,
                                nubis ? sky.nubisBase : sky.base);
    const float snow = snowShare(q.z, sky.rain[i].freezing), sigma = fallingExtinction(rate, snow);
    sum += Vec2(sigma, sigma * snow);
  }
  return Vec2(sum.x, sum.y / max(sum.x, 1e-12f));
}
FN int skySheetCount(IN(Sky) sky) { return static_cast<int>(sky.sheets.size()); }
FN SheetParams skySheet(int i, IN(Sky) sky) { return sky.sheets[static_cast<std::size_t>(i)]; }

#include "welkin/realtime/span.glsl"
#include "welkin/realtime/rain_segments.glsl"
#include "welkin/realtime/march.glsl"
#include "welkin/realtime/ray.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law

namespace welkin::realtime::test {
namespace {

struct Textures {
  Volume base, detail, warp, nubisBase, nubisDetail, curl;
  std::vector<float> weather, extra;
};

// shaders/march.frag.glsl, first frame.
float dither(int x, int y) {
  constexpr int kSize = 64;
  static const std::vector<float> values = blueNoise(kSize, 1);
  return roundedToHalf(values[static_cast<std::size_t>((y + 13) % kSize * kSize + (x + 47) % kSize)]);
}

Volume halves(Volume v) {
  roundToHalf(v);
  return v;
}

void drawWeather(const Scene& scene, const glm::dvec2& position, const Drift& drift, law::Sky& in, Textures& textures) {
  const WeatherExtent extent = weatherExtent(scene.quality.preset);
  const std::size_t row = static_cast<std::size_t>(extent.texels) * 2, level = row * extent.texels;
  textures.weather.resize(level * extent.levels * scene.layers.size());
  textures.extra.resize(textures.weather.size());
  const glm::dvec2 inAir = position - driftOffset(drift);
  in.clips.resize(scene.layers.size());
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    law::ClipLevel* const clips[] = {&in.clips[i].level0, &in.clips[i].level1, &in.clips[i].level2,
                                     &in.clips[i].level3};
    in.clips[i].count = extent.levels;
    in.clips[i].firstSlice = static_cast<float>(i * extent.levels);
    for (int l = 0; l < extent.levels; ++l) {
      const glm::dvec2 centre = levelCentre(extent, l, inAir);
      *clips[l] = clipLevel(extent, l, inAir - centre);
      const law::WeatherParams w =
          weatherParams(scene.layers[i], centre, Drift{drift.windSpeed, drift.windFrom, 0.0}, scene.seed);
      const bool nubis = scene.layers[i].cloud.shape == LayerShape::nubis;
      const float edge = static_cast<float>(extent.edge(l)), texel = 1.0f / static_cast<float>(extent.texels);
      const std::size_t start = level * (i * extent.levels + l);
      parallelFor(level / 2, row / 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          const glm::vec2 at(static_cast<float>(t % (row / 2)) + 0.5f, static_cast<float>(t / (row / 2)) + 0.5f);
          const glm::vec2 p = (at * texel - 0.5f) * edge;
          const glm::vec4 found = nubis ? law::nubisWeather(p, w, {}) : law::profileWeather(p, w, {});
          textures.weather[start + 2 * t] = roundedToHalf(found.x);
          textures.weather[start + 2 * t + 1] = roundedToHalf(found.y);
          textures.extra[start + 2 * t] = roundedToHalf(found.z);
          textures.extra[start + 2 * t + 1] = roundedToHalf(found.w);
        }
      });
    }
  }
  const auto view = [&](const std::vector<float>& texels) {
    return TextureView{
        texels.data(), extent.texels, extent.texels, static_cast<int>(extent.levels * scene.layers.size()), 2,
        Wrap::clamp,   Wrap::clamp};
  };
  in.weather = view(textures.weather);
  in.extra = view(textures.extra);
}

void drawNoise(const Scene& scene, law::Sky& in, Textures& t) {
  for (const Layer& layer : scene.layers) {
    if (layer.cloud.shape == LayerShape::profile) {
      t.base = halves(bakeProfileBasePacked(scene.noise.profile, scene.layers.front().profile.billowMix));
      t.detail = halves(bakeProfileDetail(scene.noise.profile));
      t.warp = halves(bakeProfileWarp(scene.noise.profile));
    } else {
      t.nubisBase = halves(bakeBaseShapePacked(scene.noise.baseShape));
      t.nubisDetail = halves(bakeDetailPacked(scene.noise.detail));
      t.curl = halves(bakeCurl(scene.noise.curl));
    }
  }
  in.base = t.base.view(), in.detail = t.detail.view(), in.warp = t.warp.view();
  in.nubisBase = t.nubisBase.view(), in.nubisDetail = t.nubisDetail.view(), in.curl = t.curl.view();
}

// Texels of one block of the picture of rain.
glm::ivec2 rainBlock(const FrameParams& f) {
  return rainPictureSize(int(f.size.x), int(f.size.y), 1) / glm::ivec2(law::kRainColumns, law::kRainRows);
}

// shaders/rain_segments.frag.glsl; the segments of a texel one after the other.
std::vector<glm::vec4> rainPicture(law::Sky sky, const FrameParams& f, const law::MarchParams& march) {
  const glm::ivec2 size = rainBlock(f);
  std::vector<glm::vec4> picture;
  sky.dither = 0.5f;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
      const glm::vec3 dir = glm::normalize(law::cameraRay(ndc, f.camera));
      for (int k = 0; k < law::kRainSegments; ++k) {
        glm::vec4 segment = law::rainSegment(k, dir, march, sky);
        for (int c = 0; c < 4; ++c) segment[c] = roundedToHalf(segment[c]);
        picture.push_back(segment);
      }
    }
  return picture;
}

// shaders/rain_lookup.glsl.
std::vector<glm::vec4> segmentsAt(const std::vector<glm::vec4>& picture, const glm::vec2& uv, const FrameParams& f) {
  std::vector<glm::vec4> found(law::kRainSegments);
  if (picture.empty()) return found;
  const glm::ivec2 size = rainBlock(f);
  const glm::vec2 at = glm::clamp(uv * glm::vec2(size) - 0.5f, glm::vec2(0.0f), glm::vec2(size - 1));
  const glm::ivec2 low(at), high = glm::min(low + 1, size - 1);
  const glm::vec2 share = at - glm::vec2(low);
  const auto texel = [&](int x, int y, int k) {
    return picture[static_cast<std::size_t>((y * size.x + x) * law::kRainSegments + k)];
  };
  for (int k = 0; k < law::kRainSegments; ++k)
    found[static_cast<std::size_t>(k)] =
        glm::mix(glm::mix(texel(low.x, low.y, k), texel(high.x, low.y, k), share.x),
                 glm::mix(texel(low.x, high.y, k), texel(high.x, high.y, k), share.x), share.y);
  return found;
}

}  // namespace

Image marchOnCpu(const Scene& scene, const Frame& frame, std::span<const PlacedGrid> grids) {
  const FrameParams f = frameParams(frame, frame.width, frame.height, 1, scene.quality, 0);
  const Drift drift{scene.wind.speed, scene.wind.from, frame.time};
  const law::PlanetParams planet = planetParams(frame.position);
  const glm::vec3 sun = sunDirection(scene.sun);
  const SkyTablesCpu sky = bakeSky(scene.atmosphere, sun, std::max(planet.altitude, 0.0f), airSurface(scene));
  law::Sky in;
  Textures textures;
  for (const Layer& layer : scene.layers) in.layers.push_back(layerParams(layer, frame.position, drift));
  for (const Sheet& sheet : scene.sheets)
    in.sheets.push_back(sheetParams(sheet, glm::dvec2(frame.position), frame.time, scene.seed));
  if (rains(scene))
    for (const Layer& layer : scene.layers) in.rain.push_back(rainParams(scene, layer));
  in.grids = grids;
  in.anchor = glm::dvec2(frame.position);
  std::vector<Shell> shells;
  for (const PlacedGrid& grid : grids) {
    const WorldBox box = boundsOf(grid);
    shells.push_back({static_cast<float>(std::max(box.low.z, 0.0)), static_cast<float>(box.high.z)});
  }
  drawWeather(scene, glm::dvec2(frame.position), drift, in, textures);
  drawNoise(scene, in, textures);
  const float pixel = f.options.w;
  const law::MarchParams march =
      marchParams(scene, planet, sun, sky.light, pixel, frame.background == Background::skyAndGround, shells);
  const law::AtmosphereParams& air = sky.params.air;
  const std::vector<glm::vec4> segments = rains(scene) ? rainPicture(in, f, march) : std::vector<glm::vec4>();
  Image image(frame.width, frame.height, 4);
  parallelFor(image.pixels.size() / 4, 64, [&](std::size_t begin, std::size_t end) {
    law::Sky own = in;
    for (std::size_t i = begin; i < end; ++i) {
      const float x = static_cast<float>(i % frame.width), y = static_cast<float>(i / frame.width);
      const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) * glm::vec2(f.size.z, f.size.w) * 2.0f - 1.0f;
      const glm::vec3 dir = glm::normalize(law::cameraRay(ndc, f.camera));
      own.dither = dither(static_cast<int>(x), static_cast<int>(y));
      own.segments = segmentsAt(segments, ndc * 0.5f + 0.5f, f);
      glm::vec4 colour;
      float depth = 0.0f, samples = 0.0f;
      law::renderRay(dir, 1e8f, glm::vec3(0.5f), march, air, sky.air.transmittance.view(), sky.aerialInscatter.view(),
                     sky.aerialTransmittance.view(), own, colour, depth, samples);
      const glm::vec3 behind = law::lookupSky(sky.skyView.view(), air, dir) + law::sunDisc(air, dir, pixel);
      float* out = image.at(static_cast<int>(x), frame.height - 1 - static_cast<int>(y));
      for (int c = 0; c < 3; ++c)
        out[c] = roundedToHalf(std::min(colour[c] * f.wind.w, 60000.0f)) +
                 roundedToHalf(colour.w) * std::min(behind[c] * f.wind.w, 60000.0f);
    }
  });
  return image;
}

}  // namespace welkin::realtime::test
