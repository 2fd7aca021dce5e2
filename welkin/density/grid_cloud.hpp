#pragma once
// Clouds that come as a volume: what a sky file says of them, and where their voxels stand.
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "welkin/base/fields.hpp"
#include "welkin/density/scatter.hpp"
#include "welkin/density/scatterers.hpp"
#include "welkin/density/voxel_grid.hpp"

namespace welkin {

// What a value of the file means. file: what its metadata say, and normalized where they say nothing. normalized: 1 is
// `extinction`. extinction: in 1/m. water: liquid water in g/m^3.
enum class GridValues { file, normalized, extinction, water };
template <>
struct ChoiceNames<GridValues> {
  static constexpr std::array<std::string_view, 4> names{"file", "normalized", "extinction", "water"};
};

enum class GridUp { z, y };
template <>
struct ChoiceNames<GridUp> {
  static constexpr std::array<std::string_view, 2> names{"z", "y"};
};

struct GridCloud {
  std::string file{};
  std::string grid{};
  glm::dvec3 position{0.0};  // m
  glm::vec3 rotation{0.0f};  // rad
  float scale = 1.0f;
  GridUp up = GridUp::z;
  GridValues values = GridValues::file;
  float extinction = 0.1f;  // 1/m
  float density = 1.0f;
  float albedo = 1.0f;
  ScatteringPhase phase = ScatteringPhase::droplets;
  float dropletDiameter = 12.0f;  // um
  float asymmetry = 0.85f;
};
template <>
struct FieldTable<GridCloud> {
  static auto make() {
    return fieldRows(
        fileField<&GridCloud::file>("file", "OpenVDB file (.vdb); without one there is no cloud"),
        field<&GridCloud::grid>("grid", "name of the float grid in it; if empty \"density\", or else the first"),
        field<&GridCloud::position, kMetres>("position", {-1e7, 1e7}, {-10000, 10000},
                                             "where the file's origin stands: east, north, up"),
        field<&GridCloud::rotation, kDegrees>("rotation", {-360, 360}, {},
                                              "turns about east, then north, then up, counter-clockwise"),
        field<&GridCloud::scale>("scale", {1e-6, 1e6}, {0.1, 10}, "metres in a unit of the file; 0.01 for centimetres"),
        field<&GridCloud::up>("up", "axis of the file that points up"),
        field<&GridCloud::values>("values",
                                  "what they are: what the file says (else normalized), normalized (1 is "
                                  "`extinction`), extinction in 1/m, or liquid water in g/m^3"),
        field<&GridCloud::extinction, kPerMetre>("extinction", {0, 100}, {0.005, 0.5}, "of the value 1"),
        field<&GridCloud::density>("density", {0, 1000}, {0, 4}, "factor on all values"),
        albedoRow<&GridCloud::albedo>(), phaseRow<&GridCloud::phase>(),
        field<&GridCloud::dropletDiameter, kMicrometres>(
            "droplet_diameter", {1, 200}, {5, 40},
            "effective diameter of the droplets, for values of water and phase droplets"),
        asymmetryRow<&GridCloud::asymmetry>());
  }
};

// Voxels in the world. Points are those of cloud space: east, north, altitude in m.
struct PlacedGrid {
  std::shared_ptr<const VoxelGrid> voxels;  // with a margin of zeros, toward which the outermost values fade
  glm::dmat4 fromWorld{1.0};                // to the voxels' own axes
  float extinction = 1.0f;                  // 1/m, of the value 1
  Scatter scatter{};

  float at(const glm::dvec3& point) const {
    return extinction * voxels->interpolate(glm::dvec3(fromWorld * glm::dvec4(scatter.toCloud(point), 1.0)));
  }
};

// Extinction in 1/m of liquid water of 1 g/m^3 in droplets of this effective diameter in um: 3 Q / (4 density radius)
// with Q = 2, that of large droplets (Bohren and Huffman 1983, ch. 4.4.3).
double extinctionOfWater(double dropletDiameter);

// Puts voxels where the sky file wants them. `placement`: from the voxels' axes to the file's; `stated`: extinction in
// 1/m of the value 1 by the file, 0 when it does not say.
PlacedGrid placed(const GridCloud& cloud, std::shared_ptr<const VoxelGrid> voxels,
                  const glm::dmat4& placement = glm::dmat4(1.0), double stated = 0.0);

// The smallest box round a placed grid that lies along the axes of the world.
struct WorldBox {
  glm::dvec3 low, high;
};
WorldBox boundsOf(const PlacedGrid& grid);

}  // namespace welkin
