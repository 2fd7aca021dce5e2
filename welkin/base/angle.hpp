// The circle's number and the degree, for angles in radians.
#pragma once

#include <numbers>

namespace welkin {

inline constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;  // rad
inline constexpr float kPiFloat = std::numbers::pi_v<float>;

}  // namespace welkin
