#pragma once
// A hero cloud made ready for its law: the smooth shape as a small grid of depths, its parts, and parameters.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "welkin/density/hero.hpp"
#include "welkin/density/law.hpp"
#include "welkin/density/params.hpp"
#include "welkin/density/scatter.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {

struct HeroBody {
  glm::dvec3 origin{0.0};    // the middle of its base: east, north, altitude in m, at the time of the drift
  law::HeroParams params{};  // but for `place` and `scatter`, which hang on the anchor
  Scatter scatter{};
  std::shared_ptr<const law::HeroParts> parts;
  // RGBA over the box, as halves: unit normal and depth below the smooth surface in m; of "classic" the shape gradient
  // in the last channel. One texel for kinds that have none.
  std::shared_ptr<const Volume> shape;

  TextureView shapeView() const;
  // The law's parameters for points relative to an anchor on the ground (east, north).
  law::HeroParams paramsAt(const glm::dvec2& anchor) const;
  // Corners of a box along the world's axes that holds it, copies and all, in m.
  glm::dvec3 lowest() const;
  glm::dvec3 highest() const;
};

// The cloud at a time; `seed` is the scene's. Its grid has about `cells` cells.
constexpr int kHeroGridCells = 250000;
HeroBody bakeHero(const Hero& hero, const Drift& drift, int seed, int cells = kHeroGridCells);

// Where the copies of a cloud stand whose body is made.
Scatter scatterOf(const Hero& hero, const HeroBody& body);

// The tile of billows that all hero clouds share, as halves.
Volume bakeHeroBillows();

}  // namespace welkin
