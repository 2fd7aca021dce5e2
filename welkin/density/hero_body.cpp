#include "welkin/density/hero_body.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "welkin/base/parallel.hpp"
#include "welkin/density/hero_bounds.hpp"
#include "welkin/density/hero_parts.hpp"
#include "welkin/density/hero_shape.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin {

namespace {

constexpr int kBillowTexels = 128;
constexpr std::uint32_t kBillowSeed = 71;
constexpr double kChurn = 60.0;  // s, in which the simplex noise of "classic" becomes another, by choice

std::uint32_t seedOf(int scene, int cloud) {
  return (static_cast<std::uint32_t>(scene) * 7919u + static_cast<std::uint32_t>(cloud)) & 0xFFFFFFu;
}

float wrapped(double x) { return static_cast<float>(x - std::floor(x)); }

// Values of `at` in the middle of the cells of a grid over the box of the parameters.
template <class At>
std::shared_ptr<const Volume> gridOf(const law::HeroParams& p, int cells, const At& at) {
  const glm::vec3 low(p.low), size = glm::vec3(p.high) - low;
  const float cell = std::cbrt(size.x * size.y * size.z / static_cast<float>(cells));
  const glm::ivec3 n = glm::clamp(glm::ivec3(glm::ceil(size / cell)), glm::ivec3(8), glm::ivec3(512));
  auto grid = std::make_shared<Volume>(n.x, n.y, n.z, 4);
  parallelFor(static_cast<std::size_t>(n.y) * n.z, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int i = 0; i < n.x; ++i) {
        const glm::vec3 place(i, static_cast<int>(row % n.y), static_cast<int>(row / n.y));
        const glm::vec4 d = at(low + (place + 0.5f) / glm::vec3(n) * size);
        for (int c = 0; c < 4; ++c) grid->texels[(row * n.x + static_cast<std::size_t>(i)) * 4 + c] = d[c];
      }
  });
  roundToHalf(*grid);
  return grid;
}

void setBox(law::HeroParams& p, const glm::vec3& low, const glm::vec3& high) {
  p.low = glm::vec4(low, p.low.w);
  p.high = glm::vec4(high, p.high.w);
}

void makeSolid(HeroBody& body, const Hero& hero, const HeroForm& form, const HeroLife& life, int cells) {
  law::HeroParams& p = body.params;
  const HeroSolid solid = heroSolid(form, hero.surface.taper, life, static_cast<std::uint32_t>(p.seed));
  float all = 0.0f, amplitude = p.billow;
  for (int i = 0; i < p.octaves; ++i, amplitude *= p.billowRatio) all += amplitude;
  p.reach = all;
  glm::vec3 low, high;
  boundsOf(solid, low, high);
  const float out = law::kHeroBillowTop * all + 1.0f;
  low -= out;
  high += out;
  low.z = -kPerlinMost * p.baseNoise - 1.0f;
  if (form.anvil > 0.0f && life.spread > 0.0f) {
    const float thin = std::sqrt(life.spread), reach = 1.45f * form.anvil * life.spread;
    p.anvilRadius = form.anvil * life.spread;
    p.anvilThickness = form.anvilThickness * form.height * thin;
    p.anvilTop = 0.95f * form.height;
    p.anvilDensity = form.anvilDensity;
    p.anvilX = form.lean * p.anvilTop + 0.32f * p.anvilRadius;
    p.anvilRamp = 0.3f * p.anvilThickness;
    low = glm::min(low, glm::vec3(p.anvilX - reach, -reach, low.z));
    high = glm::max(high, glm::vec3(p.anvilX + reach, reach, p.anvilTop + 1.15f * p.anvilThickness));
  }
  setBox(p, low, high);
  body.shape = gridOf(p, cells, [&](const glm::vec3& x) { return depthIn(solid, x); });
}

