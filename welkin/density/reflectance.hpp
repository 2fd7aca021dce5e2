#pragma once
// How much light layers of cloud send back up.
#include <span>

#include "welkin/density/layer.hpp"

namespace welkin {

// Share of the light of an evenly bright sky that these layers together reflect, in the mean over 96 km of land that is
// black. From the heights of their weather, eroded in the mean, by two-stream theory; a layer whose weather comes from
// a picture counts as if the picture were blank. `seed` is the scene's. Against `welkin flux` on 19 presets: root mean
// square .036, at most .07.
float cloudReflectance(std::span<const Layer> layers, int seed);

}  // namespace welkin
