#pragma once
// The smooth shapes of hero clouds: depth below the surface in m, positive inside, in the cloud's own axes.
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "welkin/density/hero.hpp"
#include "welkin/noise/law.hpp"

namespace welkin {

// Independent numbers in [low, high), the same for the same seed.
class HeroDice {
 public:
  explicit HeroDice(std::uint32_t seed) : hash_(law::hashUint(seed)) {}
  float operator()(float low, float high) {
    hash_ = law::nextHash(hash_);
    return low + (high - low) * law::unitFromHash(hash_);
  }

 private:
  std::uint32_t hash_;
};

// What an age means, each from 0 to 1.
struct HeroLife {
  float age = 0.75f;
  float growth = 1.0f;  // of its size
  float spread = 1.0f;  // of the anvil
  float decay = 0.0f;
  float density = 1.0f;
};
HeroLife heroLife(float age);

// Lengths in m, at an age.
struct HeroSolid {
  HeroForm form;
  float size = 0.0f;             // sqrt(width height)
  float taper = 0.0f;            // m, by which the rim draws in
  float eaten = 0.0f;            // m, by decay
  std::vector<glm::vec4> balls;  // of towers and turrets: centre and radius
  std::vector<glm::vec4> pucks;  // flat ellipsoids at the base: centre and radius
};

// For the shapes towers, rows, curve and ellipsoid; `form` fully grown, `taper` as a share of the size.
HeroSolid heroSolid(const HeroForm& form, float taper, const HeroLife& life, std::uint32_t seed);

// Unit outward normal and depth.
glm::vec4 depthIn(const HeroSolid& solid, const glm::vec3& x);

// Corners of a box that holds its surface.
void boundsOf(const HeroSolid& solid, glm::vec3& low, glm::vec3& high);

// Radius of the gradation curve at a share of the height, as a share of half the width: a cubic through the squares of
// the six radii that does not overshoot (Fritsch and Butland 1984).
float gradation(const HeroForm& form, float height);

// 003 eq. 3.2: S(Tz) - Tx^2 - Ty^2 in a box of the form's size, for coordinates multiplied by `scale`. Beyond the ends
// of its curve S falls off.
float shapeGradient(const HeroForm& form, float scale, const glm::vec3& x);

}  // namespace welkin
