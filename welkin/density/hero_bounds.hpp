#pragma once
// Upper bounds of a hero cloud's law over boxes, for footprint 0.
#include <glm/vec3.hpp>

#include "welkin/density/bounds.hpp"
#include "welkin/density/law.hpp"

namespace welkin {

inline constexpr float kPerlinMost = 1.04f;  // gradient noise in space goes no further from zero

class HeroBounds {
 public:
  // Keeps references to the parts and to the bounds of the tile of billows.
  HeroBounds(const law::HeroParams& hero, const law::HeroParts& parts, const TextureView& shape,
             const TexelBounds& billows);

  // Of the extinction in a box of cloud space, relative to the anchor of the parameters.
  float extinctionIn(const glm::vec3& low, const glm::vec3& high) const;

 private:
  struct Box {
    glm::vec3 low, high;
  };
  // Of the copies in a box, and of the cloud itself.
  float scatteredIn(const Box& box) const;
  float aloneIn(const Box& box) const;
  // Of the density's share in a box of the cloud's own axes.
  float solidIn(const Box& x) const;
  float anvilIn(const Box& x) const;
  float platesIn(const Box& x) const;
  float patchesIn(const Box& x) const;
  float filamentsIn(const Box& x) const;
  float pouchesIn(const Box& x) const;
  float classicIn(const Box& x) const;
  Interval baseIn(const Box& x) const;
  Interval depthIn(const Box& x, const Interval& base) const;

  law::HeroParams c_;
  float most_ = 0.0f;  // anywhere, 1/m
  const law::HeroParts& parts_;
  glm::vec3 texels_;  // of the shape, per m
  float billowTexels_;
  TexelBounds normalX_, normalY_, normalZ_, depth_;
  const TexelBounds& billows_;
};

}  // namespace welkin
