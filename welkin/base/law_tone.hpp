#pragma once
// The law of tone: scalar C++ reading.
#include "welkin/base/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/base/tone.glsl"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
