#pragma once
// The noise textures on the CPU, by the law of noise/textures.glsl: the same numbers as the GPU route of
// realtime/noise_textures.hpp before both are rounded to half floats, and the same bits on any number of threads. Texel
// (i, j, k) stands at uvw = (i + 1/2, j + 1/2, k + 1/2) / size. All throw Error (badInput) for a size below 1 or a
// setting outside its field table's range.
#include <cstdint>

#include "welkin/noise/settings.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {

// size^3, RGBA: Perlin-Worley, three Worley fBm.
Volume bakeBaseShape(const BaseShapeSettings& settings);
// size^3, RG: Perlin-Worley and L_FBM = .625 G + .25 B + .125 A (000 eq. 2.28).
Volume bakeBaseShapePacked(const BaseShapeSettings& settings);
// size^3, RGB: three Worley fBm.
Volume bakeDetail(const DetailSettings& settings);
// size^3, R: .625 R + .25 G + .125 B.
Volume bakeDetailPacked(const DetailSettings& settings);
// size^2, RG: signed flow.
Volume bakeCurl(const CurlSettings& settings);

// baseSize^3, RG: Perlin-Worley, billows.
Volume bakeProfileBase(const ProfileNoiseSettings& settings);
// baseSize^3, R: mix of the two; billowMix 1 is billows alone.
Volume bakeProfileBasePacked(const ProfileNoiseSettings& settings, float billowMix);
// detailSize^3, RG: billows, ridges.
Volume bakeProfileDetail(const ProfileNoiseSettings& settings);
// warpSize^3, RG: two fields centred on 1/2.
Volume bakeProfileWarp(const ProfileNoiseSettings& settings);

// size^3, R: billows of one size, of cells^3 feature points.
Volume bakeBillows(int size, int cells, std::uint32_t seed);

}  // namespace welkin
