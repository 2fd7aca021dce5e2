// Light inside clouds, by itself: the sun alone, no air, a black ground. How bright the real-time frame makes a plane
// slab, a ball, and cumulus, against the path tracer, from several sides and with the sun high and low.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "welkin/density/grid_cloud.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin {
namespace {

constexpr int kEdge = 24, kFiner = 4, kFrames = 16, kSamples = 64;

// What is looked at: layers of the scene, or voxels.
struct Body {
  std::string name;
  Scene scene;
  std::vector<PlacedGrid> grids;
};

Scene sunAlone() {
  Scene scene;
  scene.atmosphere.rayleigh = scene.atmosphere.mie = scene.atmosphere.ozone = scene.atmosphere.haze = 0.0f;
  scene.ground.albedo = glm::vec3(0.0f);
  return scene;
}

// Extinction (1/m) at places, in a box of `cells` voxels.
Body voxels(const std::string& name, const glm::ivec3& cells, const glm::dvec3& low, const glm::dvec3& size,
            const std::function<double(const glm::dvec3&)>& extinction) {
  Body body{name, sunAlone(), {}};
  body.scene.layers.clear();
  const glm::dvec3 cell = size / glm::dvec3(cells);
  VoxelGrid grid(cells, low, cell);
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        const double sigma = extinction(low + cell * (glm::dvec3(x, y, z) + 0.5));
        if (sigma > 0.0) grid.set({x, y, z}, static_cast<float>(sigma));
      }
  body.scene.grids.emplace_back().file = "body.vdb";  // its voxels are handed over
  body.grids.push_back(placed({.values = GridValues::extinction}, std::make_shared<const VoxelGrid>(std::move(grid))));
  return body;
}

Body slab(double opticalDepth) {
  constexpr double kWidth = 40000.0, kThickness = 1200.0;
  return voxels(fmt::format("slab of {:.0f}", opticalDepth), {64, 64, 24}, {-0.5 * kWidth, -0.5 * kWidth, 1000.0},
                {kWidth, kWidth, kThickness}, [=](const glm::dvec3&) { return opticalDepth / kThickness; });
}

Body ball() {
  constexpr double kRadius = 1000.0, kEdgeWidth = 40.0, kExtinction = 0.06;
  const glm::dvec3 middle(0.0, 0.0, 2100.0);
  return voxels("ball", glm::ivec3(64), middle - 1100.0, glm::dvec3(2200.0), [=](const glm::dvec3& p) {
    return kExtinction * glm::clamp((kRadius - glm::distance(p, middle)) / kEdgeWidth + 0.5, 0.0, 1.0);
  });
}

double meanGreen(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 1; i < image.pixels.size(); i += 3) sum += image.pixels[i];
  return sum / (static_cast<double>(image.pixels.size()) / 3.0);
}

struct Pair {
  double ours, traced;  // kcd/m^2
};

Pair compare(const Body& body, const Scene& scene) {
  realtime::Offscreen screen(kFiner * kEdge, kFiner * kEdge);
  realtime::CustomTextures textures;
  textures.grids = body.grids;
  screen.renderer().setScene(scene, textures);
  const realtime::Frame frame = realtime::frameOf(scene.camera, kFiner * kEdge, kFiner * kEdge);
  for (int i = 0; i < kFrames; ++i) screen.draw(frame);
  trace::PathTracer tracer(scene, {.grids = body.grids},
                           {.width = kEdge, .height = kEdge, .samples = kSamples, .sunDisc = trace::SunDisc::leftOut});
  tracer.run({});
  return {meanGreen(screen.read()), meanGreen(tracer.layers().radiance)};
}

}  // namespace
}  // namespace welkin

int main() {
  using namespace welkin;
  struct View {
    glm::dvec3 position;
    double pitch, fov;  // rad
  };
  const View above{{0.0, 0.0, 3200.0}, -0.9, 0.3}, below{{0.0, 0.0, 200.0}, 0.9, 0.3};
  const View beside{{0.0, -8000.0, 2100.0}, 0.0, 0.2}, under{{0.0, 0.0, 150.0}, 0.3, 0.5};
  struct Case {
    Body body;
    std::vector<View> views;
  };
  const Case cases[] = {{slab(15.0), {above, below}},
                        {slab(60.0), {above, below}},
                        {ball(), {beside}},
                        {{"cumulus", sunAlone(), {}}, {under}}};
  std::string rows;
  double deviation = 0.0, count = 0.0;
  for (const Case& c : cases)
    for (const double elevation : {50.0, 10.0})
      for (const View& view : c.views)
        for (const double turn : {45.0, 110.0, 180.0}) {
          Scene scene = c.body.scene;
          scene.sun.elevation = static_cast<float>(glm::radians(elevation));
          scene.sun.azimuth = static_cast<float>(glm::radians(turn));
          scene.camera.position = view.position;
          scene.camera.heading = 0.0f;
          scene.camera.pitch = static_cast<float>(view.pitch);
          scene.camera.fov = static_cast<float>(view.fov);
          const Pair found = compare(c.body, scene);
          const double ratio = found.ours / found.traced;
          deviation += std::abs(std::log(ratio));
          count += 1.0;
          fmt::print("{:<11} sun {:2.0f} up, {:3.0f} aside, seen {}: {:6.2f}, traced {:6.2f}: {:.2f}\n", c.body.name,
                     elevation, turn,
                     view.pitch < 0.0   ? "from above"
                     : view.pitch > 0.0 ? "from below"
                                        : "from beside",
                     found.ours, found.traced, ratio);
          std::fflush(stdout);
          rows += fmt::format("{}{:.3f}", rows.empty() ? "" : ", ", ratio);
        }
  fmt::print("{{\"mean_factor\": {:.3f}, \"ratios\": [{}]}}\n", std::exp(deviation / count), rows);
}
