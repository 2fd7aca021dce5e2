#include "welkin/density/scatter.hpp"

namespace welkin {

law::ScatterParams Scatter::paramsAt(const glm::dvec2& anchor) const {
  law::ScatterParams p = params;
  const glm::dvec2 place = centre - anchor;
  p.place.x = static_cast<float>(place.x);
  p.place.y = static_cast<float>(place.y);
  return p;
}

glm::dvec3 Scatter::toCloud(const glm::dvec3& point) const {
  if (!any()) return point;
  const glm::dvec3 anchor(centre, 0.0);
  return glm::dvec3(law::scatteredPoint(glm::vec3(point - anchor), paramsAt(centre))) + anchor;
}

glm::dvec3 Scatter::corner(const glm::dvec3& own, double side) const {
  if (!any()) return own;
  const double out = static_cast<double>(params.chance.x) + 0.5 * static_cast<double>(params.place.w);
  const double base = params.place.z, most = 1.0 + static_cast<double>(params.chance.z);
  return {centre + side * out, base + most * (own.z - base)};
}

}  // namespace welkin
