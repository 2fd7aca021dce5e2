#pragma once
// Greatest and least texels of a texture inside boxes: what linear filtering can answer there at most and at least.
#include <glm/vec3.hpp>
#include <vector>

#include "welkin/base/sampler.hpp"

namespace welkin {

struct Interval {
  float low, high;
};

// A pyramid of minima and maxima of one channel. A volume repeats; a box is clamped at its sides; of a stack of planes
// each slice is clamped at its edges.
class TexelBounds {
 public:
  enum class Kind { volume, box, planes };
  TexelBounds(const TextureView& texture, int channel, Kind kind);

  // Of a linearly filtered lookup anywhere between `low` and `high`, in texels from the texture's corner (texel i
  // covers [i, i + 1)). For planes z of both is the slice.
  Interval between(const glm::vec3& low, const glm::vec3& high) const;

  int width() const { return mips_.front().width; }  // texels

 private:
  struct Mip {
    int width, height, depth;
    std::vector<Interval> cells;
  };
  Kind kind_;
  std::vector<Mip> mips_;
};

}  // namespace welkin
