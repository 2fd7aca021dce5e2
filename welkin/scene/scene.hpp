#pragma once
// A sky as plain values. Everything that renders or exports starts from a Scene.
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "welkin/atmosphere/settings.hpp"
#include "welkin/base/fields.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/hero.hpp"
#include "welkin/density/layer.hpp"
#include "welkin/density/noise_settings.hpp"
#include "welkin/light/settings.hpp"
#include "welkin/scene/quality.hpp"

namespace welkin {

// Wind at the height of the clouds.
struct Wind {
  float speed = 8.0f;    // m/s
  float from = 4.7124f;  // rad, compass heading that it comes from
};
template <>
struct FieldTable<Wind> {
  static auto make() {
    return fieldRows(
        field<&Wind::speed, kMetresPerSecond>("speed", {0, 150}, {0, 40}, "speed of the wind that moves the layers"),
        field<&Wind::from, kDegrees>("from", {0, 360}, {}, "where it comes from"));
  }
};

// Flashes inside the towers of thunderclouds, in real time.
struct Lightning {
  float rate = 0.0f;
  int seed = 1;
  float brightness = 1.0f;
  bool freeze = false;
};
template <>
struct FieldTable<Lightning> {
  static auto make() {
    return fieldRows(
        field<&Lightning::rate>("rate", {0, 600}, {0, 60}, "flashes a minute within 60 km; 0: none"),
        field<&Lightning::seed>("seed", {0, 2147483647}, {0, 100}, "other places and times of flashes"),
        field<&Lightning::brightness>("brightness", {0, 1e6}, {0, 10}, "their light as a multiple, 1 is real"),
        field<&Lightning::freeze>("freeze", "shows the nearest flash at its brightest all the time, for stills"));
  }
};

// The ground: a sphere of one colour.
struct Ground {
  glm::vec3 albedo{0.13f, 0.15f, 0.08f};
};
template <>
struct FieldTable<Ground> {
  static auto make() {
    return fieldRows(field<&Ground::albedo>("albedo", {0, 1}, {}, "share of light that the ground reflects"));
  }
};

// perspective: as a lens sees. equirectangular: the whole sphere, heading along x and elevation along y; the camera's
// heading and pitch are the picture's centre.
enum class Projection { perspective, equirectangular };
template <>
struct ChoiceNames<Projection> {
  static constexpr std::array<std::string_view, 2> names{"perspective", "equirectangular"};
};

// Where the picture is taken from. East, north, up in metres; up is above the ground at the origin.
struct Camera {
  Projection projection = Projection::perspective;
  glm::dvec3 position{0.0, 0.0, 150.0};
  float heading = 0.0f;  // rad, compass
  float pitch = 0.14f;   // rad, above the horizon
  float roll = 0.0f;     // rad
  float fov = 1.0472f;   // rad, horizontal
};
template <>
struct FieldTable<Camera> {
  static auto make() {
    return fieldRows(
        field<&Camera::projection>("projection", "perspective, or equirectangular: all directions at once"),
        field<&Camera::position, kMetres>("position", {-1e7, 1e7}, {-10000, 10000}, "east, north, up"),
        field<&Camera::heading, kDegrees>("heading", {-360, 360}, {0, 360}, "compass heading of the view"),
        field<&Camera::pitch, kDegrees>("pitch", {-90, 90}, {}, "angle above the horizon"),
        field<&Camera::roll, kDegrees>("roll", {-180, 180}, {}, "tilt to the right"),
        field<&Camera::fov, kDegrees>("fov", {1, 170}, {20, 110}, "horizontal angle of view of a perspective"));
  }
};

enum class ExposureMode { automatic, manual };
template <>
struct ChoiceNames<ExposureMode> {
  static constexpr std::array<std::string_view, 2> names{"automatic", "manual"};
};

// From light to a picture.
struct Film {
  ExposureMode exposure = ExposureMode::manual;
  float ev = 14.1f;           // EV100
  float compensation = 0.0f;  // stops, in both modes
  ToneCurve tone = ToneCurve::agx;
  float whiteBalance = 5600.0f;  // K
  float saturation = 1.0f;
};
template <>
struct FieldTable<Film> {
  static auto make() {
    return fieldRows(
        field<&Film::exposure>("exposure", "manual takes ev, automatic measures the picture"),
        field<&Film::ev, kStops>("ev", {-10, 25}, {6, 17}, "exposure value at ISO 100: 15 in full sun, 10 at dusk"),
        field<&Film::compensation, kStops>("compensation", {-10, 10}, {-3, 3}, "added brightness"),
        field<&Film::tone>("tone", "tone curve of 8-bit pictures"),
        field<&Film::whiteBalance, kKelvin>("white_balance", {2000, 20000}, {3500, 12000},
                                            "colour temperature of the light that looks white; 6504 changes nothing"),
        field<&Film::saturation>("saturation", {0, 2}, {0.5, 1.5}, "1 leaves colours as they are"));
  }
};

inline constexpr std::size_t kMaxLayers = 4, kMaxSheets = 4, kMaxGrids = 4, kMaxHeroes = 32;

struct Scene {
  std::string title;
  float time = 0.0f;  // s
  int seed = 1;
  std::vector<Layer> layers{Layer{}};
  std::vector<Sheet> sheets;
  std::vector<GridCloud> grids;
  std::vector<Hero> heroes;
  Sun sun;
  Moon moon;
  Night night;
  Atmosphere atmosphere;
  Wind wind;
  Lightning lightning;
  Ground ground;
  LightingSettings lighting;
  Camera camera;
  Film film;
  Quality quality;
  NoiseSettings noise;
};

}  // namespace welkin
