#include "welkin/realtime/sky_tables.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

constexpr GLuint kSkyBlock = 0;

gl::Program skyPass(const gl::Api& gl, const std::string& name) {
  const std::string path = "welkin/realtime/shaders/" + name + ".frag.glsl";
  gl::Program program(gl, name, "", shaderText(path), shaderSource);
  program.bindBlock("SkyBlock", kSkyBlock);
  return program;
}

gl::Texture plane(const gl::Api& gl, const gl::Format& format, float width, float height,
                  const void* texels = nullptr) {
  return gl::Texture(gl, gl::Texture::Kind::plane, format, static_cast<int>(width), static_cast<int>(height), 0,
                     gl::Filter::linear, gl::Addressing::clamp, texels);
}

gl::Texture sum(const gl::Api& gl) {
  return gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba32F, static_cast<int>(law::kAerialWidth),
                     static_cast<int>(law::kAerialHeight), 0, gl::Filter::nearest, gl::Addressing::clamp, nullptr);
}

gl::Texture volume(const gl::Api& gl) {
  return gl::Texture(gl, gl::Texture::Kind::volume, gl::kRgba16F, static_cast<int>(law::kAerialWidth),
                     static_cast<int>(law::kAerialHeight), static_cast<int>(law::kAerialDepth), gl::Filter::linear,
                     gl::Addressing::clamp, nullptr);
}

// The air without the sun and the camera.
law::AtmosphereParams airOnly(law::AtmosphereParams air) {
  air.sunDirection = glm::vec4(0, 0, 1, air.sunDirection.w);
  air.sunHeading = air.sunIrradiance = air.secondDirection = air.secondIrradiance = glm::vec4(0);
  air.cameraAltitude = air.horizonElevation = air.radianceScale = air.aerialRange = 0;
  air.skyKind = 0;
  return air;
}

template <class T>
bool sameBytes(const T& a, const T& b) {
  using Words = std::array<std::uint32_t, sizeof(T) / 4>;
  return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

}  // namespace

struct SkyTables::Input {
  const char* name;
  const gl::Texture* texture;
};

SkyTables::SkyTables(const gl::Api& gl)
    : gl_(gl), framebuffer_(gl), vertices_(gl), block_(gl), transmittancePass_(skyPass(gl, "sky_transmittance")),
      multiScatteringPass_(skyPass(gl, "sky_multi_scattering")), skyViewPass_(skyPass(gl, "sky_view")),
      aerialPass_(skyPass(gl, "sky_aerial")),
      transmittance_(plane(gl, gl::kRgba16F, law::kTransmittanceWidth, law::kTransmittanceHeight)),
      multiScattering_(plane(gl, gl::kRgba16F, law::kMultiScatteringSize, law::kMultiScatteringSize)),
      skyView_(plane(gl, gl::kRgba16F, law::kSkyViewWidth, law::kSkyViewHeight)), aerialInscatter_(volume(gl)),
      aerialTransmittance_(volume(gl)), inscatterSum_{sum(gl), sum(gl)}, throughSum_{sum(gl), sum(gl)} {}

void SkyTables::update(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                       const AirSurface& surface, const SkyModel* user) {
  // A camera or sun that has hardly moved keeps the tables as they are.
  const double before = params_.air.cameraAltitude;
  const bool sameAltitude = skyFills_ > 0 && std::abs(cameraAltitude - before) <= std::max(2.0, 0.005 * before);
  const bool sameSun =
      skyFills_ > 0 && glm::distance(lights.light.direction, glm::vec3(params_.air.sunDirection)) < 1e-5f;
  SkyLights kept = lights;
  if (sameSun) kept.light.direction = glm::vec3(params_.air.sunDirection);
  SkyParams next = makeSkyParams(atmosphere, kept, sameAltitude ? before : cameraAltitude, surface);
  const std::uint64_t revision = user ? user->revision() : 0;
  const bool airChanged = airFills_ == 0 || !sameBytes(airOnly(next.air), airOnly(params_.air));
  if (!airChanged && skyFills_ > 0 && sameBytes(next, params_) && user == user_ && revision == userRevision_) return;

  params_ = next;
  user_ = user;
  userRevision_ = revision;
  block_.upload(&params_, sizeof(params_));
  block_.bind(kSkyBlock);
  gl_.BindVertexArray(vertices_.id());
  if (airChanged) fillAir();
  fillSky(user);
  fillAerial();
  light_ = computeSkyLight(params_, air_, user);
  gl_.check("filling the sky's tables");
}

void SkyTables::use(const gl::Program& program, std::span<const Input> inputs) const {
  gl_.UseProgram(program.id());
  GLint unit = 0;
  for (const Input& input : inputs) {
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_.BindTexture(input.texture->target(), input.texture->id());
    gl_.Uniform1i(program.uniform(input.name), unit++);
  }
}

void SkyTables::draw(std::span<const gl::Texture* const> targets, int layer) {
  framebuffer_.target(targets, layer);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void SkyTables::fillAir() {
  air_ = bakeAir(params_.air);
  const gl::Texture* targets[] = {&transmittance_};
  use(transmittancePass_, {});
  draw(targets);
  const Input inputs[] = {{"uTransmittance", &transmittance_}};
  targets[0] = &multiScattering_;
  use(multiScatteringPass_, inputs);
  draw(targets);
  ++airFills_;
}

void SkyTables::fillSky(const SkyModel* user) {
  ++skyFills_;
  if (user) {
    gl_.ActiveTexture(GL_TEXTURE0);
    skyView_ = plane(gl_, gl::kRgba16F, law::kSkyViewWidth, law::kSkyViewHeight,
                     bakeSkyView(params_, air_, user).texels.data());
    return;
  }
  const Input inputs[] = {{"uTransmittance", &transmittance_}, {"uMultiScattering", &multiScattering_}};
  const gl::Texture* const targets[] = {&skyView_};
  use(skyViewPass_, inputs);
  draw(targets);
}

void SkyTables::fillAerial() {
  for (int slice = 0; slice < aerialInscatter_.depth(); ++slice) {
    const int now = slice & 1, before = 1 - now;
    const Input inputs[] = {{"uTransmittance", &transmittance_},
                            {"uMultiScattering", &multiScattering_},
                            {"uInscatterBefore", &inscatterSum_[before]},
                            {"uThroughBefore", &throughSum_[before]}};
    use(aerialPass_, inputs);
    gl_.Uniform1i(aerialPass_.uniform("uSlice"), slice);
    const gl::Texture* const targets[] = {&aerialInscatter_, &aerialTransmittance_, &inscatterSum_[now],
                                          &throughSum_[now]};
    draw(targets, slice);
  }
}

std::size_t SkyTables::bytes() const {
  std::size_t total = 0;
  for (const gl::Texture* t : {&transmittance_, &multiScattering_, &skyView_, &aerialInscatter_, &aerialTransmittance_,
                               &inscatterSum_[0], &inscatterSum_[1], &throughSum_[0], &throughSum_[1]})
    total += t->bytes();
  return total;
}

}  // namespace welkin::realtime
