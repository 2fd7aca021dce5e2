#include "welkin/density/hero_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace welkin {

namespace {

constexpr float kMostBalls = 40.0f;  // of a tower
constexpr float kJoint = 0.02f;      // width of the joint between balls, as a share of the size

// Balls stacked up to `height` over a place, each a little aside. `grown` is the share of the height that the tower has
// reached; its balls rise and swell, and their number stays.
void addTower(const HeroForm& form, const glm::vec2& place, float radius, float height, float grown, HeroDice& dice,
              std::vector<glm::vec4>& balls) {
  radius = std::min(radius, height / 1.35f);
  const float first = 0.35f * radius, last = height - radius;
  const float apart = std::max(0.62f * radius, (last - first) / kMostBalls);
  const int count = std::max(1, static_cast<int>(std::ceil((last - first) / apart)) + 1);
  const float swollen = std::min(glm::mix(0.45f, 1.0f, grown), grown * height / (1.35f * radius));
  for (int i = 0; i < count; ++i) {
    const float up = count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 1.0f;
    const float r = radius * glm::mix(1.08f, 1.0f, up) * (1.0f - form.waist * std::sin(3.14159265f * up));
    const float jitter = i + 1 < count ? 0.22f * radius : 0.1f * radius;
    const float z = grown * glm::mix(first, last, up);
    const float x = dice(-jitter, jitter), y = dice(-jitter, jitter);
    balls.emplace_back(place.x + form.lean * z + swollen * x, place.y + swollen * y, z, swollen * r);
  }
}

void addCluster(HeroSolid& s, const HeroLife& life, HeroDice& dice) {
  const HeroForm& form = s.form;
  const glm::vec2 spread = glm::vec2(1.0f, form.breadth) * (0.5f - form.rimRadius) * form.width;
  const float turn = dice(0.0f, 6.2831853f), narrow = glm::mix(0.35f, 1.0f, life.growth);
  for (int i = 0; i < form.parts; ++i) {
    // Sunflower: even, and as many as one likes.
    const float rim =
        i == 0
            ? 0.0f
            : std::sqrt((static_cast<float>(i) + dice(-0.3f, 0.3f)) / static_cast<float>(std::max(form.parts - 1, 1)));
    const float e = std::min(rim, 1.0f), angle = turn + 2.3999632f * static_cast<float>(i) + dice(-0.25f, 0.25f);
    const float radius = form.width * glm::mix(form.towerRadius, form.rimRadius, e) * dice(0.85f, 1.12f);
    const float height = form.height * glm::mix(1.0f, form.rimHeight, e) * (i == 0 ? 1.0f : dice(0.7f, 1.02f));
    // They come up one after another.
    const float start = i == 0 ? 0.08f : dice(0.0f, 0.18f);
    const float grown = glm::mix(std::min(0.16f * form.width / form.height, 0.5f), 1.0f,
                                 law::smoothstep(start, start + 0.32f, life.age));
    addTower(form, narrow * e * spread * glm::vec2(std::cos(angle), std::sin(angle)), radius, height, grown, dice,
             s.balls);
  }
  for (int i = 0; i < form.pucks; ++i) {
    const float angle =
        turn + 6.2831853f * (static_cast<float>(i) + dice(-0.2f, 0.2f)) / static_cast<float>(form.pucks);
    const float radius = dice(0.2f, 0.3f) * form.width;
    const glm::vec2 room = glm::max(glm::vec2(0.5f, 0.5f * form.breadth) * form.width - radius, glm::vec2(0.0f));
    const float flat = narrow * dice(0.6f, 1.0f);
    s.pucks.emplace_back(narrow * room.x * std::cos(angle), narrow * room.y * std::sin(angle), 0.16f * flat * radius,
                         flat * radius);
  }
}

// Two rows of turrets of all sizes, each on banks of flat cloud with gaps.
void addRows(HeroSolid& s, const HeroLife& life, HeroDice& dice) {
  const HeroForm& form = s.form;
  const float half = 0.5f * form.width, apart = 0.28f * form.breadth * form.width;
  for (int row = -1; row <= 1; row += 2) {
    const float phase = dice(0.0f, 6.2831853f);
    const auto across = [&](float x) {
      return static_cast<float>(row) * apart + 0.08f * form.width * form.breadth * std::sin(5.0f * x / half + phase);
    };
    const int banks = 15;
    for (int i = 0; i < banks; ++i) {
      const bool gap = dice(0.0f, 1.0f) < 0.4f;
      const float x = half * (2.0f * (static_cast<float>(i) + dice(0.1f, 0.9f)) / banks - 1.0f) * 0.95f;
      const float radius = (gap ? 0.4f : dice(1.2f, 2.2f)) * form.towerRadius * form.width;
      s.pucks.emplace_back(x, across(x) + dice(-0.4f, 0.4f) * radius, 0.14f * radius, radius);
    }
    const int turrets = (form.parts + (row > 0 ? 1 : 0)) / 2;
    for (int i = 0; i < turrets; ++i) {
      const float x =
          half * (2.0f * (static_cast<float>(i) + dice(0.0f, 1.0f)) / static_cast<float>(turrets) - 1.0f) * 0.9f;
      const float tall = dice(0.0f, 1.0f), slim = dice(0.0f, 1.0f);
      const float radius = form.width * glm::mix(form.towerRadius, form.rimRadius, slim);
      const float height = form.height * glm::mix(form.rimHeight, 1.0f, tall);
      const float start = dice(0.0f, 0.18f);
      const float grown = glm::mix(0.3f, 1.0f, law::smoothstep(start, start + 0.32f, life.age));
      addTower(form, {x, across(x)}, radius, height, grown, dice, s.balls);
      if (slim < 0.5f)
        addTower(form, {x + 1.3f * radius, across(x)}, 0.7f * radius, 0.6f * height, grown, dice, s.balls);
    }
  }
}

// Depth of an implicit function that is positive inside: its value over its slope.
glm::vec4 depthOf(float value, const glm::vec3& slope, float most) {
  const float steep = std::max(glm::length(slope), 1e-12f);
  return {-slope / steep, std::clamp(value / steep, -most, most)};
}

glm::vec4 depthInEllipsoid(const HeroSolid& s, const glm::vec3& x) {
  const glm::vec3 half(0.5f * s.form.width, 0.5f * s.form.width * s.form.breadth, s.form.height);
  const float t = std::abs(x.z) / half.z, e = s.form.exponent, power = std::pow(t, e);
  const float value = 1.0f - x.x * x.x / (half.x * half.x) - x.y * x.y / (half.y * half.y) - power;
  const float upward = t > 0.0f ? -e * power / x.z : 0.0f;
  return depthOf(value, {-2.0f * x.x / (half.x * half.x), -2.0f * x.y / (half.y * half.y), upward}, s.size);
}

// The same shape gradient as that of "classic", in metres.
glm::vec4 depthInCurve(const HeroSolid& s, glm::vec3 x) {
  x.x -= s.form.lean * x.z;
  const glm::vec2 half(0.5f * s.form.width, 0.5f * s.form.width * s.form.breadth);
  const float step = 0.01f * s.form.height;
  const float upward = (shapeGradient(s.form, 1.0f, x + glm::vec3(0.0f, 0.0f, step)) -
                        shapeGradient(s.form, 1.0f, x - glm::vec3(0.0f, 0.0f, step))) /
                       (2.0f * step);
  return depthOf(shapeGradient(s.form, 1.0f, x),
                 {-2.0f * x.x / (half.x * half.x), -2.0f * x.y / (half.y * half.y), upward}, s.size);
}

// A smooth union: -K log sum exp(-d / K).
glm::vec4 depthInBalls(const HeroSolid& s, const glm::vec3& x) {
  const float k = kJoint * s.size;
  const auto distance = [&](const glm::vec4& b, bool flat, glm::vec3& normal) {
    const float squash = flat ? 0.26f : 1.0f;
    glm::vec3 d = x - glm::vec3(b);
    d.z /= squash;
    const float r = std::max(glm::length(d), 1e-3f);
    glm::vec3 slope = d / r;
    slope.z /= squash;
    const float steep = glm::length(slope);
    normal = slope / steep;
    return (r - b.w) / steep;
  };
  float nearest = 1e30f;
  glm::vec3 normal;
  for (const glm::vec4& b : s.balls) nearest = std::min(nearest, distance(b, false, normal));
  for (const glm::vec4& b : s.pucks) nearest = std::min(nearest, distance(b, true, normal));
  float sum = 0.0f;
  glm::vec3 mean(0.0f);
  const auto add = [&](const glm::vec4& b, bool flat) {
    const float d = distance(b, flat, normal);
    if (d > nearest + 12.0f * k) return;
    const float weight = std::exp((nearest - d) / k);
    sum += weight;
    mean += weight * normal;
  };
  for (const glm::vec4& b : s.balls) add(b, false);
  for (const glm::vec4& b : s.pucks) add(b, true);
  const float length = glm::length(mean);
  return {length > 1e-6f ? mean / length : glm::vec3(0.0f, 0.0f, 1.0f), k * std::log(sum) - nearest};
}

}  // namespace

