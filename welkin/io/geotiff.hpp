#pragma once
// GeoTIFF: a picture of land that says how large the land is.
#include <glm/vec2.hpp>
#include <string>

#include "welkin/base/image.hpp"

namespace welkin {

struct GeoPicture {
  Image picture;         // 3 channels in [0, 1], as stored (sRGB); the north row first
  glm::dvec2 size{0.0};  // of the land, west to east and south to north, m
};

// Reads the first picture of a TIFF with the tags ModelPixelScale and GeoKeyDirectory (OGC 19-008r4, chapter 7): grids
// in metres or feet, or degrees of longitude and latitude, which become metres at the picture's middle. North is up;
// other turns are refused. Throws Error (badInput), also for pictures of more than 16384 pixels a side or 2^26 in all.
GeoPicture loadGeoTiff(const std::string& path);

}  // namespace welkin
