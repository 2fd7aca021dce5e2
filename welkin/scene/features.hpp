#pragma once
#include <string>

#include "welkin/scene/scene.hpp"

namespace welkin {

// What a sky has to show, as sorted words with commas between them ("clouds,lightning,sheets"). A renderer writes into
// Image::features those that it draws, so that `welkin compare` can refuse two pictures of different things.
std::string featuresOf(const Scene& scene);
// Those that the path tracer draws: it has no lightning.
std::string tracedFeaturesOf(Scene scene);

}  // namespace welkin
