#include "welkin/density/hero_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace welkin {

namespace {

Interval product(const Interval& a, const Interval& b) {
  const float p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

// Of a function that grows.
template <class F>
Interval grown(const Interval& a, const F& f) {
  return {f(a.low), f(a.high)};
}

}  // namespace

HeroBounds::HeroBounds(const law::HeroParams& hero, const law::HeroParts& parts, const TextureView& shape,
                       const TexelBounds& billows)
    : c_(hero), parts_(parts),
      texels_(glm::vec3(shape.width, shape.height, shape.depth) / (glm::vec3(hero.high) - glm::vec3(hero.low))),
      billowTexels_(static_cast<float>(billows.width())), normalX_(shape, 0, TexelBounds::Kind::box),
      normalY_(shape, 1, TexelBounds::Kind::box), normalZ_(shape, 2, TexelBounds::Kind::box),
      depth_(shape, 3, TexelBounds::Kind::box), billows_(billows) {
  const glm::vec3 place(c_.place), reach(1e6f, 1e6f, 0.0f);
  if (c_.scatter.place.w > 0.0f)
    most_ =
        aloneIn({place - reach + glm::vec3(0.0f, 0.0f, c_.low.z), place + reach + glm::vec3(0.0f, 0.0f, c_.high.z)});
}

float HeroBounds::extinctionIn(const glm::vec3& low, const glm::vec3& high) const {
  return c_.scatter.place.w > 0.0f ? scatteredIn({low, high}) : aloneIn({low, high});
}

float HeroBounds::scatteredIn(const Box& box) const {
  constexpr float kMostCopies = 16.0f;  // that are looked at one by one
  const law::ScatterParams& s = c_.scatter;
  const glm::vec2 place(s.place), low = glm::vec2(box.low) - place, high = glm::vec2(box.high) - place;
  const float edge = s.place.w;
  // Rounding at the borders of squares.
  const float loose = 0.02f + 1e-6f * (glm::length(low) + glm::length(high) + glm::length(place));
  const glm::vec2 first = glm::floor((low - loose) / edge + 0.5f), last = glm::floor((high + loose) / edge + 0.5f);
  if ((last.x - first.x + 1.0f) * (last.y - first.y + 1.0f) > kMostCopies) {
    const float most = 1.0f + s.chance.z;
    const bool apart = box.low.z - s.place.z > most * std::max(c_.high.z, 0.0f) ||
                       box.high.z - s.place.z < most * std::min(c_.low.z, 0.0f);
    return apart ? 0.0f : most_;
  }
  float found = 0.0f;
  for (float j = first.y; j <= last.y; ++j)
    for (float i = first.x; i <= last.x; ++i) {
      const glm::vec4 copy = law::scatterCopy(i, j, s);
      if (copy.w == 0.0f) continue;
      const float size = std::abs(copy.w), turnX = std::cos(copy.z), turnY = std::sin(copy.z);
      const glm::vec2 middle = glm::vec2(i, j) * edge;
      const glm::vec2 from = glm::max(low, middle - 0.5f * edge) - loose,
                      to = glm::min(high, middle + 0.5f * edge) + loose;
      const glm::vec2 p = (0.5f * (from + to) - middle - glm::vec2(copy)) / size, half = 0.5f * (to - from) / size;
      glm::vec2 q(turnX * p.x + turnY * p.y, turnX * p.y - turnY * p.x);
      glm::vec2 reach(std::abs(turnX) * half.x + std::abs(turnY) * half.y,
                      std::abs(turnY) * half.x + std::abs(turnX) * half.y);
      if (copy.w < 0.0f) {
        const glm::vec2 axis(s.axis), twice = glm::abs(2.0f * axis * axis - 1.0f);
        const float across = std::abs(2.0f * axis.x * axis.y);
        q = 2.0f * glm::dot(q, axis) * axis - q;
        reach = {twice.x * reach.x + across * reach.y, across * reach.x + twice.y * reach.y};
      }
      const float z0 = s.place.z + (box.low.z - s.place.z) / size, z1 = s.place.z + (box.high.z - s.place.z) / size;
      found = std::max(found, aloneIn({glm::vec3(place + q - reach, z0), glm::vec3(place + q + reach, z1)}));
    }
  return found;
}

float HeroBounds::aloneIn(const Box& around) const {
  // The box in the cloud's own axes.
  const glm::vec3 &low = around.low, &high = around.high;
  const glm::vec3 place(c_.place), middle = 0.5f * (low + high) - place, half = 0.5f * (high - low);
  const float x = middle.x * c_.axisX + middle.y * c_.axisY, y = middle.y * c_.axisX - middle.x * c_.axisY;
  const float alongX = std::abs(c_.axisX), alongY = std::abs(c_.axisY);
  // Rounding of what is far from the anchor.
  const float loose = 1e-6f * (std::abs(place.x) + std::abs(place.y) + std::abs(place.z)) + 0.01f;
  const glm::vec3 reach(half.x * alongX + half.y * alongY + loose, half.x * alongY + half.y * alongX + loose,
                        half.z + loose);
  Box box{glm::vec3(x, y, middle.z) - reach, glm::vec3(x, y, middle.z) + reach};
  const glm::vec3 least(c_.low), most(c_.high);
  if (glm::any(glm::lessThanEqual(box.high, least)) || glm::any(glm::greaterThanEqual(box.low, most))) return 0.0f;
  box.low = glm::max(box.low, least);
  box.high = glm::min(box.high, most);
  float dense = 0.0f;
  if (c_.kind == law::kHeroSolid) dense = solidIn(box);
  if (c_.kind == law::kHeroPlates) dense = platesIn(box);
  if (c_.kind == law::kHeroPatches) dense = patchesIn(box);
  if (c_.kind == law::kHeroFilaments) dense = filamentsIn(box);
  if (c_.kind == law::kHeroPouches) dense = pouchesIn(box);
  if (c_.kind == law::kHeroClassic) dense = classicIn(box);
  return c_.high.w * dense * 1.0002f;  // rounding
}

Interval HeroBounds::baseIn(const Box& x) const {
  const glm::vec3 least(c_.low);
  return depth_.between((x.low - least) * texels_, (x.high - least) * texels_);
}

float HeroBounds::solidIn(const Box& x) const {
  const float ice = c_.anvilRadius > 0.0f ? anvilIn(x) : 0.0f;
  Interval base = baseIn(x);
  base.low -= c_.wisp;
  const Interval p = depthIn(x, base);
  if (p.high <= 0.0f) return ice;
  const float edge = std::min(glm::mix(c_.edge, c_.edgeTop, law::smoothstep(c_.calmFrom, c_.calmTo, x.low.z)),
                              glm::mix(c_.edge, c_.edgeTop, law::smoothstep(c_.calmFrom, c_.calmTo, x.high.z)));
  const float flat = law::smoothstep(0.0f, c_.baseFade, x.high.z + kPerlinMost * c_.baseNoise);
  const float rise = std::sqrt(law::saturate(x.high.z / c_.low.w));
  const float inside = std::max(c_.interior, glm::mix(c_.interior, 1.0f, rise));
  return std::max(law::smoothstep(0.0f, edge, p.high) * flat * inside, ice);
}

// heroAnvil with every argument at the end of its range that gives the most.
float HeroBounds::anvilIn(const Box& x) const {
  const auto awayFrom = [&](float middle) {
    const float dx = std::max({x.low.x - middle, middle - x.high.x, 0.0f});
    const float dy = std::max({x.low.y, -x.high.y, 0.0f});
    return std::sqrt(dx * dx + dy * dy);
  };
  const float widest = c_.anvilRadius * (1.0f + (0.3f + 0.08f) * kPerlinMost), th = c_.anvilThickness;
  const float away = awayFrom(c_.anvilX), t = away / widest, thin = 1.0f - t;
  if (t >= 1.0f) return 0.0f;
  const float core = awayFrom(0.0f) / (0.35f * c_.anvilRadius), dome = awayFrom(0.0f) / (0.11f * c_.anvilRadius);
  const float top =
      c_.anvilTop + th * (0.45f * std::sqrt(1.0f - t * t) + 0.5f * std::exp(-0.5f * dome * dome) + 0.14f * kPerlinMost);
  const float bottom =
      c_.anvilTop - th * (1.1f * thin + 0.12f + 1.2f * std::exp(-0.5f * core * core) + 0.3f * kPerlinMost * thin);
  const float depth = std::min({top - x.low.z, x.high.z - bottom, 0.3f * (widest - away)}) + 0.01f;
  return c_.anvilDensity * law::smoothstep(0.0f, c_.anvilRamp, depth) * glm::mix(1.0f, 0.25f, t);
}

float HeroBounds::platesIn(const Box& x) const {
  constexpr float kBent = 0.22f * kPerlinMost;
  float p = -1.0f;
  for (int i = 0; i < c_.parts; ++i) {
    const glm::vec4 at = parts_.part[2 * i], plate = parts_.part[2 * i + 1];
    const auto lee = [&](float v) { return (v > 0.0f ? v / plate.w : v) / at.w; };
    const float x0 = lee(x.low.x - at.x), x1 = lee(x.high.x - at.x);
    const float y0 = (x.low.y - at.y) / (at.w * c_.breadth), y1 = (x.high.y - at.y) / (at.w * c_.breadth);
    const auto least = [](float a, float b) { return std::max({a, -b, 0.0f}); };
    const auto most = [](float a, float b) { return std::max(std::abs(a), std::abs(b)); };
    const auto square = [](float v) { return v * v; };
    const float near = square(least(x0, x1)) + square(least(y0, y1)), far = square(most(x0, x1)) + square(most(y0, y1));
    const float room = law::saturate(1.0f - near * (1.0f - kBent) + 1e-5f);
    const float empty = law::saturate(1.0f - far * (1.0f + kBent) - 1e-5f);
    const float below = plate.x * std::pow(room, 0.85f) - (x.low.z - at.z - plate.z * room);
    const float above = x.high.z - at.z - plate.z * empty + plate.y * std::pow(room, 0.9f);
    p = std::max(p, std::min(below, above) + 0.01f);
  }
  return law::smoothstep(0.0f, c_.edge, p);
}

float HeroBounds::patchesIn(const Box& x) const {
  const float curled = law::kHeroEddy * law::kHeroEddyMost;
  const glm::vec3 low = glm::vec3(x.low.x - 0.5f * x.high.z, x.low.y, x.low.z) - curled;
  const glm::vec3 high = glm::vec3(x.high.x - 0.5f * x.low.z, x.high.y, x.high.z) + curled;
  float inside = -9.0f;
  for (int i = 0; i < c_.parts; ++i) {
    const glm::vec3 at(parts_.part[2 * i]), inverse(parts_.part[2 * i + 1]);
    const glm::vec3 d = glm::max(glm::max(low - at, at - high), glm::vec3(0.0f)) * inverse;
    inside = std::max(inside, 1.0f - std::pow(glm::dot(d, d), 0.6f));
  }
  const float p = 0.55f * inside - 0.1f + 2.2f * law::kHeroFbmMost + 1e-4f;
  return law::smoothstep(0.0f, 0.35f, p) * law::smoothstep(0.0f, 0.1f * c_.low.w, x.high.z);
}

float HeroBounds::filamentsIn(const Box& x) const {
  const float bend = law::kHeroBend * kPerlinMost;
  const auto square = [](float v) { return v * v; };
  float sum = 0.0f;
  for (int b = 0; b < c_.parts; ++b) {
    const int first = b * (2 + 2 * law::kHeroStrands);
    const glm::vec4 box = parts_.part[first], head = parts_.part[first + 1];
    const float x0 = x.low.x - bend, x1 = x.high.x + bend, y0 = x.low.y - bend, y1 = x.high.y + bend;
    if (x1 < box.x - box.y || x0 > box.x + box.y || y1 < box.z - box.w || y0 > box.z + box.w) continue;
    const auto gap = [](float low, float high, float at) { return std::max({low - at, at - high, 0.0f}); };
    const float r =
        (square(gap(x0, x1, head.x)) + square(gap(y0, y1, head.y)) + 2.5f * square(gap(x.low.z, x.high.z, head.z))) /
        square(head.w);
    if (r < 6.0f) sum += 0.9f * std::exp(-r);
    for (int k = 0; k < law::kHeroStrands; ++k) {
      const glm::vec4 at = parts_.part[first + 2 + 2 * k], strand = parts_.part[first + 3 + 2 * k];
      // Of the strand between the box's levels: its ends are the highest and the lowest.
      const float top = at.z - x.high.z, deep = at.z - x.low.z;
      if (top >= at.w) continue;
      const float lowest = std::min(std::max(deep, 0.0f), at.w), highest = std::max(top, 0.0f);
      const float width = strand.y * (1.0f + 2.0f * law::saturate(lowest / at.w));
      const float wide = width * (1.0f + 0.55f * 2.0f * strand.x * std::max(deep, 0.0f));
      const float from = at.x - strand.x * square(std::max(deep, 0.0f)), to = at.x - strand.x * square(highest);
      const float dx = std::max({x0 - to, from - x1, 0.0f}) / wide, dy = gap(y0, y1, at.y) / width;
      const float dz = std::max(-deep, 0.0f) / strand.y;
      const float e = square(dx) + square(dy) + square(dz);
      if (e < 7.0f) sum += strand.z * std::exp(-e) * std::pow(law::saturate(1.0f - top / at.w), 1.1f);
    }
  }
  return std::min(sum * 1.001f, 1.0f);
}

float HeroBounds::pouchesIn(const Box& x) const {
  const auto gap = [](float low, float high) { return std::max({low, -high, 0.0f}); };
  const float dx = gap(x.low.x, x.high.x), dy = gap(x.low.y, x.high.y) / c_.breadth;
  const float rim = c_.halfWidth - std::sqrt(dx * dx + dy * dy);
  const float face = -0.06f * kPerlinMost * c_.billowSize;
  const float p = std::min({x.high.z - face, c_.low.w - x.low.z, 0.4f * rim + 0.2f * kPerlinMost * c_.billow}) + 0.01f;
  return law::smoothstep(0.0f, c_.edge, p);
}

float HeroBounds::classicIn(const Box& x) const {
  return std::max(baseIn(x).high + 0.5f * c_.distortion + 1e-5f, 0.0f);
}

// heroBillows with intervals for numbers.
Interval HeroBounds::depthIn(const Box& x, const Interval& base) const {
  const auto low = [&](float z) { return glm::mix(c_.billowLow, 1.0f, law::smoothstep(0.0f, 0.25f * c_.place.w, z)); };
  const auto top = [&](float z) { return glm::mix(1.0f, c_.calmTop, law::smoothstep(c_.calmFrom, c_.calmTo, z)); };
  const float lowA = low(x.low.z), lowB = low(x.high.z), topA = top(x.low.z), topB = top(x.high.z);
  const Interval rough =
      product({std::min(lowA, lowB), std::max(lowA, lowB)}, {std::min(topA, topB), std::max(topA, topB)});
  const glm::vec3 from = (x.low - glm::vec3(c_.low)) * texels_, to = (x.high - glm::vec3(c_.low)) * texels_;
  Interval p = base;
  float amplitude = c_.billow, size = c_.billowSize, tile = c_.rise.w, rest = c_.reach;
  Interval normal[3];
  bool known = false;
  glm::vec3 origin(c_.rise);
  for (int i = 0; i < c_.octaves; ++i) {
    if (p.high + law::kHeroBillowTop * rest * rough.high <= 0.0f) return {p.low, 0.0f};
    if (!known) {
      normal[0] = normalX_.between(from, to), normal[1] = normalY_.between(from, to);
      normal[2] = normalZ_.between(from, to);
      known = true;
    }
    const Interval way = grown(p, [&](float v) { return std::clamp(v, -1.2f * size, 1.2f * size); });
    glm::vec3 least, most;
    for (int c = 0; c < 3; ++c) {
      const Interval step = product(normal[c], way);
      least[c] = (x.low[c] + step.low) * tile + origin[c];
      most[c] = (x.high[c] + step.high) * tile + origin[c];
    }
    Interval b = billows_.between(least * billowTexels_, most * billowTexels_);
    b = product({1.15f * b.low - law::kHeroBillowDeep, 1.15f * b.high - law::kHeroBillowDeep}, rough);
    p.low += amplitude * b.low - 1e-3f;
    p.high += amplitude * b.high + 1e-3f;
    rest -= amplitude;
    amplitude *= c_.billowRatio;
    size *= 0.5f;
    tile *= 2.0f;
    origin = glm::fract(origin * 2.0f + glm::vec3(0.37f, 0.59f, 0.83f));
  }
  return p;
}

}  // namespace welkin
