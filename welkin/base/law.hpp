#pragma once
// The law's vocabulary, scalar C++ reading: one ray, path or voxel at a time, on float and glm.
// A room's wrapper header includes this, opens `namespace welkin::law`, includes law_begin.inc, its .glsl files and
// law_end.inc, in that order.
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

#include "welkin/base/sampler.hpp"

namespace welkin::law {

using uint = std::uint32_t;
using glm::ivec2, glm::ivec3, glm::mat3, glm::vec2, glm::vec3, glm::vec4;
using Real = float;
using Vec2 = vec2;
using Vec3 = vec3;
using Vec4 = vec4;
using Int = std::int32_t;
using IVec2 = ivec2;
using IVec3 = ivec3;
using Uint = std::uint32_t;
using Mask = bool;
using Sampler2 = TextureView;
using Sampler3 = TextureView;
using Sampler2Array = TextureView;

using glm::cross, glm::dot, glm::length, glm::mix, glm::normalize, glm::clamp, glm::step, glm::smoothstep, glm::fract,
    glm::sign, glm::mod, glm::inversesqrt, glm::max, glm::min, glm::abs, glm::floor, glm::sqrt, glm::exp, glm::log,
    glm::pow, glm::sin, glm::cos, glm::acos, glm::exp2, glm::log2;

template <class T>
inline T select(bool mask, const T& a, const T& b) {
  return mask ? a : b;
}
inline float select(bool mask, float a, float b) { return mask ? a : b; }
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool invert(bool a) { return !a; }
inline bool noneOf(bool m) { return !m; }
inline bool toMask(bool m) { return m; }

inline float toReal(Int x) { return static_cast<float>(x); }
inline float toReal(Uint x) { return static_cast<float>(x); }
inline Int toInt(float x) { return static_cast<Int>(x); }
inline Int toInt(Uint x) { return static_cast<Int>(x); }
inline Uint toUint(Int x) { return static_cast<Uint>(x); }
inline Uint toUint(Uint x) { return x; }
inline Int floorInt(float x) { return static_cast<Int>(std::floor(x)); }

inline vec2 xy(const vec3& v) { return {v.x, v.y}; }
inline vec2 xy(const vec4& v) { return {v.x, v.y}; }
inline vec2 zw(const vec4& v) { return {v.z, v.w}; }
inline vec3 xyz(const vec4& v) { return {v.x, v.y, v.z}; }
inline float saturate(float x) { return glm::clamp(x, 0.0f, 1.0f); }

inline Int wrapIndex(Int i, Int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return i < 0 ? 0 : (i >= n ? n - 1 : i);
  const Int r = i % n;
  return r < 0 ? r + n : r;
}

inline vec4 texel(const TextureView& s, Int x, Int y, Int z) {
  const float* t = s.texels + ((static_cast<std::size_t>(z) * s.height + y) * s.width + x) * s.channels;
  return {t[0], s.channels > 1 ? t[1] : 0.0f, s.channels > 2 ? t[2] : 0.0f, s.channels > 3 ? t[3] : 1.0f};
}

inline vec4 sample2Array(const Sampler2Array& s, vec2 p, float layer) {
  const float x = p.x * static_cast<float>(s.width) - 0.5f, y = p.y * static_cast<float>(s.height) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y), wx = x - fx, wy = y - fy;
  const Int x0 = wrapIndex(static_cast<Int>(fx), s.width, s.wrap);
  const Int x1 = wrapIndex(static_cast<Int>(fx) + 1, s.width, s.wrap);
  const Int y0 = wrapIndex(static_cast<Int>(fy), s.height, s.wrapY);
  const Int y1 = wrapIndex(static_cast<Int>(fy) + 1, s.height, s.wrapY);
  const Int z = wrapIndex(static_cast<Int>(std::floor(layer + 0.5f)), s.depth, Wrap::clamp);
  return mix(mix(texel(s, x0, y0, z), texel(s, x1, y0, z), wx), mix(texel(s, x0, y1, z), texel(s, x1, y1, z), wx), wy);
}

inline vec4 sample2(const Sampler2& s, vec2 p) { return sample2Array(s, p, 0.0f); }

inline vec4 sample3(const Sampler3& s, vec3 p) {
  const float x = p.x * static_cast<float>(s.width) - 0.5f, y = p.y * static_cast<float>(s.height) - 0.5f,
              z = p.z * static_cast<float>(s.depth) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y), fz = std::floor(z), wx = x - fx, wy = y - fy, wz = z - fz;
  const Int x0 = wrapIndex(static_cast<Int>(fx), s.width, s.wrap);
  const Int x1 = wrapIndex(static_cast<Int>(fx) + 1, s.width, s.wrap);
  const Int y0 = wrapIndex(static_cast<Int>(fy), s.height, s.wrapY);
  const Int y1 = wrapIndex(static_cast<Int>(fy) + 1, s.height, s.wrapY);
  const Int z0 = wrapIndex(static_cast<Int>(fz), s.depth, s.wrap);
  const Int z1 = wrapIndex(static_cast<Int>(fz) + 1, s.depth, s.wrap);
  const vec4 a =
      mix(mix(texel(s, x0, y0, z0), texel(s, x1, y0, z0), wx), mix(texel(s, x0, y1, z0), texel(s, x1, y1, z0), wx), wy);
  const vec4 b =
      mix(mix(texel(s, x0, y0, z1), texel(s, x1, y0, z1), wx), mix(texel(s, x0, y1, z1), texel(s, x1, y1, z1), wx), wy);
  return mix(a, b, wz);
}

}  // namespace welkin::law
