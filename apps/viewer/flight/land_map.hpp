#pragma once
// The land of flights as a map.
#include "apps/viewer/flight/terrain.hpp"
#include "apps/viewer/model/map_picture.hpp"

namespace welkin::viewer {

// A square of `edge` m round the origin, in colours of a satellite's picture with a little relief.
MapPicture landMap(const Terrain& terrain, double edge, int pixels);

}  // namespace welkin::viewer
