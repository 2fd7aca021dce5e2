#pragma once
#include "welkin/atmosphere/tables.hpp"
#include "welkin/gl/objects.hpp"
namespace welkin::realtime {
class SkyTables {
 public:
  explicit SkyTables(const gl::Api& gl) : gl_(gl) {}
  void update(const Atmosphere& a, const glm::vec3& sun, double altitude, const glm::vec3& albedo) {
    t_ = bakeSky(a, sun, altitude, albedo);
    auto up = [&](const Table& t, const gl::Format& f) {
      return gl::Texture(gl_, t.depth > 1 ? gl::Texture::Kind::volume : gl::Texture::Kind::plane, f, t.width, t.height, t.depth, gl::Filter::linear, gl::Addressing::clamp, t.texels.data());
    };
    tr_ = up(t_.air.transmittance, gl::kRgba16F); ms_ = up(t_.air.multiScattering, gl::kRgba16F); sv_ = up(t_.skyView, gl::kRgba16F);
    ai_ = up(t_.aerialInscatter, gl::kRgba16F); at_ = up(t_.aerialTransmittance, gl::kRgba16F);
  }
  const gl::Texture& transmittance() const { return tr_; }
  const gl::Texture& multiScattering() const { return ms_; }
  const gl::Texture& skyView() const { return sv_; }
  const gl::Texture& aerialInscatter() const { return ai_; }
  const gl::Texture& aerialTransmittance() const { return at_; }
  const SkyParams& params() const { return t_.params; }
  const SkyLight& light() const { return t_.light; }
 private:
  const gl::Api& gl_;
  SkyTablesCpu t_;
  gl::Texture tr_, ms_, sv_, ai_, at_;
};
}
