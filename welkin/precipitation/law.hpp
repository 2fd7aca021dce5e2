#pragma once
// The laws of rain and snow: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/precipitation/precipitation.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
