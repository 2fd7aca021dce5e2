// The map view: seen from above over a picture of land.
#include "apps/viewer/flight/land_map.hpp"
#include "apps/viewer/frame_loop.hpp"
#include "apps/viewer/model/map_camera.hpp"
#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

constexpr double kLandEdge = 60000.0;  // m, of the map of our own land
constexpr int kLandPixels = 1024;

}  // namespace

void Viewer::useMap(MapPicture map) {
  ground_ = std::make_unique<MapGround>(gl_, std::move(map));
  ground_->setSurroundings(bench_.document.scene().ground.albedo);
}

void Viewer::showMap(bool shown) {
  if (flight_ || shown == bench_.mapShown) return;
  bench_.navigation.stop();
  Camera camera = bench_.document.scene().camera;
  if (shown) {
    if (!ground_) useMap(landMap(Terrain(), kLandEdge, kLandPixels));
    beforeMap_ = camera;
    const Region part = region();
    camera = cameraOver(camera, ground_->map(), static_cast<double>(part.width) / part.height);
    if (bench_.referenceWanted) bench_.say("The path tracer knows nothing of maps: it is off.");
    bench_.referenceWanted = false;
  } else {
    camera = *beforeMap_;
  }
  bench_.mapShown = shown;
  picture_.setForeground(shown ? ground_.get() : nullptr);
  picture_.cut();
  bench_.document.moveCamera(camera);
}

void Viewer::openMap(const std::string& path) {
  if (flight_) return;
  try {
    MapPicture map = options_.loadMap(path);
    showMap(false);
    useMap(std::move(map));
    showMap(true);
    bench_.say("Opened " + path);
  } catch (const Error& e) {
    bench_.complain(e.what());
  }
}

void Viewer::dragMap(const glm::vec2& drag) {
  Camera camera = bench_.document.scene().camera;
  if (*dragging_ == MouseButton::left)
    slideMap(camera, drag);
  else
    swingMap(camera, drag);
  bench_.document.moveCamera(camera);
}

// Held keys: shares of the picture's width a second.
void Viewer::steerMap(Camera& camera, const Thrust& thrust, double seconds) const {
  const auto step = static_cast<float>(seconds);
  if (thrust.right != 0.0f || thrust.forward != 0.0f)
    slideMap(camera, 0.4f * step * glm::vec2(-thrust.right, thrust.forward));
  if (thrust.yaw != 0.0f || thrust.pitch != 0.0f) swingMap(camera, 0.3f * step * glm::vec2(thrust.yaw, -thrust.pitch));
  if (thrust.up != 0.0f) zoomMap(camera, -8.0f * step * thrust.up);
}

}  // namespace welkin::viewer
