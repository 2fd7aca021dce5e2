#pragma once
// How the user's hands move the camera. Pure: input and seconds in, camera out.
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// look: dragging turns the head, keys fly. orbit: dragging turns the camera round the pivot.
enum class NavigationMode { look, orbit };

// Keys held down: each in [-1, 1].
struct Thrust {
  float forward = 0.0f, right = 0.0f, up = 0.0f, yaw = 0.0f, pitch = 0.0f;
  bool any() const { return forward != 0 || right != 0 || up != 0 || yaw != 0 || pitch != 0; }
};

class Navigation {
 public:
  NavigationMode mode = NavigationMode::look;
  float speed = 0.0f;  // m/s; 0: by the height above the ground
  // Metres ahead of the camera that it turns round.
  double pivotDistance = 4000.0;

  // Drags by a share of the picture's width.
  void turn(Camera& camera, const glm::vec2& drag) const;   // as the mode says
  void orbit(Camera& camera, const glm::vec2& drag) const;  // whatever the mode
  void look(Camera& camera, const glm::vec2& drag) const;
  void pan(Camera& camera, const glm::vec2& drag) const;
  // Toward the pivot (orbit) or ahead (look), by clicks of a wheel.
  void dolly(Camera& camera, float clicks);
  // The angle of view, by clicks.
  void zoom(Camera& camera, float clicks) const;
  void fly(Camera& camera, const Thrust& thrust, double seconds) const;
  double speedOf(const Camera& camera) const;  // m/s

  // A flight to another camera, which takes a second.
  void travel(const Camera& from, const Camera& to);
  bool travelling() const { return journey_.has_value(); }
  // Moves a travelling camera.
  void advance(Camera& camera, double seconds);
  void stop() { journey_.reset(); }

 private:
  struct Journey {
    Camera from, to;
    double progress = 0.0;
  };
  std::optional<Journey> journey_;
};

// Views of the sky's lowest clouds from three heights; heading and angle of view stay.
enum class Vantage { below, inside, above };
Camera cameraAt(const Scene& scene, Vantage vantage);

// Places that the user keeps, 1 to 9.
using Bookmarks = std::array<std::optional<Camera>, 9>;

}  // namespace welkin::viewer
