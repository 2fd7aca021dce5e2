#pragma once
// From a scene's plain values to the parameters of the laws of rain and snow.
#include <array>

#include "welkin/scene/law.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// Whether anything falls from a layer, and from any layer of the scene.
bool rains(const Scene& scene, const Layer& layer);
bool rains(const Scene& scene);

// A layer's parameters of the law; rate 0 where nothing falls from it.
law::RainParams rainParams(const Scene& scene, const Layer& layer);

// Altitude above which nothing of it falls, m.
float rainTop(const Layer& layer);

// The greatest extinction that its rain or snow can have anywhere, 1/m.
float rainBound(const Scene& scene, const Layer& layer);

// Altitude of 0 degrees Celsius, m; below 0 where it freezes at the ground.
float freezingLevel(const Precipitation& precipitation);

// The least particle that is drawn by itself, in mm of water; smaller ones are haze.
inline constexpr float kLeastDrop = 1.0f, kLeastFlake = 0.6f;

// What is drawn as particles at an altitude: all of one class have the same size and speed.
inline constexpr int kFallClasses = 32;
struct FallClass {
  float diameter;  // mm, as it is seen
  float speed;     // m/s
  float snow;      // 1 for a flake
};
struct Falling {
  float count;  // of particles in a m^3
  float share;  // of the extinction, that they have
  float snow;   // share of the rate that is snow
  std::array<FallClass, kFallClasses> classes;
};
Falling fallingAt(const Precipitation& precipitation, float altitude);

}  // namespace welkin
