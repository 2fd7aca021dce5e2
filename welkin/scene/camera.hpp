#pragma once
// From the scene's camera to rays: camera.glsl is the map, this fills in its parameters.
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "welkin/scene/law.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// The camera's right, above and forward, as columns: unit vectors in east, north, up.
glm::dmat3 cameraAxes(const Camera& camera);

// What law::cameraRay needs for a picture of this width over height. An equirectangular picture shows the whole sphere,
// whatever its shape; one of 2:1 has square pixels at the horizon.
law::CameraParams cameraParams(const Camera& camera, double aspect);

// The part of an equirectangular picture whose centre lies at (x, y) and which spans `width` and `height`, all in
// shares of the whole; y is 0 at the nadir.
glm::vec4 panoramaAngles(double x, double y, double width, double height);

// Where a direction stands in the picture, x and y as cameraRay takes them: its inverse. Outside [-1, 1] for what the
// picture does not show; perspective ones show nothing behind the camera, and there the answer is (inf, inf).
glm::dvec2 pictureFromDirection(const law::CameraParams& camera, const glm::dvec3& direction);

}  // namespace welkin
