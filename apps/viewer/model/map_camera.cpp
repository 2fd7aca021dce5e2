#include "apps/viewer/model/map_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/angle.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin::viewer {

namespace {

constexpr float kStraightDown = static_cast<float>(-0.5 * kPi), kFlattest = static_cast<float>(-12.0 * kPi / 180.0);
constexpr double kLowestMap = 500.0, kHighestMap = 100e3;  // m above the ground
constexpr double kFarthestMap = 1e7;                       // m from the sky's origin

// Metres from the camera to the ground in the middle of the picture.
double distanceOf(const Camera& camera) {
  return camera.position.z / std::sin(-static_cast<double>(std::clamp(camera.pitch, kStraightDown, kFlattest)));
}

// Hangs the camera over a point of the ground.
void hang(Camera& camera, const glm::dvec2& point, double distance) {
  camera.pitch = std::clamp(camera.pitch, kStraightDown, kFlattest);
  camera.heading = static_cast<float>(camera.heading - 2.0 * kPi * std::floor(camera.heading / (2.0 * kPi)));
  camera.roll = 0.0f;
  const double slant = std::sin(-static_cast<double>(camera.pitch));
  distance = std::clamp(distance, kLowestMap / slant, kHighestMap / slant);
  const glm::dvec3 forward = cameraAxes(camera)[2];
  camera.position = glm::dvec3(glm::clamp(point, -kFarthestMap, kFarthestMap), 0.0) - forward * distance;
  camera.position.z = std::clamp(camera.position.z, kLowestMap, kHighestMap);
}

glm::dvec2 pointUnder(const Camera& camera) {
  return glm::dvec2(camera.position + cameraAxes(camera)[2] * distanceOf(camera));
}

}  // namespace

Camera cameraOver(const Camera& camera, const MapPicture& map, double aspect) {
  Camera over = camera;
  over.projection = Projection::perspective;
  over.pitch = kStraightDown;
  over.heading = 0.0f;
  const double half = std::tan(0.5 * static_cast<double>(camera.fov));
  hang(over, map.corner + 0.5 * map.size, 0.5 * std::min(map.size.x, map.size.y * aspect) / half);
  return over;
}

void slideMap(Camera& camera, const glm::vec2& drag) {
  const double distance = distanceOf(camera);
  const double width = 2.0 * distance * std::tan(0.5 * static_cast<double>(camera.fov));
  const double slant = std::sin(-static_cast<double>(std::clamp(camera.pitch, kStraightDown, kFlattest)));
  const double s = std::sin(static_cast<double>(camera.heading)), c = std::cos(static_cast<double>(camera.heading));
  const double right = -static_cast<double>(drag.x) * width, ahead = static_cast<double>(drag.y) * width / slant;
  hang(camera, pointUnder(camera) + glm::dvec2(c * right + s * ahead, -s * right + c * ahead), distance);
}

void swingMap(Camera& camera, const glm::vec2& drag) {
  const glm::dvec2 point = pointUnder(camera);
  const double distance = distanceOf(camera);
  camera.heading += drag.x * static_cast<float>(kPi);
  camera.pitch -= drag.y * static_cast<float>(kPi);
  hang(camera, point, distance);
}

void zoomMap(Camera& camera, float clicks) {
  const glm::dvec2 point = pointUnder(camera);
  hang(camera, point, distanceOf(camera) * std::exp(-0.12 * static_cast<double>(clicks)));
}

}  // namespace welkin::viewer
