#pragma once
// What C++ needs to read the OSL headers: OSL's own functions on floats. Compiled with -fwrapv, since OSL's integers
// wrap, and -fsingle-precision-constant, since its literals are floats.
#include <algorithm>
#include <cmath>

namespace welkin::osl {

using std::fabs, std::floor, std::sin, std::sqrt;
inline float min(float a, float b) { return std::min(a, b); }
inline float max(float a, float b) { return std::max(a, b); }
inline float clamp(float x, float low, float high) { return std::clamp(x, low, high); }
inline float mix(float a, float b, float share) { return a * (1.0f - share) + b * share; }
inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
inline float smoothstep(float low, float high, float x) {
  const float t = clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

#include "integrations/osl/welkin_cloud.h"

}  // namespace welkin::osl
