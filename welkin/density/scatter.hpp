#pragma once
// Copies of one cloud over the land (scatter.glsl).
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "welkin/density/law.hpp"

namespace welkin {

struct Scatter {
  glm::dvec2 centre{0.0};       // the cloud's own place: east, north in m
  law::ScatterParams params{};  // but for the plane of `place`, which hangs on the anchor

  bool any() const { return params.place.w > 0.0f; }
  law::ScatterParams paramsAt(const glm::dvec2& anchor) const;
  // What point of the cloud itself a point of cloud space is; far below it where there is no copy.
  glm::dvec3 toCloud(const glm::dvec3& point) const;
  // Corners of a box that holds all copies, from those of a box that holds the cloud itself.
  glm::dvec3 lowest(const glm::dvec3& low) const { return corner(low, -1.0); }
  glm::dvec3 highest(const glm::dvec3& high) const { return corner(high, 1.0); }

 private:
  glm::dvec3 corner(const glm::dvec3& own, double side) const;
};

}  // namespace welkin
