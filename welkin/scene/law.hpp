#pragma once
// The laws that hold a scene together: scalar C++ reading.
#include "welkin/density/law.hpp"
#include "welkin/precipitation/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/scene/camera.glsl"
#include "welkin/scene/rain.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
