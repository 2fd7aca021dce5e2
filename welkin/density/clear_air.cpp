#include "welkin/density/clear_air.hpp"

#include <algorithm>
#include <glm/vector_relational.hpp>

namespace welkin {

namespace {
bool apart(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& otherLow, const glm::dvec3& otherHigh) {
  return glm::any(glm::lessThan(high, otherLow)) || glm::any(glm::greaterThan(low, otherHigh));
}
}  // namespace

ClearAir::ClearAir(const DensityField& field) {
  for (const Layer& layer : field.layers()) shells_.push_back(shellOf(layer));
  for (const PlacedGrid& grid : field.grids()) grids_.push_back(boundsOf(grid));
  if (!field.heroes().empty())
    billows_ = std::make_unique<TexelBounds>(field.heroBillows(), 0, TexelBounds::Kind::volume);
  for (const HeroBody& body : field.heroes()) {
    const glm::dvec3 anchor(body.origin.x, body.origin.y, 0.0);
    heroes_.push_back(
        {body.lowest(), body.highest(), anchor,
         std::make_unique<HeroBounds>(body.paramsAt(glm::dvec2(anchor)), *body.parts, body.shapeView(), *billows_)});
  }
}

bool ClearAir::holds(const glm::dvec3& low, const glm::dvec3& high) const {
  return std::none_of(shells_.begin(), shells_.end(),
                      [&](const Shell& s) { return high.z >= s.bottom && low.z <= s.top; }) &&
         std::all_of(grids_.begin(), grids_.end(),
                     [&](const WorldBox& box) { return apart(low, high, box.low, box.high); }) &&
         std::all_of(heroes_.begin(), heroes_.end(), [&](const HeroBox& hero) {
           return apart(low, high, hero.low, hero.high) ||
                  hero.bounds->extinctionIn(glm::vec3(low - hero.anchor), glm::vec3(high - hero.anchor)) == 0.0f;
         });
}

}  // namespace welkin
