#pragma once
// The scalar reading of every room, and the order in which GLSL reads the law files. One line per room.
#include "welkin/atmosphere/law.hpp"
#include "welkin/density/law.hpp"
#include "welkin/light/law.hpp"
#include "welkin/noise/law.hpp"

#define WELKIN_BASE_LAW "welkin/base/law.glsl"
#define WELKIN_LIGHT_LAW "welkin/light/phase.glsl"
#define WELKIN_NOISE_LAW "welkin/noise/hash.glsl"
#define WELKIN_LAW_FILES WELKIN_BASE_LAW, WELKIN_LIGHT_LAW, WELKIN_NOISE_LAW
