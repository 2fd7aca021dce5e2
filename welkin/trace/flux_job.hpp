#pragma once
// What the SIMD kernel of flux.hpp reads and writes. Positions are a brick and a place in it in voxels, [0, 8] on each
// axis: exact on faces, and as fine in a large grid as in a small one.
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "welkin/trace/flux.hpp"

namespace welkin::flux {

enum Face { kWest, kEast, kSouth, kNorth, kBottom, kTop, kFaces };  // x-, x+, y-, y+, z-, z+

struct Medium {
  std::array<int, 3> dims, bricks;
  std::array<float, 3> voxel;  // m
  const std::uint32_t* brickIndex;
  const float *values, *majorants;  // majorants: one a brick place
  float albedo;                     // everywhere, unless there is a grid of its own
  const std::uint32_t* albedoIndex;
  const float* albedoValues;
};

struct View {
  std::array<float, 3> direction;  // toward the viewer
  float scale;                     // from the sum over photons to FluxResult::radiance
};

struct Job {
  Medium medium;
  PhaseTableView phase;
  bool periodic, diffuse, countAbsorption;
  std::array<float, 3> beam;       // the way light goes, unless it is diffuse
  std::array<float, kFaces> lit;   // running sum of the share of light that enters through each face
  float surfaceAlbedo, dropAfter;  // dropAfter: infinity for never
  std::uint32_t seed;
  std::vector<View> views;
};

// Sums over photons. `columns`: reflected, transmitted and absorbed, one plane after the other.
struct Tally {
  double faces[kFaces] = {}, absorbed = 0.0, lost = 0.0, unscattered = 0.0, scatterings = 0.0, path = 0.0;
  std::vector<double> radiance, columns;
};

// Follows photons [first, last) and adds what becomes of them.
void followPhotons(const Job& job, std::uint64_t first, std::uint64_t last, Tally& tally);

}  // namespace welkin::flux
