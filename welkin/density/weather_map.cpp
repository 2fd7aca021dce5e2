// Once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/density/weather_map.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include <bit>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/density/law-inl.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/noise/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

static void fillWeather(const one::WeatherParams& params, int shape, float edge, const TextureView& map,
                        Volume& volume) {
  const auto p = std::bit_cast<law::WeatherParams>(params);
  const auto width = static_cast<std::size_t>(volume.width);
  parallelFor(static_cast<std::size_t>(volume.height), 4, [&](std::size_t begin, std::size_t end) {
    const std::size_t lanes = law::laneCount();
    std::vector<float> buffer(4 * lanes);
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t x = 0; x < width; x += lanes) {
        const Real u = (law::toReal(iota(static_cast<int>(x))) + 0.5f) / static_cast<float>(volume.width);
        const Vec2 at((u - 0.5f) * edge, (texelCentre(static_cast<int>(y), volume.height) - 0.5f) * edge);
        const law::Vec4 w = shape == 0 ? law::profileWeather(at, p, map) : law::nubisWeather(at, p, map);
        storeReal(w.x, &buffer[0]);
        storeReal(w.y, &buffer[lanes]);
        storeReal(w.z, &buffer[2 * lanes]);
        storeReal(w.w, &buffer[3 * lanes]);
        float* out = volume.texels.data() + (y * width + x) * 4;
        for (std::size_t i = 0; i < std::min(lanes, width - x); ++i)
          for (std::size_t c = 0; c < 4; ++c) out[4 * i + c] = buffer[c * lanes + i];
      }
  });
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(fillWeather);

TextureView authoringMap(const Layer& layer, const Volume* map) {
  static constexpr float kNeutral[4] = {1, 1, 1, 1};
  if (layer.weather.map.empty()) return {.texels = kNeutral, .width = 1, .height = 1, .channels = 4};
  if (!map || map->texels.empty())
    throw Error(ErrorKind::badInput, "",
                "the weather map '" + layer.weather.map + "' was not handed over with the layer");
  if (map->channels != 4)
    throw Error(ErrorKind::badInput, layer.weather.map,
                "a weather map has 4 channels, not " + std::to_string(map->channels));
  return map->view();
}

Volume bakeWeather(const Layer& layer, const glm::dvec2& centre, double edge, int texels, const Drift& drift, int seed,
                   const Volume* map) {
  if (texels < 1 || !(edge > 0.0))
    throw Error(ErrorKind::badInput, "", "a weather map needs at least one texel and an edge longer than 0 m");
  const TextureView view = authoringMap(layer, map);
  Volume weather(texels, texels, 1, 4);
  HWY_DYNAMIC_DISPATCH(fillWeather)
  (weatherParams(layer, centre, drift, seed), static_cast<int>(layer.cloud.shape), static_cast<float>(edge), view,
   weather);
  return weather;
}

}  // namespace welkin
#endif
