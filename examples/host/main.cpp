// A foreign program that draws Welkin's sky into its own frame: host [FILE [WIDTH HEIGHT [FRAMES]]].
// Two views, from a tower and from a cockpit, each WIDTH wide, side by side. What concerns Welkin stands in
// welkin_part.cpp; gl.* and engine.* would be there without it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "welkin/io/png.hpp"
#include "welkin_part.hpp"

int main(int argc, char** argv) try {
  const char* file = argc > 1 ? argv[1] : "host.png";
  const int width = argc > 3 ? std::atoi(argv[2]) : 640, height = argc > 3 ? std::atoi(argv[3]) : 400;
  const int frames = argc > 4 ? std::atoi(argv[4]) : 16;

  const host::Gl gl = host::openContext();
  host::Engine engine(gl, welkin::realtime::Renderer::hostShader());
  welkin::Scene sky;
  sky.seed = 7;
  sky.sun.elevation = 0.75f;
  sky.sun.azimuth = 2.2f;
  Clouds clouds(sky);

  const host::Eye eyes[] = {{{0.0, host::landHeight(0.0, 0.0) + 150.0, 0.0}, 0.3, 0.06, 1.15},  // the tower's
                            {{-650.0, 2450.0, 650.0}, -0.08, -0.3, 1.15}};                      // the cockpit's
  const host::Target targets[] = {{gl, 2 * width, 2 * height}, {gl, 2 * width, 2 * height}};
  for (int frame = 0; frame < frames; ++frame)
    for (std::size_t view = 0; view < 2; ++view) {
      clouds.light(view, engine, eyes[view], targets[view], 0.0);
      engine.drawLand(eyes[view], targets[view]);
      clouds.draw(view, engine, eyes[view], targets[view], 0.0);
      engine.drawGlass(eyes[view], targets[view]);
    }

  std::vector<unsigned char> both(static_cast<std::size_t>(width) * height * 6);
  double mean = 0.0, square = 0.0;
  for (std::size_t view = 0; view < 2; ++view) {
    const std::vector<unsigned char> bytes = engine.shown(targets[view]);
    const std::size_t row = static_cast<std::size_t>(width) * 3;
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                  both.begin() + static_cast<std::ptrdiff_t>((2 * y + view) * row));
    for (const unsigned char b : bytes) mean += b, square += double(b) * b;
  }
  welkin::savePng(file, 2 * width, height, 3, both);
  mean /= static_cast<double>(both.size());
  const double deviation = std::sqrt(square / static_cast<double>(both.size()) - mean * mean);
  std::printf("%s: mean %.1f, deviation %.1f of 255\n", file, mean, deviation);
  if (const GLenum error = gl.GetError()) return std::fprintf(stderr, "OpenGL error 0x%04x\n", error), 1;
  return deviation > 5.0 ? 0 : (std::fprintf(stderr, "the picture is all of one colour\n"), 1);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
