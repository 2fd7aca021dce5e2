// The law's vocabulary, SIMD reading: one ray, path or voxel in each lane of Highway's widest vector. Values that are
// the same in every lane (parameters) keep their scalar types float, vec2..4, int, uint and convert where needed.
// Include it after hwy/foreach_target.h; it is read once per instruction set.
#if defined(WELKIN_BASE_LAW_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_BASE_LAW_SIMD_INL
#undef WELKIN_BASE_LAW_SIMD_INL
#else
#define WELKIN_BASE_LAW_SIMD_INL
#endif

#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>

#include "welkin/base/law.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE::law {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using VF = hn::Vec<D>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;

using uint = std::uint32_t;
using glm::ivec2, glm::ivec3, glm::mat3, glm::vec2, glm::vec3, glm::vec4;
using Sampler2 = TextureView;
using Sampler3 = TextureView;
using Sampler2Array = TextureView;

// Uniform (one value for all lanes) arithmetic keeps glm's functions.
using glm::cross, glm::dot, glm::length, glm::mix, glm::normalize, glm::clamp, glm::step, glm::smoothstep, glm::fract,
    glm::sign, glm::mod, glm::inversesqrt, glm::max, glm::min, glm::abs, glm::floor, glm::sqrt, glm::exp, glm::log,
    glm::pow, glm::sin, glm::cos, glm::acos, glm::exp2, glm::log2;

struct Mask {
  hn::Mask<D> m;
};
struct Int;
struct Uint;

struct Real {
  VF v;
  Real() = default;  // trivial, so that structs of lanes are: their implicit constructors know no target
  HWY_INLINE Real(VF x) : v(x) {}
  HWY_INLINE Real(float x) : v(hn::Set(D(), x)) {}
};
struct Int {
  VI v;
  Int() = default;
  HWY_INLINE Int(VI x) : v(x) {}
  HWY_INLINE Int(std::int32_t x) : v(hn::Set(DI(), x)) {}
};
struct Uint {
  VU v;
  Uint() = default;
  HWY_INLINE Uint(VU x) : v(x) {}
  HWY_INLINE Uint(std::uint32_t x) : v(hn::Set(DU(), x)) {}
};

