#pragma once
// What the air has below it.
#include "welkin/atmosphere/params.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// Ground and layers of cloud.
AirSurface airSurface(const Scene& scene);

}  // namespace welkin