float gradation(const HeroForm& form, float height) {
  // The squares are what eq. 3.2 adds up; a curve through them closes as a dome.
  std::array<float, 6> s{form.radiiLow.x,  form.radiiLow.y,  form.radiiLow.z,
                         form.radiiHigh.x, form.radiiHigh.y, form.radiiHigh.z};
  for (float& r : s) r *= r;
  const float at = std::clamp(height, 0.0f, 1.0f) * 5.0f;
  const auto i = static_cast<std::size_t>(std::min(at, 4.0f));
  const auto secant = [&](std::size_t k) { return s[k + 1] - s[k]; };
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k == 5) return secant(k == 0 ? 0 : 4);
    const float a = secant(k - 1), b = secant(k);
    return a * b <= 0.0f ? 0.0f : 2.0f * a * b / (a + b);
  };
  const float t = at - static_cast<float>(i), u = 1.0f - t;
  const float value = s[i] * (1.0f + 2.0f * t) * u * u + slope(i) * t * u * u + s[i + 1] * t * t * (3.0f - 2.0f * t) -
                      slope(i + 1) * t * t * u;
  return std::sqrt(std::max(value, 0.0f));
}

float shapeGradient(const HeroForm& form, float scale, const glm::vec3& x) {
  const glm::vec2 half(0.5f * form.width, 0.5f * form.width * form.breadth);
  const float tx = scale * x.x / half.x, ty = scale * x.y / half.y;
  const float h = 0.5f + scale * (x.z / form.height - 0.5f), within = std::clamp(h, 0.0f, 1.0f);
  const float r = gradation(form, within);
  return r * r - 4.0f * std::abs(h - within) - tx * tx - ty * ty;
}