void makeClassic(HeroBody& body, const Hero& hero, const HeroForm& form, const Drift& drift, int cells) {
  law::HeroParams& p = body.params;
  const HeroClassic& c = hero.classic;
  const float size = p.place.w;
  p.high.w *= c.density;
  p.distortion = c.distortion;
  p.worley = c.worleyInfluence;
  p.clump = c.worleyClump;
  p.wave = c.wave;
  p.simplex = c.noiseInfluence;
  p.whisp = c.noiseWhisp;
  p.cellScale = c.noiseScale;
  p.octaves = c.noiseDetail;
  const double cell = 0.1 * size / c.overallScale, time = drift.time + c.time;
  const glm::vec3 to = c.windDirection;
  const glm::dvec3 wind = glm::length(to) > 1e-6f ? glm::dvec3(glm::normalize(to)) : glm::dvec3(0.0);
  // Where the texture stands in the cloud's own axes.
  const glm::dvec3 world = body.origin * (1.0 - static_cast<double>(c.stationary));
  const glm::dvec3 place(world.x * p.axisX + world.y * p.axisY, world.y * p.axisX - world.x * p.axisY, world.z);
  const glm::dvec3 offset = (place - wind * (c.windStrength * time)) / cell;
  const auto period = [](double x) {
    return static_cast<float>(x - std::floor(x / law::kHeroPeriod) * law::kHeroPeriod);
  };
  p.rise = {period(offset.x), period(offset.y), period(offset.z), static_cast<float>(1.0 / cell)};
  const glm::dvec3 fine = offset * static_cast<double>(c.noiseScale);
  p.wind = {period(fine.x), period(fine.y), period(fine.z), static_cast<float>(time / kChurn)};
  const glm::vec3 half(p.halfWidth, p.halfWidth * form.breadth, 0.0f);
  setBox(p, -half, half + glm::vec3(0.0f, 0.0f, form.height));
  body.shape = gridOf(
      p, cells, [&](const glm::vec3& x) { return glm::vec4(0.0f, 0.0f, 0.0f, shapeGradient(form, c.cloudScale, x)); });
}

void makeGeometry(HeroBody& body, const HeroGeometry& geometry) {
  body.params.parts = geometry.count;
  setBox(body.params, geometry.low, geometry.high);
  body.parts = std::make_shared<law::HeroParts>(geometry.parts);
}

}  // namespace

TextureView HeroBody::shapeView() const {
  TextureView view = shape->view();
  view.wrap = view.wrapY = Wrap::clamp;
  return view;
}

law::HeroParams HeroBody::paramsAt(const glm::dvec2& anchor) const {
  law::HeroParams p = params;
  p.place = glm::vec4(glm::dvec3(origin.x - anchor.x, origin.y - anchor.y, origin.z), params.place.w);
  p.scatter = scatter.paramsAt(anchor);
  return p;
}

namespace {
glm::dvec3 extreme(const HeroBody& body, bool highest) {
  const law::HeroParams& p = body.params;
  glm::dvec3 found(highest ? -1e300 : 1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 x(corner & 1 ? p.low.x : p.high.x, corner & 2 ? p.low.y : p.high.y,
                       corner & 4 ? p.low.z : p.high.z);
    const glm::dvec3 world =
        body.origin + glm::dvec3(x.x * p.axisX - x.y * p.axisY, x.x * p.axisY + x.y * p.axisX, x.z);
    found = highest ? glm::max(found, world) : glm::min(found, world);
  }
  return found;
}
}  // namespace

glm::dvec3 HeroBody::lowest() const { return scatter.lowest(extreme(*this, false)); }
glm::dvec3 HeroBody::highest() const { return scatter.highest(extreme(*this, true)); }

