#pragma once
// What the noise textures are made of. Frequencies count cells per tile, so that every texture is seamless.
#include "welkin/base/fields.hpp"

namespace welkin {

// How Perlin fBm P and inverted Worley fBm W become one value (000 fig. 4.8): square remap(P,0,1,W,1)^2, lift
// remap(P,0,1,W,1), carve remap(P,W,1,0,1) (GPU Pro 7), dilate remap(P,W-1,1,0,1), erode remap(P,1-W,1,0,1), product
// PW.
enum class PerlinWorley { square, lift, carve, dilate, erode, product };
template <>
struct ChoiceNames<PerlinWorley> {
  static constexpr std::array<std::string_view, 6> names{"square", "lift", "carve", "dilate", "erode", "product"};
};

// The base shape of the shape "nubis": red Perlin-Worley; green, blue and alpha inverted Worley fBm of worleyCells,
// twice and four times as many (000 ch. 4.3.1).
struct BaseShapeSettings {
  int size = 128;
  int perlinFrequency = 4;
  int perlinOctaves = 4;
  float perlinGain = 0.5f;
  int worleyCells = 4;
  float lowWeight = 0.625f;
  float midWeight = 0.25f;
  float highWeight = 0.125f;
  PerlinWorley combination = PerlinWorley::square;
  float gamma = 1.0f;
  int seed = 0;
};
template <>
struct FieldTable<BaseShapeSettings> {
  static auto make() {
    using S = BaseShapeSettings;
    return fieldRows(
        field<&S::size>("size", {8, 256}, {32, 256}, "texels along each edge"),
        field<&S::perlinFrequency>("perlin_frequency", {1, 64}, {2, 16}, "cells of the first Perlin octave"),
        field<&S::perlinOctaves>("perlin_octaves", {1, 8}, {}, "octaves of Perlin noise"),
        field<&S::perlinGain>("perlin_gain", {0, 1}, {}, "weight of each octave against the last"),
        field<&S::worleyCells>("worley_cells", {1, 16}, {2, 16},
                               "Worley cells of the green channel; blue and alpha have 2 and 4 times as many"),
        field<&S::lowWeight>("low_weight", {0, 1}, {}, "weight of a channel's lowest Worley frequency"),
        field<&S::midWeight>("mid_weight", {0, 1}, {}, "weight of twice that frequency"),
        field<&S::highWeight>("high_weight", {0, 1}, {}, "weight of four times that frequency"),
        field<&S::combination>("combination", "how Perlin and Worley noise become one (000 fig. 4.8)"),
        field<&S::gamma>("gamma", {0.1, 10}, {0.25, 4}, "gamma correction c^(1/gamma) (000 eq. 4.6)"),
        field<&S::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another texture"));
  }
};

// The detail of the shape "nubis": red, green and blue as green, blue and alpha of the base shape.
struct DetailSettings {
  int size = 32;
  int worleyCells = 2;
  float lowWeight = 0.625f;
  float midWeight = 0.25f;
  float highWeight = 0.125f;
  float gamma = 1.0f;
  int seed = 0;
};
template <>
struct FieldTable<DetailSettings> {
  static auto make() {
    using S = DetailSettings;
    return fieldRows(
        field<&S::size>("size", {8, 256}, {16, 128}, "texels along each edge"),
        field<&S::worleyCells>("worley_cells", {1, 16}, {2, 8},
                               "Worley cells of the red channel; green and blue have 2 and 4 times as many"),
        field<&S::lowWeight>("low_weight", {0, 1}, {}, "weight of a channel's lowest Worley frequency"),
        field<&S::midWeight>("mid_weight", {0, 1}, {}, "weight of twice that frequency"),
        field<&S::highWeight>("high_weight", {0, 1}, {}, "weight of four times that frequency"),
        field<&S::gamma>("gamma", {0.1, 10}, {0.25, 4}, "gamma correction c^(1/gamma) (000 eq. 4.6)"),
        field<&S::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another texture"));
  }
};

// The plane flow that displaces the detail of the shape "nubis".
struct CurlSettings {
  int size = 128;
  int frequency = 4;
  int octaves = 3;
  float gain = 0.5f;
  float amplitude = 0.35f;
  int seed = 0;
};
template <>
struct FieldTable<CurlSettings> {
  static auto make() {
    using S = CurlSettings;
    return fieldRows(
        field<&S::size>("size", {8, 1024}, {32, 512}, "texels along each edge"),
        field<&S::frequency>("frequency", {1, 64}, {2, 16}, "cells of the first octave"),
        field<&S::octaves>("octaves", {1, 8}, {}, "octaves of the potential"),
        field<&S::gain>("gain", {0, 1}, {}, "weight of each octave of the potential against the last"),
        field<&S::amplitude>("amplitude", {0, 4}, {0, 1}, "factor of the flow; 0.35 brings most of it into +-1"),
        field<&S::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another texture"));
  }
};

// The textures of the shape "profile": base (Perlin fBm lifted on billows; billows), detail (billows; ridges) and warp
// (two smooth fields). Base and detail are stretched so that their 2 % and 98 % quantiles become 0 and 1.
struct ProfileNoiseSettings {
  int baseSize = 128;
  int perlinFrequency = 4;
  int perlinOctaves = 5;
  int billowCells = 4;
  int billowOctaves = 4;
  int detailSize = 64;
  int detailCells = 4;
  int detailOctaves = 3;
  float ridgeSlope = 1.8f;
  int warpSize = 32;
  int warpFrequency = 3;
  int warpOctaves = 1;
  float gain = 0.5f;
  int seed = 0;
};
template <>
struct FieldTable<ProfileNoiseSettings> {
  static auto make() {
    using S = ProfileNoiseSettings;
    return fieldRows(
        field<&S::baseSize>("base_size", {8, 256}, {64, 256}, "texels along each edge of the base"),
        field<&S::perlinFrequency>("perlin_frequency", {1, 64}, {2, 16}, "cells of its first Perlin octave"),
        field<&S::perlinOctaves>("perlin_octaves", {1, 8}, {}, "its octaves of Perlin noise"),
        field<&S::billowCells>("billow_cells", {1, 16}, {2, 8}, "cells of its first billow octave"),
        field<&S::billowOctaves>("billow_octaves", {1, 5}, {}, "its octaves of billows"),
        field<&S::detailSize>("detail_size", {8, 256}, {32, 128}, "texels along each edge of the detail"),
        field<&S::detailCells>("detail_cells", {1, 16}, {2, 8}, "cells of its first octave"),
        field<&S::detailOctaves>("detail_octaves", {1, 5}, {}, "its octaves"),
        field<&S::ridgeSlope>("ridge_slope", {0.1, 10}, {1, 4}, "k in the ridges 1 - k |Perlin|"),
        field<&S::warpSize>("warp_size", {8, 128}, {16, 64}, "texels along each edge of the warp"),
        field<&S::warpFrequency>("warp_frequency", {1, 16}, {2, 4}, "cells of its first octave"),
        field<&S::warpOctaves>("warp_octaves", {1, 4}, {}, "its octaves"),
        field<&S::gain>("gain", {0, 1}, {}, "weight of each octave against the last, everywhere"),
        field<&S::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another set of textures"));
  }
};

}  // namespace welkin
