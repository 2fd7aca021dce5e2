#pragma once
// 001's cloud: arrays of random numbers, each twice as fine as the one before, added up and filtered.
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "welkin/density/classical/settings.hpp"

namespace welkin {

// Between v1 at 0 and v2 at 1, v0 and v3 being their other neighbours (001 ch. 5.1.4).
float interpolated(ArrayInterpolation interpolation, float v0, float v1, float v2, float v3, float x);

// cloudCover and cloudSharpness (001 ch. 5.2.2): density from 0 to 1 of a noise from 0 to 1.
float filteredNoise(float noise, float cover, float sharpness);

class PerlinArray {
 public:
  PerlinArray(const PerlinArraySettings& settings, std::uint32_t seed);

  // The sum of all arrays divided by that of their weights, for a place in [0, 1]^3. All outermost values are 0 (001
  // ch. 5.2.3.2), so that it is 0 on the sides of the cube. Cubic interpolation may overshoot 0 and 1 a little.
  float noise(const glm::vec3& p) const;
  float density(const glm::vec3& p) const { return filteredNoise(noise(p), settings_.cover, settings_.sharpness); }

 private:
  struct Array {
    int points;  // on an axis
    float weight;
    std::vector<float> values;
    float at(int x, int y, int z) const;  // 0 outside
  };
  float octave(const Array& array, const glm::vec3& p) const;

  PerlinArraySettings settings_;
  std::vector<Array> arrays_;
};

}  // namespace welkin
