#pragma once
#include <string>

#include "welkin/scene/scene.hpp"

namespace welkin {

// What a sky has to show, as sorted words with commas between them ("clouds,lightning,sheets"). A renderer writes into
// Image::features those that it draws, so that `welkin compare` can refuse two pictures of different things.
std::string featuresOf(const Scene& scene);
// Those that the path tracer draws: it has no lightning, and of rain and snow the haze, which stands for drops near the
// eye too.
std::string tracedFeaturesOf(Scene scene);

}  // namespace welkin
