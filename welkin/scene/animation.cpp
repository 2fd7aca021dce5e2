#include "welkin/scene/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <span>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/error.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin {

namespace {

// The keyframes of one parameter, in the order of time.
struct Key {
  double time;
  Interpolation interpolation;
  FieldValue value;
};
using Track = std::vector<Key>;

std::vector<Keyframe> inOrder(const Scene& scene) {
  std::vector<Keyframe> keyframes = scene.keyframes;
  std::stable_sort(keyframes.begin(), keyframes.end(),
                   [](const Keyframe& a, const Keyframe& b) { return a.time < b.time; });
  return keyframes;
}

// The last key that is not after `time`; the first before all of them.
std::size_t keyBefore(const Track& track, double time) {
  std::size_t i = 0;
  while (i + 1 < track.size() && track[i + 1].time <= time) ++i;
  return i;
}

double slope(const Track& track, std::span<const double> values, std::size_t i) {
  const double span = track[i + 1].time - track[i].time;
  return span > 0.0 ? (values[i + 1] - values[i]) / span : 0.0;
}

// Speed with which a smooth curve passes a key: monotone cubics (Steffen 1990, eq. 11), at rest at ends and at steps.
double speedAt(const Track& track, std::span<const double> values, std::size_t i) {
  if (i == 0 || i + 1 == track.size()) return 0.0;
  if (track[i - 1].interpolation == Interpolation::step || track[i].interpolation == Interpolation::step) return 0.0;
  const double before = slope(track, values, i - 1), after = slope(track, values, i);
  const double spanBefore = track[i].time - track[i - 1].time, spanAfter = track[i + 1].time - track[i].time;
  if (before * after <= 0.0 || spanBefore + spanAfter <= 0.0) return 0.0;
  const double mean = (before * spanAfter + after * spanBefore) / (spanBefore + spanAfter);
  return std::copysign(2.0 * std::min({std::abs(before), std::abs(after), 0.5 * std::abs(mean)}), before);
}

double valueAt(const Track& track, std::span<const double> values, double time) {
  const std::size_t i = keyBefore(track, time);
  if (i + 1 == track.size() || time <= track[i].time || track[i].interpolation == Interpolation::step) return values[i];
  const double span = track[i + 1].time - track[i].time, t = (time - track[i].time) / span;
  if (track[i].interpolation == Interpolation::linear) return values[i] + (values[i + 1] - values[i]) * t;
  const double from = speedAt(track, values, i) * span, to = speedAt(track, values, i + 1) * span;
  const double u = 1.0 - t;  // cubic Hermite
  return u * u * ((1.0 + 2.0 * t) * values[i] + t * from) + t * t * ((1.0 + 2.0 * u) * values[i + 1] - u * to);
}

// A number of the field at a time. `component` reads it from a key.
double numberAt(const Field& field, const Track& track, double time,
                const std::function<double(const FieldValue&)>& component) {
  std::vector<double> values;
  const double period = periodOf(field);
  for (const Key& key : track) {
    const double value = component(key.value);
    values.push_back(values.empty() || period == 0.0 ? value
                                                     : values.back() + std::remainder(value - values.back(), period));
  }
  double value = valueAt(track, values, time);
  if (period > 0.0 && (value < field.hard.low || value > field.hard.high))
    value -= period * std::floor((value - field.hard.low) / period);
  return std::clamp(value, field.hard.low, field.hard.high);
}

FieldValue fieldAt(const Field& field, const Track& track, double time) {
  if (field.kind == FieldKind::real)
    return numberAt(field, track, time, [](const FieldValue& v) { return std::get<double>(v); });
  if (field.kind != FieldKind::vector) return track[keyBefore(track, time)].value;
  std::array<double, 3> vector{};
  for (std::size_t k = 0; k < 3; ++k)
    vector[k] =
        numberAt(field, track, time, [k](const FieldValue& v) { return std::get<std::array<double, 3>>(v)[k]; });
  return vector;
}

// The sun's date and time as days, where keyframes set either.
void setMoment(Sun& sun, std::span<const Keyframe> keyframes, double time) {
  Track track;
  std::vector<double> days;
  bool hours = false;
  DateTime moment{sun.date, sun.time};
  for (const Keyframe& keyframe : keyframes) {
    const std::string *date = nullptr, *hour = nullptr;
    for (const KeyValue& v : keyframe.values) {
      if (v.path == "sun.date") date = std::get_if<std::string>(&v.value);
      if (v.path == "sun.time") hour = std::get_if<std::string>(&v.value);
    }
    if (!date && !hour) continue;
    hours = hours || hour;
    if (date) moment.date = *date;
    if (hour) moment.time = *hour;
    double day = daysFromDateTime(moment.date, moment.time);
    if (!date && !days.empty() && day < days.back()) {
      day += 1.0;
      moment.date = dateTimeFromDays(day).date;
    }
    track.push_back({keyframe.time, keyframe.interpolation, {}});
    days.push_back(day);
  }
  if (track.empty()) return;
  const double day = valueAt(track, days, time);
  // Whole days from a noon, so that rounding does not tip one over.
  const DateTime shown =
      dateTimeFromDays(hours ? day : std::floor(day - daysFromDateTime("2000-01-01", sun.time) + 1e-6));
  sun.date = shown.date;
  if (hours) sun.time = shown.time;
}

void turnAbout(const glm::dvec3& axis, double angle, float& azimuth, float& elevation) {
  const glm::dvec3 turned = glm::angleAxis(angle, axis) * directionFromAngles(azimuth, elevation);
  const double heading = std::atan2(turned.x, turned.y);
  azimuth = static_cast<float>(heading < 0.0 ? heading + 2.0 * std::numbers::pi : heading);
  elevation = static_cast<float>(std::asin(std::clamp(turned.z, -1.0, 1.0)));
}

}  // namespace

