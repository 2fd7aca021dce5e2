#include "apps/welkin/shot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/animation.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin::app {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kEyes = 2.0;  // m: a flight keeps so far above the ground

void turn(Camera& camera, double angle, double radius) {
  const double heading = std::remainder(camera.heading + angle, kTurn);
  camera.position += radius * (directionFromAngles(camera.heading, 0.0) - directionFromAngles(heading, 0.0));
  camera.heading = static_cast<float>(heading);
}

// A file that a sky names, as far as can be told without reading it.
std::string fileIdentity(const std::string& path) {
  std::error_code ignored;
  const auto time = std::filesystem::last_write_time(path, ignored).time_since_epoch().count();
  return path.empty() ? "" : fmt::format("file {} {} {}\n", path, std::filesystem::file_size(path, ignored), time);
}

}  // namespace

Scene Shot::at(int frame) const {
  const double seconds = secondsAt(frame);
  Scene s = sceneAt(scene, scene.time + timeScale * seconds);
  Camera& camera = s.camera;
  switch (path) {
    case ShotPath::still:
      break;
    case ShotPath::turntable:
      turn(camera, kTurn * frame / frames, orbit);
      break;
    case ShotPath::timelapse:
      if (!hasKeyframes(scene, "sun.")) passDay(s, timeScale * seconds);
      break;
    case ShotPath::flight: {
      const glm::dvec3 forward = cameraAxes(sceneAt(scene, scene.time).camera)[2];
      camera.position += airspeed * seconds * forward;
      camera.position.z = std::max(camera.position.z, kEyes);
      break;
    }
  }
  return s;
}

void followFile(Shot& shot, const std::string& path) {
  std::vector<Keyframe> keyframes = loadKeyframes(path, shot.scene);
  std::set<std::string> paths;
  for (Keyframe& keyframe : keyframes) {
    keyframe.time = shot.scene.time + shot.timeScale * keyframe.time;
    for (const KeyValue& v : keyframe.values) paths.insert(v.path);
  }
  for (const std::string& p : paths) dropKeyframes(shot.scene, p);
  shot.scene.keyframes.insert(shot.scene.keyframes.end(), keyframes.begin(), keyframes.end());
}

std::string identityOf(const Shot& shot) {
  std::string text =
      fmt::format("path {} frames {} fps {} time-scale {} orbit {} airspeed {}\n{}", static_cast<int>(shot.path),
                  shot.frames, shot.framesPerSecond, shot.timeScale, shot.orbit, shot.airspeed, writeSky(shot.scene));
  for (const Layer& layer : shot.scene.layers) text += fileIdentity(layer.weather.map);
  for (const GridCloud& grid : shot.scene.grids) text += fileIdentity(grid.file);
  return text;
}

}  // namespace welkin::app
