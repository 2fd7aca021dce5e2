#include "apps/viewer/model/weather_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

constexpr float kMost = 65535.0f;
constexpr double kSpacing = 0.25;  // of dabs, as a share of the radius
constexpr int kMostDabs = 2000;    // of one movement: a jump across the land is not drawn out

std::uint16_t sampleOf(float value) {
  return static_cast<std::uint16_t>(std::lround(kMost * std::clamp(value, 0.0f, 1.0f)));
}

int wrapped(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

WeatherPicture::WeatherPicture(int width, int height, const glm::vec4& value)
    : width_(width), height_(height), across_((width + kTile - 1) / kTile) {
  const auto tile = std::make_shared<Tile>();
  for (std::size_t i = 0; i < tile->size(); ++i) (*tile)[i] = sampleOf(value[static_cast<int>(i % kChannels)]);
  tiles_.assign(static_cast<std::size_t>(across_) * ((height + kTile - 1) / kTile), tile);
}

WeatherPicture::WeatherPicture(const Volume& map) : WeatherPicture(map.width, map.height, glm::vec4(0.0f)) {
  if (map.channels != kChannels || std::max(map.width, map.height) > kLargest)
    throw Error(ErrorKind::badInput, "",
                fmt::format("a weather map of {}x{} is too large to be painted: scale it to at most {} pixels a side",
                            map.width, map.height, kLargest));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      std::uint16_t* to = &own(x, y)[offset(x, y)];
      for (int c = 0; c < kChannels; ++c) to[c] = sampleOf(map.at(x, y, 0)[c]);
    }
}

std::size_t WeatherPicture::offset(int x, int y) {
  return (static_cast<std::size_t>(y % kTile) * kTile + static_cast<std::size_t>(x % kTile)) * kChannels;
}

WeatherPicture::Tile& WeatherPicture::own(int x, int y) {
  std::shared_ptr<Tile>& tile = tiles_[static_cast<std::size_t>(y / kTile) * across_ + x / kTile];
  if (tile.use_count() > 1) tile = std::make_shared<Tile>(*tile);
  return *tile;
}

float WeatherPicture::at(int x, int y, int channel) const {
  const Tile& tile = *tiles_[static_cast<std::size_t>(y / kTile) * across_ + x / kTile];
  return static_cast<float>(tile[offset(x, y) + static_cast<std::size_t>(channel)]) / kMost;
}

Volume WeatherPicture::volume() const {
  Volume map(width_, height_, 1, kChannels);
  float* to = map.texels.data();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < kChannels; ++c) *to++ = at(x, y, c);
  return map;
}

std::vector<std::uint16_t> WeatherPicture::samples() const {
  std::vector<std::uint16_t> samples;
  samples.reserve(static_cast<std::size_t>(width_) * height_ * kChannels);
  for (int y = height_ - 1; y >= 0; --y)
    for (int x = 0; x < width_; ++x) {
      const Tile& tile = *tiles_[static_cast<std::size_t>(y / kTile) * across_ + x / kTile];
      const std::uint16_t* from = &tile[offset(x, y)];
      samples.insert(samples.end(), from, from + kChannels);
    }
  return samples;
}

void WeatherPicture::dab(int channel, const glm::dvec2& centre, const glm::dvec2& radius, float strength,
                         float target) {
  const auto range = [](double middle, double reach, int size) {
    // At most once round.
    const double least = std::max(std::min(reach, 0.5 * size), 0.5);
    const int low = static_cast<int>(std::ceil(middle - least - 0.5));
    return std::pair{low, std::min(static_cast<int>(std::floor(middle + least - 0.5)), low + size - 1)};
  };
  const auto [x0, x1] = range(centre.x, radius.x, width_);
  const auto [y0, y1] = range(centre.y, radius.y, height_);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      // A brush finer than a texel takes the texel below it.
      const glm::dvec2 away =
          (glm::dvec2(x + 0.5, y + 0.5) - centre) / glm::dvec2(std::max(radius.x, 1.0), std::max(radius.y, 1.0));
      const auto inside = static_cast<float>(1.0 - glm::dot(away, away));
      if (inside <= 0.0f) continue;
      const int i = wrapped(x, width_), j = wrapped(y, height_);
      std::uint16_t& sample = own(i, j)[offset(i, j) + static_cast<std::size_t>(channel)];
      const float value = static_cast<float>(sample) / kMost;
      sample = sampleOf(value + (target - value) * strength * inside * inside);
    }
}

bool Stroke::follow(WeatherPicture& picture, const Brush& brush, double size, const glm::dvec2& place) {
  const glm::dvec2 texels = glm::dvec2(picture.width(), picture.height()) / size;
  const auto dab = [&](const glm::dvec2& at) {
    const glm::dvec2 share = at / size + 0.5;
    picture.dab(brush.channel, (share - glm::floor(share)) * size * texels, static_cast<double>(brush.radius) * texels,
                brush.strength, brush.erases ? 0.0f : 1.0f);
  };
  if (!last_) {
    dab(place);
    last_ = place;
    return true;
  }
  const double step = std::max(kSpacing * static_cast<double>(brush.radius), 0.5 * size / picture.width());
  const glm::dvec2 way = place - *last_;
  const double length = glm::length(way);
  const int dabs = static_cast<int>(std::min(length / step, static_cast<double>(kMostDabs)));
  const glm::dvec2 begin = *last_;
  for (int i = 1; i <= dabs; ++i) dab(*last_ = begin + way * (i * step / length));
  return dabs > 0;
}

}  // namespace welkin::viewer
