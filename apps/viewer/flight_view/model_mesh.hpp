#pragma once
// Shapes made of a few numbers: lofts through sections, wings, boxes, rods.
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace welkin::viewer {

// What a shape is painted as, and what moves it; the shader in scenery.cpp knows the same numbers.
enum class Part { fuselage, wing, tail, fin, dark, wheel, spinner, wall, roof };

struct ModelVertex {
  glm::vec3 position, normal;
  float part;
};

struct ModelMesh {
  std::vector<ModelVertex> vertices;
  std::vector<std::uint32_t> indices;
};

// A closed cross-section of a body along x: middle, half width and height, m. `square`: 2 is an ellipse, more is
// squarer.
struct BodySection {
  float x, z, halfWidth, halfHeight, square;
};
void addBody(ModelMesh& mesh, Part part, const std::vector<BodySection>& sections);

// A station of a wing: leading edge, chord, thickness as a share of it.
struct WingSection {
  glm::vec3 leadingEdge;
  float chord, thickness;
};
// `upright`: a fin, whose thickness lies along y instead of z.
void addWing(ModelMesh& mesh, Part part, const std::vector<WingSection>& sections, bool upright);

void addRod(ModelMesh& mesh, Part part, const glm::vec3& from, const glm::vec3& to, float radius);
// A house: middle of its floor, size in x, y and z to the eaves, height of the ridge along x over them.
void addHouse(ModelMesh& mesh, const glm::vec3& floor, const glm::vec3& size, float ridge);

// The aircraft, in its body's axes (forward, right, down), m.
ModelMesh aircraftMesh();
// The airfield's houses: along the runway, to its right, up; m from its middle.
ModelMesh airfieldMesh();

}  // namespace welkin::viewer
