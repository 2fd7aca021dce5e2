#pragma once
// The scalar reading of every room, and the order in which GLSL reads the law files.
#include "welkin/light/law.hpp"

#define WELKIN_LAW_FILES "welkin/base/law.glsl", "welkin/light/phase.glsl"