HeroLife heroLife(float age) {
  const float decay = law::smoothstep(0.8f, 1.0f, age);
  return {age, law::smoothstep(0.0f, 0.45f, age), law::smoothstep(0.45f, 0.75f, age), decay,
          law::smoothstep(0.0f, 0.08f, age) * (1.0f - decay)};
}

HeroSolid heroSolid(const HeroForm& form, float taper, const HeroLife& life, std::uint32_t seed) {
  HeroSolid s{.form = form, .size = std::sqrt(form.width * form.height), .balls = {}, .pucks = {}};
  s.taper = taper * s.size;
  s.eaten = 0.12f * s.size * life.decay;
  HeroDice dice(seed);
  if (form.shape == HeroShape::towers) {
    addCluster(s, life, dice);
  } else if (form.shape == HeroShape::rows) {
    addRows(s, life, dice);
  } else {
    s.form.width *= glm::mix(0.35f, 1.0f, life.growth);
    s.form.height *= glm::mix(0.15f, 1.0f, life.growth);
  }
  return s;
}

glm::vec4 depthIn(const HeroSolid& s, const glm::vec3& x) {
  glm::vec4 d = s.form.shape == HeroShape::curve       ? depthInCurve(s, x)
                : s.form.shape == HeroShape::ellipsoid ? depthInEllipsoid(s, x)
                                                       : depthInBalls(s, x);
  const float low = std::max(1.0f - x.z / (0.14f * s.size), 0.0f);
  d.w -= s.eaten + s.taper * std::min(low * low, 1.0f);
  return d;
}

void boundsOf(const HeroSolid& s, glm::vec3& low, glm::vec3& high) {
  if (s.balls.empty()) {
    high = {0.5f * s.form.width, 0.5f * s.form.width * s.form.breadth, s.form.height};
    low = {-high.x, -high.y, 0.0f};
    const float lean = s.form.shape == HeroShape::curve ? s.form.lean * s.form.height : 0.0f;
    low.x += std::min(lean, 0.0f);
    high.x += std::max(lean, 0.0f);
    return;
  }
  low = glm::vec3(1e30f);
  high = glm::vec3(-1e30f);
  const float swell = kJoint * s.size * std::log(static_cast<float>(s.balls.size() + s.pucks.size()));
  for (const glm::vec4& b : s.balls) {
    low = glm::min(low, glm::vec3(b) - b.w - swell);
    high = glm::max(high, glm::vec3(b) + b.w + swell);
  }
  for (const glm::vec4& b : s.pucks) {
    low = glm::min(low, glm::vec3(b) - b.w - swell);
    high = glm::max(high, glm::vec3(b) + b.w + swell);
  }
  low.z = 0.0f;
}

}  // namespace welkin
