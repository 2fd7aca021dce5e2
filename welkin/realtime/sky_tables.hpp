#pragma once
// The sky's tables on the GPU. Like gl/objects.hpp, for .cpp files only.
#include <cstddef>
#include <cstdint>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::realtime {

// Owns and fills the tables that the law's lookupTransmittance, lookupSky and lookupAerial read: 1.5 MB in all. It
// touches the current framebuffer, viewport, program, vertex array, texture units 0 to 3 and uniform buffer binding 0,
// and expects blending, tests and masks as a full-screen pass needs them.
class SkyTables {
 public:
  explicit SkyTables(const gl::Api& gl);

  // Renders what has changed: the air's tables for new air, the others for a new sun, altitude (by more than 2 m and
  // 0.5 per cent), sky model or ground. `user`, when given, paints the sky in place of atmosphere.model.
  void update(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
              const AirSurface& surface = {}, const SkyModel* user = nullptr);

  // The uniform values that the tables were made with: lookups take these, not newer ones.
  const SkyParams& params() const { return params_; }
  const SkyLight& light() const { return light_; }
  // The air's tables on the CPU, for the sun's light at any altitude.
  const AirTables& air() const { return air_; }

  // std140: AtmosphereParams, PreethamParams, GradientParams. A block that holds only the first may be bound to it.
  const gl::UniformBuffer& block() const { return block_; }
  const gl::Texture& transmittance() const { return transmittance_; }
  const gl::Texture& multiScattering() const { return multiScattering_; }
  const gl::Texture& skyView() const { return skyView_; }
  const gl::Texture& aerialInscatter() const { return aerialInscatter_; }
  const gl::Texture& aerialTransmittance() const { return aerialTransmittance_; }
  std::size_t bytes() const;

  // How often update() has filled the air's tables and the others.
  int airFills() const { return airFills_; }
  int skyFills() const { return skyFills_; }

 private:
  struct Input;
  void use(const gl::Program& program, std::span<const Input> inputs) const;
  void draw(std::span<const gl::Texture* const> targets, int layer = 0);
  void fillAir();
  void fillSky(const SkyModel* user);
  void fillAerial();

  const gl::Api& gl_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray vertices_;
  gl::UniformBuffer block_;
  gl::Program transmittancePass_, multiScatteringPass_, skyViewPass_, aerialPass_;
  gl::Texture transmittance_, multiScattering_, skyView_, aerialInscatter_, aerialTransmittance_;
  gl::Texture inscatterSum_[2], throughSum_[2];
  SkyParams params_{};
  AirTables air_;
  SkyLight light_;
  const SkyModel* user_ = nullptr;
  std::uint64_t userRevision_ = 0;
  int airFills_ = 0, skyFills_ = 0;
};

}  // namespace welkin::realtime
