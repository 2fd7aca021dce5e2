#include "apps/viewer/picture/density_slice.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>

#include "welkin/density/field.hpp"

namespace welkin::viewer {

namespace {

struct Request {
  Scene scene;
  std::vector<Volume> maps;
  std::vector<PlacedGrid> grids;
  SlicePlane plane;
};

SlicePicture cut(const Request& r) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
  SlicePicture picture;
  try {
    const DensityField field({.layers = r.scene.layers,
                              .sheets = r.scene.sheets,
                              .noise = r.scene.noise,
                              .drift = {r.scene.wind.speed, r.scene.wind.from, r.scene.time},
                              .seed = r.scene.seed,
                              .grids = r.grids,
                              .classical = r.scene.classical,
                              .heroes = r.scene.heroes,
                              .weatherMaps = r.maps});
    picture.width = DensitySlice::kWidth;
    picture.height = r.plane.upright ? DensitySlice::kUprightHeight : DensitySlice::kWidth;
    const Camera& camera = r.scene.camera;
    const double s = std::sin(static_cast<double>(camera.heading)), c = std::cos(static_cast<double>(camera.heading));
    std::vector<glm::dvec3> points;
    points.reserve(static_cast<std::size_t>(picture.width) * picture.height);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const double across = r.plane.edge * ((x + 0.5) / picture.width - 0.5);
        const double up = 1.0 - (y + 0.5) / picture.height;
        points.push_back(r.plane.upright ? glm::dvec3(camera.position.x + s * across, camera.position.y + c * across,
                                                      r.plane.top * up)
                                         : glm::dvec3(camera.position.x + across,
                                                      camera.position.y + r.plane.edge * (up - 0.5), r.plane.altitude));
      }
    const std::vector<float> extinction = field.extinction(points);
    picture.most = *std::max_element(extinction.begin(), extinction.end());
    for (const Layer& layer : r.scene.layers) picture.most = std::max(picture.most, layer.cloud.extinction);
    picture.rgba.reserve(4 * extinction.size());
    for (const float e : extinction) {
      // Thin cloud shows too.
      const float share = picture.most > 0.0f ? std::sqrt(e / picture.most) : 0.0f;
      const auto byte = [&](float low, float high) {
        return static_cast<std::uint8_t>(std::lround(low + share * (high - low)));
      };
      picture.rgba.insert(picture.rgba.end(), {byte(23, 255), byte(32, 255), byte(48, 255), 255});
    }
  } catch (const std::exception& e) {
    picture = SlicePicture{};
    picture.trouble = e.what();
  }
  return picture;
}

}  // namespace

struct DensitySlice::Work {
  std::future<SlicePicture> running;
  std::optional<Request> waiting;
  SlicePicture picture;

  void begin() {
    running = std::async(std::launch::async, [request = std::move(*waiting)] { return cut(request); });
    waiting.reset();
  }
};

DensitySlice::DensitySlice() : work_(std::make_unique<Work>()) {}
DensitySlice::~DensitySlice() = default;

void DensitySlice::ask(const Scene& scene, const realtime::CustomTextures& textures, const SlicePlane& plane) {
  work_->waiting = Request{scene, textures.weatherMaps, textures.grids, plane};
  if (!work_->running.valid()) work_->begin();
}

bool DensitySlice::collect() {
  Work& w = *work_;
  if (!w.running.valid() || w.running.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  w.picture = w.running.get();
  if (w.waiting) w.begin();
  return true;
}

const SlicePicture& DensitySlice::picture() const { return work_->picture; }
bool DensitySlice::complete() const { return !work_->running.valid(); }

}  // namespace welkin::viewer
