#pragma once
// Rain and snow near the eye: which cells of the falling air are drawn, and where they stand. Nothing is stored from
// frame to frame: a particle's place follows from the number of its cell, its own number in it, and the time.
//
// Particles stand as densely as in nature as far as levels[0].reach; each further level has an eighth of them, each
// standing for eight times as many, out to twice the distance, so that they are about as dense in the picture.
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/scene/rain.hpp"

namespace welkin::realtime {

inline constexpr int kDropLevels = 4, kDropsPerCell = 64;

struct DropLevels {
  Falling falling{};
  float edge[kDropLevels] = {}, reach[kDropLevels] = {};  // of the cells and of the levels, m; 0: nothing is drawn
};

// For a view of this frame from an eye at `altitude` (m). `view` is not locked to a history's grid.
DropLevels dropLevels(const Precipitation& precipitation, const FrameParams& view, float altitude);

// Cells that may be seen, at most `most`, the nearest first: xyz their number from the eye's, w their level. `up`: unit
// vector away from the planet's centre.
std::vector<glm::vec4> dropCells(const DropLevels& levels, const FrameParams& view, const glm::vec3& up, float altitude,
                                 std::size_t most);

// Of every level its classes. `eye`: m in the world; `wind` and `velocity` (of the eye): m/s.
std::array<law::DropClass, kDropLevels * kFallClasses> dropClasses(const DropLevels& levels, const glm::dvec3& eye,
                                                                   const glm::dvec3& up, const glm::dvec2& wind,
                                                                   const glm::dvec3& velocity, double time);

}  // namespace welkin::realtime
