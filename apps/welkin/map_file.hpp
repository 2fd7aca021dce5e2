#pragma once
// Pictures of land for the map view.
#include <string>

#include "apps/viewer/model/map_picture.hpp"

namespace welkin::app {

// A GeoTIFF, whose middle lies under the sky's origin, or a PNG; or either at the corners "WEST,SOUTH,EAST,NORTH", m
// from the sky's origin, empty for none. Throws UsageError, and Error (badInput) for what cannot be read.
viewer::MapPicture loadMap(const std::string& path, const std::string& corners);

}  // namespace welkin::app
