#pragma once
// A picture of land, and where the land lies under the sky.
#include <glm/vec2.hpp>

#include "welkin/base/image.hpp"

namespace welkin::viewer {

struct MapPicture {
  Image picture;           // values in [0, 1], sRGB; the north row first
  glm::dvec2 corner{0.0};  // the south-west one, m east and north of the sky's origin
  glm::dvec2 size{1.0};    // west to east and south to north, m
};

}  // namespace welkin::viewer
