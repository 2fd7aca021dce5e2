#pragma once
// The law of the camera: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/scene/camera.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
