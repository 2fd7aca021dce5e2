#include "welkin/scene/features.hpp"

namespace welkin {

std::string featuresOf(const Scene& scene) {
  std::string words;
  const auto add = [&](bool shown, const char* word) {
    if (shown && !words.empty()) words += ',';
    if (shown) words += word;
  };
  add(!scene.layers.empty() || !scene.grids.empty() || !scene.heroes.empty(), "clouds");
  add(scene.lightning.rate > 0.0f && !scene.layers.empty(), "lightning");
  add(!scene.sheets.empty(), "sheets");
  return words;
}

std::string tracedFeaturesOf(Scene scene) {
  scene.lightning.rate = 0.0f;
  return featuresOf(scene);
}

}  // namespace welkin
