#include "welkin/scene/surface.hpp"

#include <algorithm>

#include "welkin/density/reflectance.hpp"

namespace welkin {

AirSurface airSurface(const Scene& scene) {
  AirSurface s(scene.ground.albedo);
  s.clouds = cloudReflectance(scene.layers, scene.seed);
  s.cloudBottom = 1e6f;
  for (const Layer& layer : scene.layers) {
    s.cloudBottom = std::min(s.cloudBottom, layer.cloud.base);
    s.cloudTop = std::max(s.cloudTop, layer.cloud.base + layer.cloud.thickness);
  }
  return s;
}

}  // namespace welkin
