// A picture of a sky in ten lines: reads a sky file, draws it without a window, writes a PNG.
#include <cstdio>

#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/realtime/offscreen.hpp"

int main(int argc, char** argv) try {
  const char* output = argc > 1 ? argv[1] : "sky.png";
  welkin::Scene scene = argc > 2 ? welkin::loadSky(argv[2]) : welkin::Scene{};
  scene.quality = welkin::qualityPreset(welkin::QualityPreset::ultra);

  welkin::realtime::Offscreen screen(480, 270);
  screen.renderer().setScene(scene);
  for (int frame = 0; frame < 4; ++frame) screen.draw(scene, 0.0);  // each frame makes the picture cleaner
  const welkin::Image light = screen.read();                        // linear Rec.709 in kcd/m^2

  const auto bytes = welkin::displayBytes(light, {.ev = scene.film.ev, .whiteBalance = scene.film.whiteBalance});
  welkin::savePng(output, light.width, light.height, light.channels, bytes);
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
