#pragma once
// The renderer's frame in C++: march, rounding to the history's half floats, composite. Slow; no OpenGL.
#include <span>

#include "tests/realtime/stage.hpp"

namespace welkin::realtime::test {

// RGBA as Stage::draw answers it: full resolution, one ray a pixel, no jitter, no host depth.
// `grids` are read as voxels, not as the textures of an atlas.
Image marchOnCpu(const Scene& scene, const Frame& frame, std::span<const PlacedGrid> grids = {});

}  // namespace welkin::realtime::test
