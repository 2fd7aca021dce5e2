#pragma once
// Noise that is quick to make.
#include "welkin/density/noise_settings.hpp"

namespace welkin::test {

inline NoiseSettings smallNoise() {
  NoiseSettings n;
  n.profile.baseSize = 32;
  n.profile.detailSize = 32;
  n.profile.warpSize = 16;
  n.baseShape.size = 32;
  n.curl.size = 32;
  return n;
}

}  // namespace welkin::test