HeroBody bakeHero(const Hero& hero, const Drift& drift, int seed, int cells) {
  const HeroCloud& cloud = hero.cloud;
  const HeroSurface& surface = hero.surface;
  const double lived = cloud.lifetime > 0.0f ? drift.time / cloud.lifetime : 0.0;
  const HeroLife life = heroLife(static_cast<float>(std::clamp(cloud.age + lived, 0.0, 1.0)));
  HeroForm form = hero.form;
  form.width *= cloud.scale;
  form.height *= cloud.scale;
  form.anvil *= cloud.scale;

  HeroBody body;
  body.origin = cloud.position + glm::dvec3(driftOffset(drift) * static_cast<double>(cloud.drift), 0.0);
  law::HeroParams& p = body.params;
  p.seed = static_cast<int>(seedOf(seed, cloud.seed));
  p.axisX = std::sin(cloud.heading);
  p.axisY = std::cos(cloud.heading);
  const float size = std::sqrt(form.width * form.height);
  p.place.w = size;
  p.low.w = form.height;
  p.high.w = cloud.extinction * life.density;
  p.halfWidth = 0.5f * form.width;
  p.breadth = form.breadth;
  p.edge = surface.edge;
  p.edgeTop = surface.edge * surface.topEdge;
  p.billowSize = surface.billowSize * size;
  p.billow = surface.billow * p.billowSize;
  p.billowRatio = 0.5f * surface.gain;
  p.billowLow = surface.baseBillow;
  p.calmTop = surface.topBillow;
  p.calmFrom = 0.5f * form.height;
  p.calmTo = 0.75f * form.height;
  p.interior = surface.interior;
  p.baseFade = 0.02f * size;
  p.baseNoise = surface.baseNoise * size;
  p.baseScale = 1.0f / (0.25f * size);
  p.wisp = (surface.wisp + 0.08f * life.decay) * size;
  p.octaves = surface.octaves;
  const double tile = law::kHeroCells * p.billowSize;
  const std::uint32_t a = law::hashUint(static_cast<std::uint32_t>(p.seed)), b = law::nextHash(a), c = law::nextHash(b);
  p.rise = {law::unitFromHash(a), law::unitFromHash(b),
            wrapped(law::unitFromHash(c) - cloud.updraft * drift.time / tile), static_cast<float>(1.0 / tile)};

  static const auto kNoParts = std::make_shared<const law::HeroParts>();
  static const auto kNoShape = std::make_shared<const Volume>(1, 1, 1, 4);
  body.parts = kNoParts;
  body.shape = kNoShape;
  HeroForm grown = form;
  grown.width *= glm::mix(0.4f, 1.0f, life.growth);
  grown.height *= glm::mix(0.4f, 1.0f, life.growth);
  const auto mixed = static_cast<std::uint32_t>(p.seed);
  switch (form.shape) {
    case HeroShape::towers:
    case HeroShape::rows:
    case HeroShape::curve:
    case HeroShape::ellipsoid:
      p.kind = law::kHeroSolid;
      makeSolid(body, hero, form, life, cells);
      break;
    case HeroShape::plates:
      p.kind = law::kHeroPlates;
      makeGeometry(body, heroPlates(grown, mixed));
      break;
    case HeroShape::patches:
      p.kind = law::kHeroPatches;
      makeGeometry(body, heroPatches(grown, mixed));
      break;
    case HeroShape::filaments:
      p.kind = law::kHeroFilaments;
      makeGeometry(body, heroFilaments(grown, mixed));
      break;
    case HeroShape::pouches: {
      p.kind = law::kHeroPouches;
      p.halfWidth = 0.5f * grown.width;
      const float wide = p.halfWidth + 0.6f * p.billow;
      setBox(p, {-wide, -wide * form.breadth, -0.07f * p.billowSize}, {wide, wide * form.breadth, form.height});
      break;
    }
    case HeroShape::classic:
      p.kind = law::kHeroClassic;
      makeClassic(body, hero, form, drift, cells);
      break;
  }
  body.scatter = scatterOf(hero, body);
  return body;
}

Scatter scatterOf(const Hero& hero, const HeroBody& body) {
  const HeroScatter& s = hero.scatter;
  const law::HeroParams& p = body.params;
  if (s.radius <= 0.0f) return {};
  float reach = 0.0f;
  for (int corner = 0; corner < 4; ++corner)
    reach = std::max(reach, std::hypot(corner & 1 ? p.low.x : p.high.x, corner & 2 ? p.low.y : p.high.y));
  // No copy reaches out of its square.
  const float edge = std::max(s.spacing, 2.01f * reach * (1.0f + s.variation));
  return {glm::dvec2(body.origin),
          {.place = {0.0f, 0.0f, static_cast<float>(body.origin.z), edge},
           .chance = {s.radius, s.share, s.variation, reach},
           .axis = {p.axisX, p.axisY, s.turn, static_cast<float>(p.seed)}}};
}

Volume bakeHeroBillows() {
  Volume billows = bakeBillows(kBillowTexels, static_cast<int>(law::kHeroCells), kBillowSeed);
  roundToHalf(billows);
  return billows;
}

}  // namespace welkin
