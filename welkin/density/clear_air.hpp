#pragma once
// Boxes of a field that certainly hold no cloud: what a baker need not sample.
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "welkin/density/field.hpp"
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/hero_bounds.hpp"

namespace welkin {

// Keeps a reference to the field, whose drift stays meanwhile. Safe to ask from many threads.
class ClearAir {
 public:
  explicit ClearAir(const DensityField& field);

  // Whether the extinction is 0 at every point between the corners (cloud space, m), for footprint 0. Exact for shells
  // of layers and boxes of grids, by interval arithmetic for hero clouds; false where it cannot tell.
  bool holds(const glm::dvec3& low, const glm::dvec3& high) const;

 private:
  struct HeroBox {
    glm::dvec3 low, high, anchor;
    std::unique_ptr<HeroBounds> bounds;
  };
  std::vector<Shell> shells_;
  std::vector<WorldBox> grids_;
  std::unique_ptr<TexelBounds> billows_;
  std::vector<HeroBox> heroes_;
};

}  // namespace welkin
