#include "apps/viewer/model/navigation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/angle.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin::viewer {

namespace {

constexpr float kSteepest = 89.0f * kPiFloat / 180.0f;
constexpr double kLowest = 2.0;    // m above the ground: eyes of a person
constexpr double kHighest = 60e3;  // m
constexpr float kTurnRate = 0.9f;  // rad/s
constexpr double kJourney = 1.0;   // s

float wrapped(float angle) {
  angle = std::fmod(angle, 2.0f * kPiFloat);
  return angle < 0.0f ? angle + 2.0f * kPiFloat : angle;
}

void keepInBounds(Camera& camera) {
  camera.position.z = std::clamp(camera.position.z, kLowest, kHighest);
  camera.position.x = std::clamp(camera.position.x, -1e7, 1e7);
  camera.position.y = std::clamp(camera.position.y, -1e7, 1e7);
  camera.pitch = std::clamp(camera.pitch, -kSteepest, kSteepest);
  camera.heading = wrapped(camera.heading);
}

glm::dvec3 forwardOf(const Camera& camera) { return cameraAxes(camera)[2]; }

float mixAngles(float a, float b, float t) {
  const float turn = std::remainder(b - a, 2.0f * kPiFloat);
  return a + turn * t;
}

}  // namespace

void Navigation::turn(Camera& camera, const glm::vec2& drag) const {
  if (mode == NavigationMode::orbit)
    orbit(camera, drag);
  else
    look(camera, drag);
}

// What is under the pointer stays there.
void Navigation::look(Camera& camera, const glm::vec2& drag) const {
  camera.heading -= drag.x * camera.fov;
  camera.pitch += drag.y * camera.fov;
  keepInBounds(camera);
}

void Navigation::orbit(Camera& camera, const glm::vec2& drag) const {
  const glm::dvec3 pivot = camera.position + forwardOf(camera) * pivotDistance;
  camera.heading += drag.x * kPiFloat;
  camera.pitch = std::clamp(camera.pitch - drag.y * kPiFloat, -kSteepest, kSteepest);
  camera.position = pivot - forwardOf(camera) * pivotDistance;
  keepInBounds(camera);
}

void Navigation::pan(Camera& camera, const glm::vec2& drag) const {
  const glm::dmat3 axes = cameraAxes(camera);
  const double width = 2.0 * pivotDistance * std::tan(0.5 * camera.fov);
  camera.position += width * (-static_cast<double>(drag.x) * axes[0] + static_cast<double>(drag.y) * axes[1]);
  keepInBounds(camera);
}

void Navigation::dolly(Camera& camera, float clicks) {
  const double wanted = std::clamp(pivotDistance * std::exp(-0.12 * clicks), 20.0, 200e3);
  const double step = mode == NavigationMode::orbit ? pivotDistance - wanted : 0.25 * clicks * speedOf(camera);
  camera.position += forwardOf(camera) * step;
  if (mode == NavigationMode::orbit) pivotDistance = wanted;
  keepInBounds(camera);
}

void Navigation::zoom(Camera& camera, float clicks) const {
  camera.fov = std::clamp(camera.fov * std::exp(-0.08f * clicks), 3.0f * kPiFloat / 180.0f, 120.0f * kPiFloat / 180.0f);
}

// Quick enough to cross a cloud in a few seconds from wherever one is.
double Navigation::speedOf(const Camera& camera) const {
  return speed > 0.0f ? speed : 80.0 + 0.25 * std::max(camera.position.z, 0.0);
}

void Navigation::fly(Camera& camera, const Thrust& thrust, double seconds) const {
  const glm::dmat3 axes = cameraAxes(camera);
  const double way = speedOf(camera) * seconds;
  camera.position +=
      way * (static_cast<double>(thrust.forward) * axes[2] + static_cast<double>(thrust.right) * axes[0] +
             static_cast<double>(thrust.up) * glm::dvec3(0.0, 0.0, 1.0));
  const float angle = kTurnRate * camera.fov * static_cast<float>(seconds);
  camera.heading += thrust.yaw * angle;
  camera.pitch += thrust.pitch * angle;
  keepInBounds(camera);
}

void Navigation::travel(const Camera& from, const Camera& to) { journey_ = Journey{from, to, 0.0}; }

void Navigation::advance(Camera& camera, double seconds) {
  if (!journey_) return;
  Journey& j = *journey_;
  j.progress = std::min(j.progress + seconds / kJourney, 1.0);
  const double t = j.progress * j.progress * (3.0 - 2.0 * j.progress);
  const float s = static_cast<float>(t);
  camera = j.to;
  if (j.progress < 1.0) {
    camera.position = glm::mix(j.from.position, j.to.position, t);
    camera.heading = wrapped(mixAngles(j.from.heading, j.to.heading, s));
    camera.pitch = glm::mix(j.from.pitch, j.to.pitch, s);
    camera.roll = mixAngles(j.from.roll, j.to.roll, s);
    camera.fov = glm::mix(j.from.fov, j.to.fov, s);
  } else {
    journey_.reset();
  }
}

Camera cameraAt(const Scene& scene, Vantage vantage) {
  double base = 1500.0, top = 2500.0;
  if (!scene.layers.empty()) {
    const auto lowest = std::min_element(scene.layers.begin(), scene.layers.end(),
                                         [](const Layer& a, const Layer& b) { return a.cloud.base < b.cloud.base; });
    base = lowest->cloud.base;
    top = base + lowest->cloud.thickness;
  }
  Camera camera = scene.camera;
  camera.roll = 0.0f;
  switch (vantage) {
    case Vantage::below:
      camera.position.z = std::min(150.0, 0.5 * base);
      camera.pitch = 0.14f;
      break;
    case Vantage::inside:
      camera.position.z = base + 0.35 * (top - base);
      camera.pitch = 0.0f;
      break;
    case Vantage::above:
      camera.position.z = top + std::max(500.0, 0.3 * (top - base));
      camera.pitch = -0.25f;
      break;
  }
  keepInBounds(camera);
  return camera;
}

}  // namespace welkin::viewer
