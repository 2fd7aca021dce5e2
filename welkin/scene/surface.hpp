#pragma once
// What the air has below it.
#include <glm/vec3.hpp>

#include "welkin/scene/scene.hpp"

namespace welkin {

// Albedo of ground and clouds together, seen from above: what lights the air from below. `clouds`: cloudReflectance().
glm::vec3 surfaceAlbedo(const glm::vec3& ground, float clouds);
glm::vec3 surfaceAlbedo(const Scene& scene);

}  // namespace welkin
