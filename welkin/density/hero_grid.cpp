#include "welkin/density/hero_grid.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <memory>

#include "welkin/density/field.hpp"
#include "welkin/density/voxel_bake.hpp"

namespace welkin {

PlacedGrid heroGrid(const Hero& hero, double time, int seed, double voxels) {
  const Hero one = alone(hero);
  const DensityField field({.drift = {0.0f, 0.0f, time}, .seed = seed, .heroes = std::span(&one, 1)});
  const HeroBody& body = field.heroes().front();
  const glm::dvec3 low = body.lowest(), size = body.highest() - low;
  const double edge = std::cbrt(size.x * size.y * size.z / voxels);
  // A margin of zeros, toward which the outermost values fade.
  const VoxelBox box{glm::ivec3(glm::ceil(size / edge)) + 2, low - edge, glm::dvec3(edge)};
  return {std::make_shared<const VoxelGrid>(bakeVoxels(field, box, {})), glm::dmat4(1.0), 1.0f, scatterOf(hero, body)};
}

}  // namespace welkin
