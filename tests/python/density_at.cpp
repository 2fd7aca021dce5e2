// Prints the extinction of a sky at points: density_at SKY, points "east north altitude" on standard input. The C++
// answer that the Python module is held against.
#include <cstdio>
#include <exception>
#include <iostream>
#include <vector>

#include "welkin/density/field.hpp"
#include "welkin/io/sky_file.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const welkin::Scene scene = welkin::loadSky(argv[1]);
  const welkin::DensityField field({.layers = scene.layers,
                                    .sheets = scene.sheets,
                                    .noise = scene.noise,
                                    .drift = {scene.wind.speed, scene.wind.from, scene.time},
                                    .seed = scene.seed,
                                    .heroes = scene.heroes});
  std::vector<glm::dvec3> points;
  for (glm::dvec3 p; std::cin >> p.x >> p.y >> p.z;) points.push_back(p);
  for (const glm::dvec3& p : points) std::printf("%.9g\n", static_cast<double>(field.extinction(p)));
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "density_at: %s\n", e.what());
  return 1;
}
