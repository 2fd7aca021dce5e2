#pragma once
// Blue noise for dithering: values spread evenly over (0, 1), each once in a tile that repeats, like values far apart,
// so that what is left after averaging is fine grain without patterns.
#include <cstdint>
#include <vector>

namespace welkin {

// size * size values (rank + 1/2) / size^2, row by row, by void and cluster (Ulichney 1993) with a Gaussian of 1.9
// texels; `size` from 4 to 128. Takes time as size^4: 64 takes about .1 s.
std::vector<float> blueNoise(int size, std::uint32_t seed);

}  // namespace welkin
