#include "welkin/scene/features.hpp"

#include "welkin/scene/rain.hpp"

namespace welkin {

std::string featuresOf(const Scene& scene) {
  std::string words;
  const auto add = [&](bool shown, const char* word) {
    if (shown && !words.empty()) words += ',';
    if (shown) words += word;
  };
  add(!scene.layers.empty() || !scene.grids.empty() || !scene.classical.empty() || !scene.heroes.empty(), "clouds");
  add(rains(scene) && scene.precipitation.particles > 0, "drops");
  add(scene.lightning.rate > 0.0f && !scene.layers.empty(), "lightning");
  add(rains(scene), "rain");
  add(!scene.sheets.empty(), "sheets");
  return words;
}

std::string tracedFeaturesOf(Scene scene) {
  scene.lightning.rate = 0.0f;
  scene.precipitation.particles = 0;
  return featuresOf(scene);
}

}  // namespace welkin
