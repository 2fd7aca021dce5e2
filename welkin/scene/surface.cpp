#include "welkin/scene/surface.hpp"

#include "welkin/density/reflectance.hpp"

namespace welkin {

glm::vec3 surfaceAlbedo(const glm::vec3& ground, float clouds) {
  return clouds + (1.0f - clouds) * (1.0f - clouds) * ground / (1.0f - clouds * ground);
}

glm::vec3 surfaceAlbedo(const Scene& scene) {
  return surfaceAlbedo(scene.ground.albedo, cloudReflectance(scene.layers, scene.seed));
}

}  // namespace welkin
