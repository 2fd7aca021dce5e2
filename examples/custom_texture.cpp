// Noise of one's own: any function that answers a welkin::Volume can take the place of a texture of the renderer.
// Here: clouds carved by bubbles in a cubic lattice, instead of the billows of the shape "profile".
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/png.hpp"
#include "welkin/realtime/offscreen.hpp"

namespace {

// One channel in [0, 1] that repeats in every direction: 1 inside the bubbles, 0 between them. `cells` bubbles along
// each edge, and smaller ones between them.
welkin::Volume bubbles(int size, int cells) {
  welkin::Volume volume(size, size, size, 1);
  const auto distanceToMiddle = [&](float x, float shift) {
    const float unit = (x + 0.5f) / static_cast<float>(size) * static_cast<float>(cells) + shift;
    return unit - std::floor(unit) - 0.5f;
  };
  const auto bubble = [&](int x, int y, int z, float shift, float radius) {
    const float a = distanceToMiddle(static_cast<float>(x), shift);
    const float b = distanceToMiddle(static_cast<float>(y), shift);
    const float c = distanceToMiddle(static_cast<float>(z), shift);
    return 1.0f - (a * a + b * b + c * c) / (radius * radius);
  };
  std::size_t texel = 0;
  for (int z = 0; z < size; ++z)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        volume.texels[texel++] =
            std::clamp(std::max(bubble(x, y, z, 0.0f, 0.55f), bubble(x, y, z, 0.5f, 0.35f)), 0.0f, 1.0f);
  return volume;
}

}  // namespace

int main(int argc, char** argv) try {
  welkin::Scene scene;
  scene.quality = welkin::qualityPreset(welkin::QualityPreset::ultra);
  welkin::realtime::CustomTextures textures;
  textures.profileBase = bubbles(64, 4);

  welkin::realtime::Offscreen screen(480, 270);
  screen.renderer().setScene(scene, textures);
  for (int frame = 0; frame < 4; ++frame) screen.draw(scene, 0.0);
  const welkin::Image light = screen.read();
  const auto bytes = welkin::displayBytes(light, {.ev = scene.film.ev, .whiteBalance = scene.film.whiteBalance});
  welkin::savePng(argc > 1 ? argv[1] : "bubbles.png", light.width, light.height, light.channels, bytes);
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
