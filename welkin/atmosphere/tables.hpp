#pragma once
// The tables of a sky, on the CPU: `computeX` is exact and slow, `bakeX` fills a table, the law's `lookupX` reads it.
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/atmosphere/params.hpp"
#include "welkin/base/sampler.hpp"

namespace welkin {

// A table of four float channels; `depth` 1 for a plane.
struct Table {
  int width = 0, height = 0, depth = 1;
  std::vector<float> texels;

  Table() = default;
  Table(int w, int h, int d) : width(w), height(h), depth(d), texels(static_cast<std::size_t>(w) * h * d * 4) {}
  TextureView view() const { return {texels.data(), width, height, depth, 4, Wrap::clamp, Wrap::clamp}; }
};

// A sky model of the library's user. The table that holds it is symmetric about the sun's vertical plane: each texel is
// the mean of the two sides.
class SkyModel {
 public:
  virtual ~SkyModel() = default;
  // Radiance (linear Rec.709, kcd/m^2) from a unit direction at or above the camera's horizon; called on many threads.
  virtual glm::vec3 radiance(const glm::vec3& direction) const = 0;
  // Another number after every change of what radiance() answers, so that tables are filled anew.
  virtual std::uint64_t revision() const { return 0; }
};

// What depends on the air alone.
struct AirTables {
  Table transmittance;    // 256 x 64
  Table multiScattering;  // 32 x 32
};

// All uniform values of one sky.
struct SkyParams {
  law::AtmosphereParams air;
  law::PreethamParams preetham;
  law::GradientParams gradient;
};
SkyParams makeSkyParams(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                        const AirSurface& surface = {});

// The sky's light for things that are lit by all of it.
struct SkyLight {
  glm::vec3 skyIrradiance{0.0f};  // on an upward-facing plane at the camera, klx, without the sun
  glm::vec3 meanRadiance{0.0f};   // mean over the upper half of the sphere, kcd/m^2
  glm::vec3 sunIrradiance{0.0f};  // on a plane facing the sun at the camera, klx
};

struct SkyTablesCpu {
  SkyParams params;
  AirTables air;
  Table skyView;              // 96 x 128
  Table aerialInscatter;      // 32 x 64 x 32
  Table aerialTransmittance;  // 32 x 64 x 32
  SkyLight light;
};

// Transmittance to space in double precision, to about 1e-7. The ray does not meet the ground.
glm::dvec3 computeTransmittance(const law::AtmosphereParams& air, double altitude, double cosZenith);

// What the tables of sky view hold, with 500 steps along the ray, from the same two tables of the air (kcd/m^2).
glm::vec3 computeSkyRadiance(const SkyParams& params, const AirTables& air, const glm::vec3& direction);

AirTables bakeAir(const law::AtmosphereParams& air);
Table bakeSkyView(const SkyParams& params, const AirTables& air, const SkyModel* user = nullptr);
void bakeAerial(const SkyParams& params, const AirTables& air, Table& inscatter, Table& transmittance);

// By 16 x 24 directions with 24 steps each: good to about 1 per cent, a few hundred microseconds.
SkyLight computeSkyLight(const SkyParams& params, const AirTables& air, const SkyModel* user = nullptr);

// All tables of a sky. `user`, when given, paints the sky above the horizon in place of atmosphere.model.
SkyTablesCpu bakeSky(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                     const AirSurface& surface = {}, const SkyModel* user = nullptr);
SkyTablesCpu bakeSky(const Atmosphere& atmosphere, const Sun& sun, double cameraAltitude,
                     const AirSurface& surface = {}, const SkyModel* user = nullptr);

}  // namespace welkin
