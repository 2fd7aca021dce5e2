#pragma once
// The march's parameters in C++, laid out as the shaders' uniform blocks.
#include "welkin/atmosphere/law.hpp"
#include "welkin/density/law.hpp"
#include "welkin/scene/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/realtime/grid.glsl"
#include "welkin/realtime/light_volume.glsl"
#include "welkin/realtime/air_shade.glsl"
#include "welkin/realtime/march_params.glsl"
#include "welkin/realtime/host_params.glsl"
#include "welkin/realtime/lightning.glsl"
#include "welkin/realtime/drops.glsl"
#include "welkin/realtime/rain_picture.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
