#pragma once
// Classical clouds as voxels: every renderer, query and exporter sees the same ones.
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "welkin/density/classical/settings.hpp"
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/params.hpp"

namespace welkin {

class Automaton;

// What a cloud's voxels hang on, and how far the wind has carried them since.
struct ClassicalMoment {
  std::int64_t step = 0;             // of an automaton, counted from time 0
  std::int64_t east = 0, north = 0;  // by how many sixteenths of its length a height map's window has moved on
  glm::dvec2 carried{0.0};           // east, north in m
  bool sameVoxels(const ClassicalMoment& o) const { return step == o.step && east == o.east && north == o.north; }
};
ClassicalMoment momentOf(const Classical& cloud, const Drift& drift);

// The cloud's box at a time, without the margin of its voxels.
WorldBox boxOf(const Classical& cloud, const Drift& drift);

// The clouds of a sky at a time, kept from one time to the next. A cloud that has not changed is not baked again, and
// automata go on from where they are.
class ClassicalClouds {
 public:
  ClassicalClouds();
  ~ClassicalClouds();
  ClassicalClouds(ClassicalClouds&&) noexcept;
  ClassicalClouds& operator=(ClassicalClouds&&) noexcept;

  // Goes to a time; `seed` is the scene's. Returns whether any voxels are others than before.
  bool update(std::span<const Classical> clouds, const Drift& drift, int seed);

  // The cloud's voxels where they stand before the wind carries them, and how far it has.
  const PlacedGrid& still(std::size_t cloud) const;
  const glm::dvec2& carried(std::size_t cloud) const;
  // The clouds where they are.
  std::vector<PlacedGrid> placed() const;
  std::size_t count() const;

 private:
  struct Entry;
  std::vector<Entry> entries_;
};

}  // namespace welkin
