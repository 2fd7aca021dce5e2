#pragma once
// The SIMD kernels behind field.hpp. Points stand relative to the anchor of the parameters, in planes of x, y and
// altitude. Planes are read and written in whole vectors: their memory reaches up to the next multiple of kPadding.
#include <cstddef>

#include "welkin/density/law.hpp"

namespace welkin::kernels {

inline constexpr std::size_t kPadding = 64;  // floats: no vector is longer

struct Points {
  const float *x, *y, *z;
  std::size_t count;
};
struct LayerTextures {
  TextureView map, base, detail, third;  // third: warp of "profile", curl of "nubis"
};
struct HeroTextures {
  TextureView shape, billows;
};

// Writes the layer's extinction at the points.
void layerExtinction(const law::LayerParams& layer, const law::WeatherParams& weather, const LayerTextures& textures,
                     float footprint, const Points& points, float* sigma);
// Writes a hero cloud's extinction at the points.
void heroExtinction(const law::HeroParams& hero, const law::HeroParts& parts, const HeroTextures& textures,
                    float footprint, const Points& points, float* sigma);
// Writes the sheet's optical depth over the points.
void sheetOpticalDepth(const law::SheetParams& sheet, const Points& points, float* depth);

}  // namespace welkin::kernels
