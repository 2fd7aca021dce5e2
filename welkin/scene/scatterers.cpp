#include "welkin/scene/scatterers.hpp"

namespace welkin {

namespace {

// A fit whose share of Draine's function is none is Henyey and Greenstein's.
template <class Cloud>
law::MiePhase phaseOfDroplets(const Cloud& cloud) {
  if (cloud.phase == ScatteringPhase::henyey_greenstein) return {cloud.asymmetry, 0.0f, 0.0f, 0.0f};
  return computeMiePhase(cloud.dropletDiameter);
}

template <class Cloud>
Scatterers scatterersOf(const Cloud& cloud) {
  return {cloud.albedo, cloud.dropletDiameter, phaseOfDroplets(cloud)};
}

}  // namespace

law::MiePhase phaseOf(const CloudLayer& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const HeroCloud& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const GridCloud& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const ClassicalCloud& cloud) { return phaseOfDroplets(cloud); }

std::optional<Scatterers> leadingScatterers(const Scene& scene) {
  if (!scene.layers.empty()) return scatterersOf(scene.layers.front().cloud);
  if (!scene.classical.empty()) return scatterersOf(scene.classical.front().cloud);
  if (!scene.heroes.empty()) return scatterersOf(scene.heroes.front().cloud);
  for (const GridCloud& grid : scene.grids)
    if (!grid.file.empty()) return scatterersOf(grid);
  return std::nullopt;
}

}  // namespace welkin