double periodOf(const Field& field) {
  if (field.kind != FieldKind::real) return 0.0;
  const double range = field.hard.high - field.hard.low;
  const std::string_view unit = field.unit.symbol;
  if (unit == kDegrees.symbol) return range >= 360.0 ? 360.0 : 0.0;
  return unit == kHours.symbol && range == 24.0 ? 24.0 : 0.0;
}

Scene sceneAt(const Scene& animated, double time) {
  Scene scene = animated;
  scene.keyframes.clear();
  scene.time = static_cast<float>(time);
  const std::vector<Keyframe> keyframes = inOrder(animated);
  std::map<std::string, Track> tracks;
  for (const Keyframe& keyframe : keyframes)
    for (const KeyValue& v : keyframe.values)
      tracks[v.path].push_back({keyframe.time, keyframe.interpolation, v.value});
  setMoment(scene.sun, keyframes, time);
  tracks.erase("sun.date");
  tracks.erase("sun.time");
  if (tracks.empty()) return scene;
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::badInput, "keyframe", what); };
  const auto refuseValue = [&](const std::string& path, const std::string& wrong) {
    if (!wrong.empty()) refuse(fmt::format("{} {}", path, wrong));
  };
  // In the order of the sections: quality.preset comes before what it sets.
  const std::vector<Section> sections = sectionsOf(scene);
  for (const Section& section : sections)
    for (const Field& field : section.fields) {
      const auto found =
          tracks.find(section.path.empty() ? field.name : fmt::format("{}.{}", section.path, field.name));
      if (found == tracks.end()) continue;
      auto& [path, track] = *found;
      for (Key& key : track) refuseValue(path, checkField(field, key.value));
      refuseValue(path, assign(scene, section, field, fieldAt(field, track, time)));
      tracks.erase(found);
    }
  if (!tracks.empty()) refuse(unknownParameter(scene, sections, tracks.begin()->first));
  return scene;
}

void dropKeyframes(Scene& scene, std::string_view path) {
  // "quality.preset" and "hero.0.species" set whatever is beside and below them.
  const bool all = path == "quality.preset" || (path.starts_with("hero.") && path.ends_with(".species"));
  const std::string_view beside = path.substr(0, path.rfind('.') + 1);
  for (Keyframe& keyframe : scene.keyframes)
    std::erase_if(keyframe.values,
                  [&](const KeyValue& v) { return v.path == path || (all && v.path.starts_with(beside)); });
  std::erase_if(scene.keyframes, [](const Keyframe& k) { return k.values.empty(); });
}

bool hasKeyframes(const Scene& scene, std::string_view path) {
  return std::any_of(scene.keyframes.begin(), scene.keyframes.end(), [&](const Keyframe& k) {
    return std::any_of(k.values.begin(), k.values.end(), [&](const KeyValue& v) {
      return v.path == path || (path.ends_with('.') && v.path.starts_with(path));
    });
  });
}

void passDay(Scene& scene, double seconds) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kSolarDay = 86400.0, kSiderealDay = 86164.0905, kLunarDay = 89428.33;  // s, means
  Sun& sun = scene.sun;
  if (sun.mode == SunMode::place) {
    const DateTime later = dateTimeFromDays(daysFromDateTime(sun.date, sun.time) + seconds / kSolarDay);
    sun.date = later.date;
    sun.time = later.time;
    return;
  }
  // The sky turns against the Earth, about the pole that stands in the north as high as the latitude.
  const glm::dvec3 pole = directionFromAngles(0.0, sun.latitude);
  turnAbout(pole, -kTurn * seconds / kSolarDay, sun.azimuth, sun.elevation);
  if (scene.moon.mode == MoonMode::angles)
    turnAbout(pole, -kTurn * seconds / kLunarDay, scene.moon.azimuth, scene.moon.elevation);
  const double stars = std::fmod(scene.night.siderealTime + seconds * kSolarDay / kSiderealDay, kSolarDay);
  scene.night.siderealTime = static_cast<float>(stars < 0.0 ? stars + kSolarDay : stars);
}

}  // namespace welkin
