#include "welkin/density/grid_cloud.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <utility>

namespace welkin {

double extinctionOfWater(double dropletDiameter) {
  constexpr double kEfficiency = 2.0, kDensity = 1e6;  // g/m^3
  return 0.75 * kEfficiency / (kDensity * 0.5e-6 * dropletDiameter);
}

PlacedGrid placed(const GridCloud& cloud, std::shared_ptr<const VoxelGrid> voxels, const glm::dmat4& placement,
                  double stated) {
  const glm::dvec3 east(1.0, 0.0, 0.0), north(0.0, 1.0, 0.0), up(0.0, 0.0, 1.0);
  glm::dmat4 world = glm::translate(glm::dmat4(1.0), cloud.position);
  world = glm::rotate(world, double(cloud.rotation.z), up);
  world = glm::rotate(world, double(cloud.rotation.y), north);
  world = glm::rotate(world, double(cloud.rotation.x), east);
  world = glm::scale(world, glm::dvec3(cloud.scale));
  // (x, y, z) of a file with y up is (x, -z, y) here.
  if (cloud.up == GridUp::y) world = glm::rotate(world, 0.5 * glm::pi<double>(), east);
  double one = cloud.extinction;
  if (cloud.values == GridValues::file && stated > 0.0) one = stated;
  if (cloud.values == GridValues::extinction) one = 1.0;
  if (cloud.values == GridValues::water) one = extinctionOfWater(cloud.dropletDiameter);
  return {std::move(voxels), glm::inverse(world * placement), static_cast<float>(one * cloud.density), {}};
}

WorldBox boundsOf(const PlacedGrid& grid) {
  const VoxelGrid& v = *grid.voxels;
  const glm::dmat4 world = glm::inverse(grid.fromWorld);
  WorldBox box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 p(world * glm::dvec4(v.origin() + share * glm::dvec3(v.dims()) * v.voxel(), 1.0));
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return {grid.scatter.lowest(box.low), grid.scatter.highest(box.high)};
}

}  // namespace welkin
