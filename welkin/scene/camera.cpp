#include "welkin/base/angle.hpp"
#include "welkin/scene/camera.hpp"

#include <cmath>
#include <limits>

namespace welkin {

namespace {}  // namespace

glm::dmat3 cameraAxes(const Camera& camera) {
  const double ch = std::cos(camera.heading), sh = std::sin(camera.heading);
  const double cp = std::cos(camera.pitch), sp = std::sin(camera.pitch);
  const double cr = std::cos(camera.roll), sr = std::sin(camera.roll);
  const glm::dvec3 forward(sh * cp, ch * cp, sp);
  const glm::dvec3 level(ch, -sh, 0.0);
  const glm::dvec3 above(-sh * sp, -ch * sp, cp);
  return {level * cr - above * sr, above * cr + level * sr, forward};
}

glm::vec4 panoramaAngles(double x, double y, double width, double height) {
  return glm::vec4(glm::dvec4(kPi * (2.0 * x - 1.0), 0.5 * kPi * (2.0 * y - 1.0), kPi * width, 0.5 * kPi * height));
}

law::CameraParams cameraParams(const Camera& camera, double aspect) {
  const glm::dmat3 axes = cameraAxes(camera);
  law::CameraParams p{};
  if (camera.projection == Projection::equirectangular) {
    p.forward = glm::vec4(glm::vec3(axes[2]), 1.0f);
    p.right = glm::vec4(glm::vec3(axes[0]), 0.0f);
    p.above = glm::vec4(glm::vec3(axes[1]), 0.0f);
    p.angles = panoramaAngles(0.5, 0.5, 1.0, 1.0);
    return p;
  }
  const double half = std::tan(0.5 * static_cast<double>(camera.fov));
  p.forward = glm::vec4(glm::vec3(axes[2]), 0.0f);
  p.right = glm::vec4(glm::vec3(axes[0] * half), 0.0f);
  p.above = glm::vec4(glm::vec3(axes[1] * (half / aspect)), 0.0f);
  return p;
}

glm::dvec2 pictureFromDirection(const law::CameraParams& camera, const glm::dvec3& direction) {
  const glm::dmat3 axes(glm::dvec3(camera.right), glm::dvec3(camera.above), glm::dvec3(camera.forward));
  const glm::dvec3 eye = glm::inverse(axes) * direction;
  if (camera.forward.w < 0.5f) {
    if (eye.z <= 0.0) return glm::dvec2(std::numeric_limits<double>::infinity());
    return glm::dvec2(eye.x, eye.y) / eye.z;
  }
  const double turn = std::remainder(std::atan2(eye.x, eye.z) - camera.angles.x, 2.0 * kPi);
  const double rise = std::atan2(eye.y, std::hypot(eye.x, eye.z)) - camera.angles.y;
  return {turn / camera.angles.z, rise / camera.angles.w};
}

}  // namespace welkin
