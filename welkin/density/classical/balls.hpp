#pragma once
// Balls whose fields meet: metaballs and particles.
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "welkin/density/classical/settings.hpp"

namespace welkin {

// Centres and radii, sorted into the cells of a grid so that those near a point are found at once.
class Balls {
 public:
  explicit Balls(std::vector<glm::vec4> balls);

  const std::vector<glm::vec4>& all() const { return balls_; }

  // Calls visit(d) for the balls that hold p: d from 0 in the middle to 1 at the surface, squared.
  template <class Visit>
  void near(const glm::vec3& p, const Visit& visit) const {
    const glm::vec3 q = (p - origin_) * inverseCell_;
    if (!(q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < float(dims_.x) && q.y < float(dims_.y) && q.z < float(dims_.z)))
      return;
    const std::size_t cell = cellAt(glm::ivec3(q));
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const glm::vec4& b = balls_[inCell_[i]];
      const glm::vec3 d = p - glm::vec3(b);
      const float square = (d.x * d.x + d.y * d.y + d.z * d.z) / (b.w * b.w);
      if (square < 1.0f) visit(square);
    }
  }

 private:
  std::size_t cellAt(const glm::ivec3& c) const { return (std::size_t(c.z) * dims_.y + c.y) * dims_.x + c.x; }

  std::vector<glm::vec4> balls_;
  glm::vec3 origin_{0.0f}, inverseCell_{0.0f};
  glm::ivec3 dims_{1};
  std::vector<std::uint32_t> first_, inCell_;
};

// In a box of `size` m whose base's middle is the origin: a heap that is highest in the middle and stands on a flat
// base.
Balls makeMetaballs(const MetaballSettings& settings, const glm::vec3& size, std::uint32_t seed);
// On the surfaces of a heap of ellipsoids, and below them.
Balls makeParticles(const ParticleSettings& settings, const glm::vec3& size, std::uint32_t seed);

// Field of a metaball at the squared share of its radius: 1 in the middle, 0 at the rim (Wyvill, McPheeters and Wyvill
// 1986).
inline float metaballField(float d) { return 1.0f + d * (-22.0f / 9.0f + d * (17.0f / 9.0f - d * 4.0f / 9.0f)); }

// Densities from 0 to 1: how far the sum of the fields rises above the threshold, and what balls let through that cover
// one another.
float metaballDensity(const Balls& balls, const MetaballSettings& settings, const glm::vec3& p);
float particleDensity(const Balls& balls, const ParticleSettings& settings, const glm::vec3& p);

// A heap of ellipsoids: their centres and half axes, in such a box. The largest stands in the middle.
struct Ellipsoid {
  glm::vec3 centre, axes;
};
std::vector<Ellipsoid> makeEllipsoids(int count, const glm::vec3& size, std::uint32_t seed);

}  // namespace welkin