HWY_INLINE Real operator+(Real a, Real b) { return hn::Add(a.v, b.v); }
HWY_INLINE Real operator-(Real a, Real b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Real operator*(Real a, Real b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Real operator/(Real a, Real b) { return hn::Div(a.v, b.v); }
HWY_INLINE Real operator-(Real a) { return hn::Neg(a.v); }
HWY_INLINE Real& operator+=(Real& a, Real b) { return a = a + b; }
HWY_INLINE Real& operator-=(Real& a, Real b) { return a = a - b; }
HWY_INLINE Real& operator*=(Real& a, Real b) { return a = a * b; }
HWY_INLINE Real& operator/=(Real& a, Real b) { return a = a / b; }
HWY_INLINE Mask operator<(Real a, Real b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE Mask operator>(Real a, Real b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE Mask operator<=(Real a, Real b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE Mask operator>=(Real a, Real b) { return {hn::Ge(a.v, b.v)}; }
HWY_INLINE Mask operator==(Real a, Real b) { return {hn::Eq(a.v, b.v)}; }

HWY_INLINE Int operator+(Int a, Int b) { return hn::Add(a.v, b.v); }
HWY_INLINE Int operator-(Int a, Int b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Int operator*(Int a, Int b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Int operator&(Int a, Int b) { return hn::And(a.v, b.v); }
HWY_INLINE Int operator-(Int a) { return hn::Neg(a.v); }
HWY_INLINE Int& operator+=(Int& a, Int b) { return a = a + b; }
HWY_INLINE Int& operator-=(Int& a, Int b) { return a = a - b; }
HWY_INLINE Mask operator<(Int a, Int b) { return {hn::RebindMask(D(), hn::Lt(a.v, b.v))}; }
HWY_INLINE Mask operator>(Int a, Int b) { return {hn::RebindMask(D(), hn::Gt(a.v, b.v))}; }
HWY_INLINE Mask operator<=(Int a, Int b) { return {hn::Not(hn::RebindMask(D(), hn::Gt(a.v, b.v)))}; }
HWY_INLINE Mask operator>=(Int a, Int b) { return {hn::Not(hn::RebindMask(D(), hn::Lt(a.v, b.v)))}; }
HWY_INLINE Mask operator==(Int a, Int b) { return {hn::RebindMask(D(), hn::Eq(a.v, b.v))}; }

HWY_INLINE Uint operator+(Uint a, Uint b) { return hn::Add(a.v, b.v); }
HWY_INLINE Uint operator-(Uint a, Uint b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Uint operator*(Uint a, Uint b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Uint operator^(Uint a, Uint b) { return hn::Xor(a.v, b.v); }
HWY_INLINE Uint operator&(Uint a, Uint b) { return hn::And(a.v, b.v); }
HWY_INLINE Uint operator|(Uint a, Uint b) { return hn::Or(a.v, b.v); }
// Shifts by the same amount in every lane.
HWY_INLINE Uint operator>>(Uint a, uint n) { return hn::ShiftRightSame(a.v, static_cast<int>(n)); }
HWY_INLINE Uint operator<<(Uint a, uint n) { return hn::ShiftLeftSame(a.v, static_cast<int>(n)); }
HWY_INLINE Uint operator>>(Uint a, Uint n) { return hn::Shr(a.v, n.v); }
HWY_INLINE Mask operator==(Uint a, Uint b) { return {hn::RebindMask(D(), hn::Eq(a.v, b.v))}; }
HWY_INLINE Uint& operator+=(Uint& a, Uint b) { return a = a + b; }
HWY_INLINE Uint& operator*=(Uint& a, Uint b) { return a = a * b; }
HWY_INLINE Uint& operator^=(Uint& a, Uint b) { return a = a ^ b; }

HWY_INLINE Mask both(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE Mask either(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE Mask invert(Mask a) { return {hn::Not(a.m)}; }
HWY_INLINE bool noneOf(Mask m) { return hn::AllFalse(D(), m.m); }
HWY_INLINE Mask toMask(bool m) { return {hn::Gt(hn::Set(D(), m ? 1.0f : 0.0f), hn::Zero(D()))}; }

struct Vec2 {
  Real x, y;
  Vec2() = default;
  HWY_INLINE Vec2(Real a, Real b) : x(a), y(b) {}
  HWY_INLINE explicit Vec2(Real a) : x(a), y(a) {}
  HWY_INLINE Vec2(const vec2& u) : x(u.x), y(u.y) {}
};
struct Vec3 {
  Real x, y, z;
  Vec3() = default;
  HWY_INLINE Vec3(Real a, Real b, Real c) : x(a), y(b), z(c) {}
  HWY_INLINE explicit Vec3(Real a) : x(a), y(a), z(a) {}
  HWY_INLINE Vec3(const vec3& u) : x(u.x), y(u.y), z(u.z) {}
};
struct Vec4 {
  Real x, y, z, w;
  Vec4() = default;
  HWY_INLINE Vec4(Real a, Real b, Real c, Real d) : x(a), y(b), z(c), w(d) {}
  HWY_INLINE explicit Vec4(Real a) : x(a), y(a), z(a), w(a) {}
  HWY_INLINE Vec4(const vec4& u) : x(u.x), y(u.y), z(u.z), w(u.w) {}
};
struct IVec2 {
  Int x, y;
  IVec2() = default;
  HWY_INLINE IVec2(Int a, Int b) : x(a), y(b) {}
  HWY_INLINE IVec2(const ivec2& u) : x(u.x), y(u.y) {}
};
struct IVec3 {
  Int x, y, z;
  IVec3() = default;
  HWY_INLINE IVec3(Int a, Int b, Int c) : x(a), y(b), z(c) {}
  HWY_INLINE IVec3(const ivec3& u) : x(u.x), y(u.y), z(u.z) {}
};

#define WELKIN_VECTOR_OPERATOR(OP)                                                                             \
  HWY_INLINE Vec2 operator OP(Vec2 a, Vec2 b) { return Vec2(a.x OP b.x, a.y OP b.y); }                         \
  HWY_INLINE Vec2 operator OP(Vec2 a, Real b) { return Vec2(a.x OP b, a.y OP b); }                             \
  HWY_INLINE Vec2 operator OP(Real a, Vec2 b) { return Vec2(a OP b.x, a OP b.y); }                             \
  HWY_INLINE Vec3 operator OP(Vec3 a, Vec3 b) { return Vec3(a.x OP b.x, a.y OP b.y, a.z OP b.z); }             \
  HWY_INLINE Vec3 operator OP(Vec3 a, Real b) { return Vec3(a.x OP b, a.y OP b, a.z OP b); }                   \
  HWY_INLINE Vec3 operator OP(Real a, Vec3 b) { return Vec3(a OP b.x, a OP b.y, a OP b.z); }                   \
  HWY_INLINE Vec4 operator OP(Vec4 a, Vec4 b) { return Vec4(a.x OP b.x, a.y OP b.y, a.z OP b.z, a.w OP b.w); } \
  HWY_INLINE Vec4 operator OP(Vec4 a, Real b) { return Vec4(a.x OP b, a.y OP b, a.z OP b, a.w OP b); }         \
  HWY_INLINE Vec4 operator OP(Real a, Vec4 b) { return Vec4(a OP b.x, a OP b.y, a OP b.z, a OP b.w); }
WELKIN_VECTOR_OPERATOR(+)
WELKIN_VECTOR_OPERATOR(-)
WELKIN_VECTOR_OPERATOR(*)
WELKIN_VECTOR_OPERATOR(/)
#undef WELKIN_VECTOR_OPERATOR
HWY_INLINE Vec2 operator-(Vec2 a) { return Vec2(-a.x, -a.y); }
HWY_INLINE Vec3 operator-(Vec3 a) { return Vec3(-a.x, -a.y, -a.z); }
HWY_INLINE Vec4 operator-(Vec4 a) { return Vec4(-a.x, -a.y, -a.z, -a.w); }
#define WELKIN_COMPOUND(V)                                     \
  HWY_INLINE V& operator+=(V& a, V b) { return a = a + b; }    \
  HWY_INLINE V& operator-=(V& a, V b) { return a = a - b; }    \
  HWY_INLINE V& operator*=(V& a, V b) { return a = a * b; }    \
  HWY_INLINE V& operator*=(V& a, Real b) { return a = a * b; } \
  HWY_INLINE V& operator/=(V& a, Real b) { return a = a / b; }
WELKIN_COMPOUND(Vec2)
WELKIN_COMPOUND(Vec3)
WELKIN_COMPOUND(Vec4)
#undef WELKIN_COMPOUND
HWY_INLINE IVec2 operator+(IVec2 a, IVec2 b) { return IVec2(a.x + b.x, a.y + b.y); }
HWY_INLINE IVec3 operator+(IVec3 a, IVec3 b) { return IVec3(a.x + b.x, a.y + b.y, a.z + b.z); }

HWY_INLINE Real select(Mask m, Real a, Real b) { return hn::IfThenElse(m.m, a.v, b.v); }
HWY_INLINE Int select(Mask m, Int a, Int b) { return hn::IfThenElse(hn::RebindMask(DI(), m.m), a.v, b.v); }
HWY_INLINE Uint select(Mask m, Uint a, Uint b) { return hn::IfThenElse(hn::RebindMask(DU(), m.m), a.v, b.v); }
HWY_INLINE Mask select(Mask m, Mask a, Mask b) { return {hn::Or(hn::And(m.m, a.m), hn::AndNot(m.m, b.m))}; }
HWY_INLINE Vec2 select(Mask m, Vec2 a, Vec2 b) { return Vec2(select(m, a.x, b.x), select(m, a.y, b.y)); }
HWY_INLINE Vec3 select(Mask m, Vec3 a, Vec3 b) {
  return Vec3(select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z));
}
HWY_INLINE Vec4 select(Mask m, Vec4 a, Vec4 b) {
  return Vec4(select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w));
}

HWY_INLINE Real toReal(Int x) { return hn::ConvertTo(D(), x.v); }
HWY_INLINE Real toReal(Uint x) {
  // Exact split: the high and low halves convert without rounding, their sum rounds once, as a scalar conversion does.
  const Real hi = hn::ConvertTo(D(), hn::BitCast(DI(), hn::ShiftRight<16>(x.v)));
  const Real lo = hn::ConvertTo(D(), hn::BitCast(DI(), hn::And(x.v, hn::Set(DU(), 0xFFFFu))));
  return hi * Real(65536.0f) + lo;
}
HWY_INLINE float toReal(std::int32_t x) { return static_cast<float>(x); }
HWY_INLINE Int toInt(Real x) { return hn::ConvertTo(DI(), x.v); }
HWY_INLINE Int toInt(Uint x) { return hn::BitCast(DI(), x.v); }
HWY_INLINE Uint toUint(Int x) { return hn::BitCast(DU(), x.v); }
HWY_INLINE Uint toUint(Uint x) { return x; }
HWY_INLINE uint toUint(std::int32_t x) { return static_cast<uint>(x); }
HWY_INLINE uint toUint(uint x) { return x; }

HWY_INLINE Real abs(Real x) { return hn::Abs(x.v); }
HWY_INLINE Real floor(Real x) { return hn::Floor(x.v); }
HWY_INLINE Int floorInt(Real x) { return hn::ConvertTo(DI(), hn::Floor(x.v)); }
HWY_INLINE Real fract(Real x) { return x - floor(x); }
HWY_INLINE Real sqrt(Real x) { return hn::Sqrt(x.v); }
HWY_INLINE Real inversesqrt(Real x) { return Real(1.0f) / sqrt(x); }
HWY_INLINE Real min(Real a, Real b) { return hn::Min(a.v, b.v); }
HWY_INLINE Real max(Real a, Real b) { return hn::Max(a.v, b.v); }
HWY_INLINE Int min(Int a, Int b) { return hn::Min(a.v, b.v); }
HWY_INLINE Int max(Int a, Int b) { return hn::Max(a.v, b.v); }
HWY_INLINE Real clamp(Real x, Real a, Real b) { return min(max(x, a), b); }
HWY_INLINE Real saturate(Real x) { return clamp(x, 0.0f, 1.0f); }
HWY_INLINE Real mix(Real a, Real b, Real t) { return a * (1.0f - t) + b * t; }
HWY_INLINE Real mix(Real a, Real b, float t) { return mix(a, b, Real(t)); }
HWY_INLINE Real step(Real edge, Real x) { return select(x < edge, Real(0.0f), Real(1.0f)); }
HWY_INLINE Real smoothstep(Real a, Real b, Real x) {
  const Real t = clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}
HWY_INLINE Real sign(Real x) { return select(x > 0.0f, Real(1.0f), select(x < 0.0f, Real(-1.0f), Real(0.0f))); }
HWY_INLINE Real mod(Real x, Real y) { return x - y * floor(x / y); }
HWY_INLINE Real exp(Real x) { return hn::Exp(D(), x.v); }
HWY_INLINE Real log(Real x) { return hn::Log(D(), x.v); }
HWY_INLINE Real exp2(Real x) { return exp(x * 0.693147181f); }
HWY_INLINE Real log2(Real x) { return hn::Log2(D(), x.v); }
HWY_INLINE Real pow(Real x, Real y) { return select(x > 0.0f, exp(y * log(max(x, 1e-37f))), Real(0.0f)); }
HWY_INLINE Real sin(Real x) { return hn::Sin(D(), x.v); }
HWY_INLINE Real cos(Real x) { return hn::Cos(D(), x.v); }
HWY_INLINE Real acos(Real x) { return hn::Acos(D(), x.v); }
HWY_INLINE float saturate(float x) { return glm::clamp(x, 0.0f, 1.0f); }

#define WELKIN_MAP1(F)                                               \
  HWY_INLINE Vec2 F(Vec2 a) { return Vec2(F(a.x), F(a.y)); }         \
  HWY_INLINE Vec3 F(Vec3 a) { return Vec3(F(a.x), F(a.y), F(a.z)); } \
  HWY_INLINE Vec4 F(Vec4 a) { return Vec4(F(a.x), F(a.y), F(a.z), F(a.w)); }
WELKIN_MAP1(abs)
WELKIN_MAP1(floor)
WELKIN_MAP1(fract)
WELKIN_MAP1(exp)
WELKIN_MAP1(sqrt)
#undef WELKIN_MAP1
#define WELKIN_MAP2(F)                                                                      \
  HWY_INLINE Vec2 F(Vec2 a, Vec2 b) { return Vec2(F(a.x, b.x), F(a.y, b.y)); }              \
  HWY_INLINE Vec3 F(Vec3 a, Vec3 b) { return Vec3(F(a.x, b.x), F(a.y, b.y), F(a.z, b.z)); } \
  HWY_INLINE Vec3 F(Vec3 a, Real b) { return Vec3(F(a.x, b), F(a.y, b), F(a.z, b)); }       \
  HWY_INLINE Vec4 F(Vec4 a, Vec4 b) { return Vec4(F(a.x, b.x), F(a.y, b.y), F(a.z, b.z), F(a.w, b.w)); }
WELKIN_MAP2(min)
WELKIN_MAP2(max)
WELKIN_MAP2(mod)
#undef WELKIN_MAP2
HWY_INLINE Vec2 mix(Vec2 a, Vec2 b, Real t) { return Vec2(mix(a.x, b.x, t), mix(a.y, b.y, t)); }
HWY_INLINE Vec3 mix(Vec3 a, Vec3 b, Real t) { return Vec3(mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)); }
HWY_INLINE Vec4 mix(Vec4 a, Vec4 b, Real t) {
  return Vec4(mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t), mix(a.w, b.w, t));
}
HWY_INLINE Real dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
HWY_INLINE Real dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Real dot(Vec4 a, Vec4 b) { return (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w); }
HWY_INLINE Real length(Vec2 a) { return sqrt(dot(a, a)); }
HWY_INLINE Real length(Vec3 a) { return sqrt(dot(a, a)); }
HWY_INLINE Vec3 normalize(Vec3 a) { return a * inversesqrt(dot(a, a)); }
HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) {
  return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
HWY_INLINE Vec2 xy(Vec3 v) { return Vec2(v.x, v.y); }
HWY_INLINE Vec2 xy(Vec4 v) { return Vec2(v.x, v.y); }
HWY_INLINE Vec2 zw(Vec4 v) { return Vec2(v.z, v.w); }
HWY_INLINE Vec3 xyz(Vec4 v) { return Vec3(v.x, v.y, v.z); }
HWY_INLINE vec2 xy(const vec3& v) { return {v.x, v.y}; }
HWY_INLINE vec2 xy(const vec4& v) { return {v.x, v.y}; }
HWY_INLINE vec2 zw(const vec4& v) { return {v.z, v.w}; }
HWY_INLINE vec3 xyz(const vec4& v) { return {v.x, v.y, v.z}; }

HWY_INLINE Int wrapIndex(Int i, std::int32_t n, Wrap wrap) {
  if (wrap == Wrap::clamp) return min(max(i, Int(0)), Int(n - 1));
  if ((n & (n - 1)) == 0) return i & Int(n - 1);
  const Real q = floor(toReal(i) / static_cast<float>(n));
  Int r = i - toInt(q) * Int(n);
  r = select(r < Int(0), r + Int(n), r);
  return select(r >= Int(n), r - Int(n), r);
}

HWY_INLINE Real gather(const float* base, Int index) { return hn::GatherIndex(D(), base, index.v); }

// The texel whose first channel stands at `index`.
HWY_INLINE Vec4 texelAt(const TextureView& s, Int index) {
  Vec4 t(gather(s.texels, index), 0.0f, 0.0f, 1.0f);
  if (s.channels > 1) t.y = gather(s.texels + 1, index);
  if (s.channels > 2) t.z = gather(s.texels + 2, index);
  if (s.channels > 3) t.w = gather(s.texels + 3, index);
  return t;
}

// One channel alone, which costs a fourth of the arithmetic.
HWY_INLINE Real bilinear1(const TextureView& s, Int x0, Int x1, Int row0, Int row1, Real wx, Real wy) {
  return mix(mix(gather(s.texels, row0 + x0), gather(s.texels, row0 + x1), wx),
             mix(gather(s.texels, row1 + x0), gather(s.texels, row1 + x1), wx), wy);
}

HWY_INLINE Vec4 bilinear(const TextureView& s, Int x0, Int x1, Int row0, Int row1, Real wx, Real wy) {
  const Int c(s.channels);
  return mix(mix(texelAt(s, (row0 + x0) * c), texelAt(s, (row0 + x1) * c), wx),
             mix(texelAt(s, (row1 + x0) * c), texelAt(s, (row1 + x1) * c), wx), wy);
}

HWY_INLINE Vec4 sample2Array(const Sampler2Array& s, Vec2 p, Real layer) {
  const Real x = p.x * static_cast<float>(s.width) - 0.5f, y = p.y * static_cast<float>(s.height) - 0.5f;
  const Real fx = floor(x), fy = floor(y);
  const Int ix = toInt(fx), iy = toInt(fy), w(s.width), h(s.height);
  const Int base = wrapIndex(floorInt(layer + 0.5f), s.depth, Wrap::clamp) * h;
  return bilinear(s, wrapIndex(ix, s.width, s.wrap), wrapIndex(ix + Int(1), s.width, s.wrap),
                  (base + wrapIndex(iy, s.height, s.wrapY)) * w, (base + wrapIndex(iy + Int(1), s.height, s.wrapY)) * w,
                  x - fx, y - fy);
}

HWY_INLINE Vec4 sample2(const Sampler2& s, Vec2 p) { return sample2Array(s, p, 0.0f); }

HWY_INLINE Vec4 sample3(const Sampler3& s, Vec3 p) {
  const Real x = p.x * static_cast<float>(s.width) - 0.5f, y = p.y * static_cast<float>(s.height) - 0.5f,
             z = p.z * static_cast<float>(s.depth) - 0.5f;
  const Real fx = floor(x), fy = floor(y), fz = floor(z);
  const Int ix = toInt(fx), iy = toInt(fy), iz = toInt(fz), w(s.width), h(s.height);
  const Int x0 = wrapIndex(ix, s.width, s.wrap), x1 = wrapIndex(ix + Int(1), s.width, s.wrap);
  const Int y0 = wrapIndex(iy, s.height, s.wrapY), y1 = wrapIndex(iy + Int(1), s.height, s.wrapY);
  const Int z0 = wrapIndex(iz, s.depth, s.wrap) * h, z1 = wrapIndex(iz + Int(1), s.depth, s.wrap) * h;
  const Real wx = x - fx, wy = y - fy;
  if (s.channels == 1)
    return Vec4(mix(bilinear1(s, x0, x1, (z0 + y0) * w, (z0 + y1) * w, wx, wy),
                    bilinear1(s, x0, x1, (z1 + y0) * w, (z1 + y1) * w, wx, wy), z - fz),
                0.0f, 0.0f, 1.0f);
  return mix(bilinear(s, x0, x1, (z0 + y0) * w, (z0 + y1) * w, wx, wy),
             bilinear(s, x0, x1, (z1 + y0) * w, (z1 + y1) * w, wx, wy), z - fz);
}

HWY_INLINE std::size_t laneCount() { return hn::Lanes(D()); }

}  // namespace welkin::HWY_NAMESPACE::law
HWY_AFTER_NAMESPACE();
#endif
