#pragma once
// Bindings of the uniform blocks that several passes read.
#include "welkin/gl/api.hpp"

namespace welkin::realtime {

constexpr GLuint kFrameBlock = 0, kLayersBlock = 1, kMarchBlock = 2;
constexpr GLuint kNightBlock = 3, kLightningBlock = 4;  // of the march
constexpr GLuint kDropsBlock = 3;                       // of drops and flakes

}  // namespace welkin::realtime
