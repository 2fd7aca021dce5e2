#include "welkin/density/hero_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace welkin {

namespace {

constexpr int kMostPlates = 12;
constexpr int kMostBundles = law::kHeroParts / (2 + 2 * law::kHeroStrands);

void include(HeroGeometry& g, const glm::vec3& low, const glm::vec3& high) {
  g.low = glm::min(g.low, low);
  g.high = glm::max(g.high, high);
}

HeroGeometry geometry(int count) {
  HeroGeometry g;
  g.count = count;
  g.low = glm::vec3(1e30f);
  g.high = glm::vec3(-1e30f);
  return g;
}

}  // namespace

HeroGeometry heroPlates(const HeroForm& form, std::uint32_t seed) {
  HeroGeometry g = geometry(std::min(form.parts, kMostPlates));
  HeroDice dice(seed);
  const float half = 0.5f * form.width;
  // So that the topmost reaches the height; each lies 1.25 of its thickness above the one below.
  float stack = 0.0f;
  const auto share = [&](int i) {
    return g.count > 1 ? static_cast<float>(i) / static_cast<float>(g.count - 1) : 0.0f;
  };
  for (int i = 0; i < g.count; ++i) stack += (i + 1 < g.count ? 1.25f : 1.3f) * (1.0f - 0.25f * share(i));
  const float unit = 0.9f * form.height / (stack + 0.3f);
  float z = 0.3f * unit;
  for (int i = 0; i < g.count; ++i) {
    const float u = share(i), thick = unit * (1.0f - 0.25f * u) * dice(0.85f, 1.1f);
    const float radius = half * glm::mix(1.0f, 0.45f, std::pow(u, 0.9f)) * dice(0.9f, 1.05f) / 1.1f;
    const glm::vec4 at(half * (0.04f + 0.1f * u * dice(-1.0f, 1.0f)), half * form.breadth * 0.06f * dice(-1.0f, 1.0f),
                       z, radius);
    const glm::vec4 plate(thick, 0.3f * thick, 0.1f * form.height, 1.22f);
    g.parts.part[2 * i] = at;
    g.parts.part[2 * i + 1] = plate;
    const float reach = 1.15f * radius;  // the outline is bent outward by up to an eighth
    include(g, {at.x - reach, at.y - reach * form.breadth, z - plate.y},
            {at.x + plate.w * reach, at.y + reach * form.breadth, z + plate.x + plate.z});
    z += 1.25f * thick;
  }
  return g;
}

HeroGeometry heroPatches(const HeroForm& form, std::uint32_t seed) {
  HeroGeometry g = geometry(form.parts);
  HeroDice dice(seed);
  const float half = 0.5f * form.width;
  for (int i = 0; i < g.count; ++i) {
    const float radius = half * dice(0.29f, 1.0f) * 0.6f;
    const glm::vec3 axes(radius, radius * dice(0.55f, 0.9f), form.height * dice(0.22f, 0.4f));
    const glm::vec3 at((half - 0.5f * radius) * dice(-1.0f, 1.0f),
                       (half * form.breadth - 0.3f * radius) * dice(-1.0f, 1.0f), form.height * dice(0.3f, 0.7f));
    g.parts.part[2 * i] = glm::vec4(at, 0.0f);
    g.parts.part[2 * i + 1] = glm::vec4(1.0f / axes, 0.0f);
    // Torn noise reaches to 2.7 radii; z leans x by a half.
    const glm::vec3 reach = 2.7f * axes + law::kHeroEddy * law::kHeroEddyMost;
    const float lean = 0.5f * (std::abs(at.z) + reach.z);
    include(g, at - reach - glm::vec3(lean, 0.0f, 0.0f), at + reach + glm::vec3(lean, 0.0f, 0.0f));
  }
  g.low.z = std::max(g.low.z, 0.0f);
  return g;
}

HeroGeometry heroFilaments(const HeroForm& form, std::uint32_t seed) {
  HeroGeometry g = geometry(std::min(form.parts, kMostBundles));
  HeroDice dice(seed);
  const float half = 0.5f * form.width, deep = form.height;
  const float bend = 1.05f * law::kHeroBend;
  int at = 0;
  for (int b = 0; b < g.count; ++b) {
    const float along =
        half * glm::mix(-0.3f, 1.0f, (static_cast<float>(b) + dice(0.0f, 1.0f)) / static_cast<float>(g.count));
    const glm::vec3 head(along, half * form.breadth * dice(-0.85f, 0.85f), deep * dice(0.82f, 0.94f));
    const float size = dice(0.6f, 1.2f), curve = dice(0.5f, 0.8f) * form.width / (deep * deep);
    const float tuft = 0.016f * form.width * size;
    glm::vec3 low = head - 2.7f * tuft, high = head + 2.7f * tuft;
    const int first = at;
    at += 2;
    for (int k = 0; k < law::kHeroStrands; ++k) {
      const glm::vec3 from = head + glm::vec3(dice(-1.6f, 1.6f), dice(-2.2f, 2.2f), dice(-0.4f, 0.3f)) * tuft;
      const float fall = std::min(deep * dice(0.35f, 1.0f) * size, from.z);
      const float bent = curve * dice(0.86f, 1.14f), width = form.width * dice(0.002f, 0.0045f);
      const float strength = dice(0.2f, 0.7f);
      g.parts.part[at] = glm::vec4(from, fall);
      g.parts.part[at + 1] = glm::vec4(bent, width, strength, 0.0f);
      at += 2;
      const float slope = 2.0f * bent * fall, wide = 2.7f * 3.0f * width;
      low = glm::min(low, {from.x - bent * fall * fall - wide * (1.0f + 0.55f * slope), from.y - wide, from.z - fall});
      high = glm::max(high, {from.x + wide * (1.0f + 0.55f * slope), from.y + wide, from.z + 2.7f * width});
    }
    g.parts.part[first] = 0.5f * glm::vec4(low.x + high.x, high.x - low.x, low.y + high.y, high.y - low.y);
    g.parts.part[first + 1] = glm::vec4(head, tuft);
    include(g, low - glm::vec3(bend, bend, 0.0f), high + glm::vec3(bend, bend, 0.0f));
  }
  return g;
}

}  // namespace welkin
