#pragma once
// Height maps by the octave scheme of 002: squares of random heights, in several sizes, smoothed.
#include <cstdint>
#include <vector>

#include "welkin/density/classical/settings.hpp"

namespace welkin {

// Heights from 0 to the mean of the octaves' amplitudes, on a square that repeats; row by row.
struct HeightMap {
  int size = 0;
  std::vector<float> heights;

  // Bilinear between the middles of elements; `x` and `y` in elements from the map's corner, any number of them.
  float at(double x, double y) const;
};

// The mean over the octaves (002 eq. 1, with n terms), then `smoothing` times the mean over 3 x 3 elements. A square is
// nowhere farther from its neighbours, round the map's edges too, than `step` times its octave's amplitude.
HeightMap bakeHeightMap(const HeightMapSettings& settings, std::uint32_t seed);

// The height above which lies the share `cover` of the map.
float heightOfCover(const HeightMap& map, float cover);

}  // namespace welkin
