#include "apps/welkin/map_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "apps/welkin/usage_error.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/geotiff.hpp"
#include "welkin/io/png.hpp"

namespace welkin::app {

namespace {

std::array<double, 4> parseCorners(const std::string& text) {
  std::array<double, 4> corners{};
  const char *at = text.data(), *end = at + text.size();
  bool right = true;
  for (std::size_t i = 0; right && i < corners.size(); ++i) {
    right = i == 0 || (at != end && *at++ == ',');
    if (!right) break;
    const auto [rest, error] = std::from_chars(at, end, corners[i]);
    right = error == std::errc() && std::abs(corners[i]) <= 1e7;
    at = rest;
  }
  if (!right || at != end || corners[2] - corners[0] < 1.0 || corners[3] - corners[1] < 1.0)
    throw UsageError(
        fmt::format("--map-corners {}: write WEST,SOUTH,EAST,NORTH in metres from the sky's origin, for example "
                    "-20000,-15000,20000,15000",
                    text));
  return corners;
}

}  // namespace

viewer::MapPicture loadMap(const std::string& path, const std::string& corners) {
  viewer::MapPicture map;
  if (!corners.empty()) {
    const std::array<double, 4> c = parseCorners(corners);
    map.corner = {c[0], c[1]};
    map.size = glm::dvec2(c[2], c[3]) - map.corner;
  }
  if (path.ends_with(".tif") || path.ends_with(".tiff")) {
    GeoPicture geo = loadGeoTiff(path);
    map.picture = std::move(geo.picture);
    if (corners.empty()) {
      map.size = geo.size;
      map.corner = -0.5 * geo.size;
    }
  } else if (path.ends_with(".png")) {
    if (corners.empty())
      throw UsageError(fmt::format("'{}': a PNG does not say where its land is; give --map-corners", path));
    map.picture = loadPng(path);
  } else {
    throw UsageError(fmt::format("'{}': a map is a GeoTIFF (.tif) or a .png", path));
  }
  return map;
}

}  // namespace welkin::app
