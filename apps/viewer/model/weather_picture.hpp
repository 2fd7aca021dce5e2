#pragma once
// The authoring picture of a layer's weather in the user's hands: coverage, precipitation, type and base height over a
// square of land that repeats, and the brush that changes them.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "welkin/noise/volume.hpp"

namespace welkin::viewer {

// Values in [0, 1] with 16 bits, what a PNG keeps. Copies share their tiles until they are painted, so that every
// stroke can be undone.
class WeatherPicture {
 public:
  static constexpr int kChannels = 4, kTile = 64, kLargest = 4096;  // texels a side

  // The same value everywhere.
  WeatherPicture(int width, int height, const glm::vec4& value);
  // Of an authoring map: RGBA, south row first. Throws Error (badInput) when it is larger than can be painted.
  explicit WeatherPicture(const Volume& map);

  int width() const { return width_; }
  int height() const { return height_; }
  float at(int x, int y, int channel) const;
  Volume volume() const;
  // Rows from the north, for savePng16().
  std::vector<std::uint16_t> samples() const;

  // Moves a channel toward `target` inside an ellipse round `centre` (texels from the south-west corner), by `strength`
  // in its middle and less and less to its edge. What reaches over an edge of the picture comes in at the other.
  void dab(int channel, const glm::dvec2& centre, const glm::dvec2& radius, float strength, float target);

 private:
  using Tile = std::array<std::uint16_t, std::size_t{kTile} * kTile * kChannels>;
  Tile& own(int x, int y);  // the tile of a texel, shared with nobody
  static std::size_t offset(int x, int y);

  int width_, height_, across_;
  std::vector<std::shared_ptr<Tile>> tiles_;
};

struct Brush {
  int channel = 0;         // 0 coverage, 1 precipitation, 2 type, 3 base height
  bool erases = false;     // toward 0 instead of 1
  float radius = 3000.0f;  // m
  float strength = 0.5f;   // of a dab, in (0, 1]
};
inline constexpr std::array<const char*, 4> kWeatherChannels = {"coverage", "precipitation", "type", "base height"};

// A stroke: dabs a quarter of the radius apart, however fast the hand is.
class Stroke {
 public:
  // Paints on to a place: east and north in m from the middle of the picture, whose edge is `size` m long. Returns
  // whether there was room for a dab.
  bool follow(WeatherPicture& picture, const Brush& brush, double size, const glm::dvec2& place);

 private:
  std::optional<glm::dvec2> last_;
};

}  // namespace welkin::viewer
