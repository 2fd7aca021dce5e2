#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/atmosphere/bake.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include <bit>

#include "welkin/atmosphere/bake.hpp"
#include "welkin/atmosphere/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using law::D, law::Real, law::Vec2, law::Vec3, law::Vec4;

// The structs of this instruction set's reading, which are laid out as the scalar ones.
struct Params {
  law::AtmosphereParams air;
  law::PreethamParams preetham;
  law::GradientParams gradient;
};
static_assert(sizeof(Params) == sizeof(SkyParams));

static law::AtmosphereParams convert(const ::welkin::law::AtmosphereParams& air) {
  return std::bit_cast<law::AtmosphereParams>(air);
}

static Real lanes(std::size_t first) { return Real(hn::Iota(D(), static_cast<float>(first))); }

static void store(const Vec3& v, float w, float* out, std::size_t stride) {
  alignas(64) float x[3][64];
  hn::Store(v.x.v, D(), x[0]);
  hn::Store(v.y.v, D(), x[1]);
  hn::Store(v.z.v, D(), x[2]);
  for (std::size_t i = 0; i < law::laneCount(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) out[i * stride + c] = x[c][i];
    if (stride == 4) out[i * stride + 3] = w;
  }
}

static float* texel(Table& t, std::size_t x, int y, int z) {
  return t.texels.data() + ((static_cast<std::size_t>(z) * t.height + y) * t.width + x) * 4;
}

template <class F>
static void fillRow(int y, Table& out, const F& f) {
  const auto width = static_cast<std::size_t>(out.width);
  const Real v((static_cast<float>(y) + 0.5f) / static_cast<float>(out.height));
  for (std::size_t x = 0; x < width; x += law::laneCount()) {
    const Real u = (lanes(x) + 0.5f) / static_cast<float>(width);
    store(law::xyz(f(Vec2(u, v))), 1.0f, texel(out, x, y, 0), 4);
  }
}

static void transmittanceRow(const ::welkin::law::AtmosphereParams& scalar, int y, Table& out) {
  const law::AtmosphereParams air = convert(scalar);
  fillRow(y, out, [&](const Vec2& uv) { return law::transmittanceTexel(air, uv); });
}

static void multiScatteringRow(const ::welkin::law::AtmosphereParams& scalar, const TextureView& transmittance, int y,
                               Table& out) {
  const law::AtmosphereParams air = convert(scalar);
  fillRow(y, out, [&](const Vec2& uv) { return law::multiScatteringTexel(transmittance, air, uv); });
}

static void skyViewRow(const SkyParams& scalar, const AirTables& tables, int y, Table& out) {
  const auto p = std::bit_cast<Params>(scalar);
  const TextureView t = tables.transmittance.view(), m = tables.multiScattering.view();
  fillRow(y, out, [&](const Vec2& uv) { return law::skyViewTexel(t, m, p.air, p.preetham, p.gradient, uv); });
}

static void aerialRow(const SkyParams& scalar, const AirTables& tables, int y, Table& inscatter, Table& transmittance) {
  const auto p = std::bit_cast<Params>(scalar);
  const TextureView t = tables.transmittance.view(), m = tables.multiScattering.view();
  const auto width = static_cast<std::size_t>(inscatter.width);
  const Real v((static_cast<float>(y) + 0.5f) / static_cast<float>(inscatter.height));
  for (std::size_t x = 0; x < width; x += law::laneCount()) {
    const Vec2 uv((lanes(x) + 0.5f) / static_cast<float>(width), v);
    Vec3 radiance(0.0f), through(1.0f);
    for (int z = 0; z < inscatter.depth; ++z) {
      law::aerialTexel(t, m, p.air, uv, z, radiance, through);
      store(law::aerialStored(p.air, z, radiance), 1.0f, texel(inscatter, x, y, z), 4);
      store(through, 1.0f, texel(transmittance, x, y, z), 4);
    }
  }
}

static void radiances(const SkyParams& scalar, const AirTables& tables, int steps, const float* elevations,
                      const float* cosSuns, std::size_t count, float* out) {
  const auto p = std::bit_cast<Params>(scalar);
  const TextureView t = tables.transmittance.view(), m = tables.multiScattering.view();
  for (std::size_t i = 0; i < count; i += law::laneCount()) {
    const Real elevation = hn::LoadU(D(), elevations + i), cosSun = hn::LoadU(D(), cosSuns + i);
    const law::Mask above = elevation > Real(-10.0f);
    store(law::skyRadiance(t, m, p.air, p.preetham, p.gradient, elevation, cosSun, above, steps), 1.0f, out + 3 * i, 3);
  }
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(transmittanceRow);
HWY_EXPORT(multiScatteringRow);
HWY_EXPORT(skyViewRow);
HWY_EXPORT(aerialRow);
HWY_EXPORT(radiances);

namespace bake {
void transmittanceRow(const law::AtmosphereParams& air, int y, Table& out) {
  HWY_DYNAMIC_DISPATCH(transmittanceRow)(air, y, out);
}
void multiScatteringRow(const law::AtmosphereParams& air, const TextureView& transmittance, int y, Table& out) {
  HWY_DYNAMIC_DISPATCH(multiScatteringRow)(air, transmittance, y, out);
}
void skyViewRow(const SkyParams& params, const AirTables& air, int y, Table& out) {
  HWY_DYNAMIC_DISPATCH(skyViewRow)(params, air, y, out);
}
void aerialRow(const SkyParams& params, const AirTables& air, int y, Table& inscatter, Table& transmittance) {
  HWY_DYNAMIC_DISPATCH(aerialRow)(params, air, y, inscatter, transmittance);
}
void radiances(const SkyParams& params, const AirTables& air, int steps, const float* elevations, const float* cosSuns,
               std::size_t count, float* out) {
  HWY_DYNAMIC_DISPATCH(radiances)(params, air, steps, elevations, cosSuns, count, out);
}
}  // namespace bake
}  // namespace welkin
#endif
