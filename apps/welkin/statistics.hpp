#pragma once
// What a layer or sheet amounts to, measured on the field itself.
#include <cstddef>
#include <optional>

#include "welkin/scene/scene.hpp"

namespace welkin::app {

struct CloudStatistics {
  double cover;               // share of the sky with cloud overhead, in [0, 1]
  double base, top;           // m, of what is there: lowest base and highest top
  double meanOpticalDepth;    // vertical, over the whole area
  double medianOpticalDepth;  // vertical, over the cloudy columns
};

// Over columns spread across several of the layer's clusters at the scene's time; empty when this build cannot measure.
std::optional<CloudStatistics> layerStatistics(const Scene& scene, std::size_t layer);
std::optional<CloudStatistics> sheetStatistics(const Scene& scene, std::size_t sheet);

}  // namespace welkin::app
