#include "apps/viewer/flight/land_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "welkin/base/parallel.hpp"
#include "welkin/noise/law.hpp"

namespace welkin::viewer {

namespace {

float rise(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

float srgb(float linear) {
  linear = std::clamp(linear, 0.0f, 1.0f);
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Albedo, near those of flight_view/land_shader.hpp; parcels of fields some hundred metres wide.
glm::vec3 albedo(double height, double slope, double woods, const glm::dvec2& place) {
  if (height <= 0.0)
    return glm::mix(glm::vec3(0.035f, 0.075f, 0.075f), glm::vec3(0.008f, 0.025f, 0.04f), rise(0, 25, -height));
  // Rows of parcels, turned from one square of the land to the next.
  const auto square = glm::ivec2(glm::floor(place / 5100.0));
  const double turn = 1.5 * static_cast<double>(law::unitFromHash(law::hashCell2(square.x, square.y, 5u)));
  const glm::dvec2 along(std::cos(turn), std::sin(turn));
  const auto cell = glm::ivec2(
      glm::floor(glm::dvec2(glm::dot(place, along) / 380.0, glm::dot(place, glm::dvec2(-along.y, along.x)) / 260.0)));
  const float kind = law::unitFromHash(law::hashCell2(cell.x, cell.y, 9u));
  glm::vec3 colour = glm::mix(glm::vec3(0.058f, 0.082f, 0.03f), glm::vec3(0.115f, 0.105f, 0.05f), kind * kind);
  colour = glm::mix(colour, glm::vec3(0.07f, 0.085f, 0.032f), rise(0.05, 0.16, slope));
  colour =
      glm::mix(colour, glm::vec3(0.024f, 0.038f, 0.015f), rise(0.1, 0.35, woods + slope) * rise(1500, 1050, height));
  colour = glm::mix(colour, glm::vec3(0.105f, 0.095f, 0.055f), rise(1000, 1500, height));
  colour = glm::mix(colour, glm::vec3(0.15f, 0.14f, 0.125f), rise(0.55, 0.9, slope));
  colour = glm::mix(colour, glm::vec3(0.75f, 0.77f, 0.8f), rise(1650, 1950, height) * rise(1.1, 0.7, slope));
  return glm::mix(glm::vec3(0.28f, 0.24f, 0.17f), colour, rise(0.2, 1.2, height));
}

}  // namespace

MapPicture landMap(const Terrain& terrain, double edge, int pixels) {
  MapPicture map{.picture = Image(pixels, pixels, 3), .corner = glm::dvec2(-0.5 * edge), .size = glm::dvec2(edge)};
  const double pixel = edge / pixels;
  const auto place = [&](int x, int y) { return map.corner + glm::dvec2((x + 0.5) * pixel, edge - (y + 0.5) * pixel); };
  // With a border for slopes.
  const int wide = pixels + 1;
  std::vector<double> heights(static_cast<std::size_t>(wide) * wide);
  parallelFor(static_cast<std::size_t>(wide), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < wide; ++x) {
        const glm::dvec2 p = place(x, static_cast<int>(y));
        heights[y * wide + static_cast<std::size_t>(x)] = terrain.height(p.x, p.y);
      }
  });
  parallelFor(static_cast<std::size_t>(pixels), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < pixels; ++x) {
        const double* h = &heights[y * wide + static_cast<std::size_t>(x)];
        const glm::dvec2 p = place(x, static_cast<int>(y)), slope(h[1] - h[0], h[0] - h[wide]);
        const double steep = glm::length(slope) / pixel;
        glm::vec3 colour = albedo(*h, steep, terrain.woods(p.x, p.y), p);
        // Lit from the north-west, as maps are.
        if (*h > 0.0) colour *= static_cast<float>(std::clamp(1.0 + 0.9 * (slope.x - slope.y) / pixel, 0.5, 1.5));
        float* to = map.picture.at(x, static_cast<int>(y));
        for (int c = 0; c < 3; ++c) to[c] = srgb(colour[c]);
      }
  });
  return map;
}

}  // namespace welkin::viewer
