// Once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/density/field_kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include <bit>

#include "welkin/density/field_kernels.hpp"
#include "welkin/density/law-inl.hpp"
#include "welkin/noise/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

static void layerExtinction(const one::LayerParams& layer, const one::WeatherParams& weather,
                            const kernels::LayerTextures& t, float footprint, const kernels::Points& points,
                            float* sigma) {
  const auto c = std::bit_cast<law::LayerParams>(layer);
  const auto w = std::bit_cast<law::WeatherParams>(weather);
  for (std::size_t i = 0; i < points.count; i += law::laneCount()) {
    const Vec3 point(loadReal(points.x + i), loadReal(points.y + i), loadReal(points.z + i));
    const Vec3 q = law::unsheared(point, c);
    if (c.shape == 0) {
      const law::Vec4 here = law::profileWeather(law::profileColumn(q, c, t.third), w, t.map);
      storeReal(law::profileExtinctionIn(here, q, footprint, c, t.base, t.detail).x, sigma + i);
    } else {
      const law::Vec4 here = law::nubisWeather(Vec2(q.x, q.y), w, t.map);
      storeReal(law::nubisExtinctionIn(here, q, law::toMask(true), c, t.base, t.detail, t.third).x, sigma + i);
    }
  }
}

static void heroExtinction(const one::HeroParams& hero, const one::HeroParts& geometry, const kernels::HeroTextures& t,
                           float footprint, const kernels::Points& points, float* sigma) {
  const auto c = std::bit_cast<law::HeroParams>(hero);
  const auto parts = std::bit_cast<law::HeroParts>(geometry);
  for (std::size_t i = 0; i < points.count; i += law::laneCount()) {
    const Vec3 point(loadReal(points.x + i), loadReal(points.y + i), loadReal(points.z + i));
    storeReal(law::heroExtinction(point, footprint, c, parts, t.shape, t.billows), sigma + i);
  }
}

static void sheetOpticalDepth(const one::SheetParams& sheet, const kernels::Points& points, float* depth) {
  const auto s = std::bit_cast<law::SheetParams>(sheet);
  for (std::size_t i = 0; i < points.count; i += law::laneCount())
    storeReal(law::sheetOpticalDepth(Vec2(loadReal(points.x + i), loadReal(points.y + i)), s), depth + i);
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(layerExtinction);
HWY_EXPORT(heroExtinction);
HWY_EXPORT(sheetOpticalDepth);

namespace kernels {
void layerExtinction(const law::LayerParams& layer, const law::WeatherParams& weather, const LayerTextures& textures,
                     float footprint, const Points& points, float* sigma) {
  HWY_DYNAMIC_DISPATCH(layerExtinction)(layer, weather, textures, footprint, points, sigma);
}
void heroExtinction(const law::HeroParams& hero, const law::HeroParts& parts, const HeroTextures& textures,
                    float footprint, const Points& points, float* sigma) {
  HWY_DYNAMIC_DISPATCH(heroExtinction)(hero, parts, textures, footprint, points, sigma);
}
void sheetOpticalDepth(const law::SheetParams& sheet, const Points& points, float* depth) {
  HWY_DYNAMIC_DISPATCH(sheetOpticalDepth)(sheet, points, depth);
}
}  // namespace kernels
}  // namespace welkin
#endif
