#pragma once
// The laws of noise: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/noise/hash.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
