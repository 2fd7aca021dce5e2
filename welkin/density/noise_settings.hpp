#pragma once
// The noise that the shapes are made of, as a part of a Scene.
#include "welkin/noise/settings.hpp"

namespace welkin {

struct NoiseSettings {
  ProfileNoiseSettings profile;
  BaseShapeSettings baseShape;
  DetailSettings detail;
  CurlSettings curl;
};

}  // namespace welkin
