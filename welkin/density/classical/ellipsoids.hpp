#pragma once
// Ellipsoids with a texture (G. Gardner, "Visual simulation of clouds", SIGGRAPH 1985; 001 ch. 4.3).
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "welkin/density/classical/balls.hpp"

namespace welkin {

// Gardner's spectral function, from 0 to 1: the product of two sums of sines whose phases the other axes shift, its
// first octave with a wave for each 2 pi of p.
float spectralTexture(const glm::vec3& p, int octaves, float contrast, float phase);

class TexturedEllipsoids {
 public:
  TexturedEllipsoids(const EllipsoidSettings& settings, const glm::vec3& size, std::uint32_t seed);

  // Density from 0 to 1 at a point in m from the middle of the base: that of the ellipsoid that has most.
  float density(const glm::vec3& p) const;
  float texture(const glm::vec3& p) const;

 private:
  EllipsoidSettings settings_;
  std::vector<Ellipsoid> ellipsoids_;
  float waves_ = 1.0f;  // of the first octave in a metre
  float phase_ = 0.0f;
  std::uint32_t seed_;
};

}  // namespace welkin
