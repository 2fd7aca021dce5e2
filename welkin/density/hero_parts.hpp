#pragma once
// The parts of hero clouds that are geometry: plates, patches and filaments (hero.glsl says how they are packed).
#include <cstdint>

#include "welkin/density/hero_shape.hpp"
#include "welkin/density/law.hpp"

namespace welkin {

struct HeroGeometry {
  law::HeroParts parts{};
  int count = 0;
  glm::vec3 low{0.0f}, high{0.0f};  // corners of a box that holds all of it, m
};

// `form` in m at its age.
HeroGeometry heroPlates(const HeroForm& form, std::uint32_t seed);
HeroGeometry heroPatches(const HeroForm& form, std::uint32_t seed);
HeroGeometry heroFilaments(const HeroForm& form, std::uint32_t seed);

}  // namespace welkin
