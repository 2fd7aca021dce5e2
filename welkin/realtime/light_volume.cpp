#include "welkin/realtime/light_volume.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/density/params.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

constexpr double kLeash = 0.08;       // share of a level's edge that the camera may move before it is made again
constexpr float kSunTurn = 0.003f;    // rad that the sun may turn before
constexpr float kSunJump = 0.02f;     // rad after which nothing known of its light is of use
constexpr double kAgeing = 20.0;      // s in which noise that drifts at a speed of its own has moved
constexpr float kLeastSlant = 0.03f;  // a sun that is lower shines as from here
// Steps of relaxation of a level that starts from the coarser one, and of one that knew most of its light.
constexpr int kFirstSteps = 8, kNextSteps = 3;
// Sunlight that has been turned aside once or twice, counted as light without direction by this share: see
// march_params.cpp.
constexpr float kBeam = 0.17f;
constexpr GLuint kBlockBinding = 3;
constexpr int kUnits = 10;  // the first texture unit of these passes; those before it hold the clouds

gl::Program pass(const gl::Api& gl, const std::string& name) {
  const std::string path = "welkin/realtime/shaders/" + name + ".frag.glsl";
  gl::Program program(gl, name, "", std::string(shaderSource(path)), shaderSource);
  program.bindBlock("Volume", kBlockBinding);
  return program;
}

}  // namespace

LightVolume::LightVolume(const gl::Api& gl, QualityPreset preset)
    : gl_(gl), preset_(preset), sunPass_(pass(gl, "light_sun")), startPass_(pass(gl, "light_start")),
      diffusionPass_(pass(gl, "light_diffusion")), columnPass_(pass(gl, "light_column")), block_(gl) {
  const bool small = preset == QualityPreset::low || preset == QualityPreset::medium;
  extent_ = {small ? 64 : 120, small ? 3 : 4, 12000.0, small ? 4.0 : 2.6};
  slices_ = small ? 20 : 32;
  levels_.resize(static_cast<std::size_t>(extent_.levels));
  const auto volume = [&](const gl::Format& format, int levels) {
    return gl::Texture(gl, gl::Texture::Kind::volume, format, extent_.texels, extent_.texels, slices_ * levels,
                       gl::Filter::linear, gl::Addressing::clamp, nullptr);
  };
  const auto plane = [&](const gl::Format& format) {
    return gl::Texture(gl, gl::Texture::Kind::plane, format, extent_.texels, extent_.texels, 0, gl::Filter::linear,
                       gl::Addressing::clamp, nullptr);
  };
  density_ = volume(gl::kRg16F, 1);
  sheets_ = plane(gl::kRgba16F);
  sun_ = volume(gl::kR16F, extent_.levels);
  diffuse_ = volume(gl::kRg16F, extent_.levels);
  share_ = volume(gl::kR16F, 1);
  steps_ = volume(gl::kR16F, 1);
  scalarSlice_ = {plane(gl::kR16F), plane(gl::kR16F)};
  lightSlice_ = {plane(gl::kRg16F), plane(gl::kRg16F)};
}

std::vector<std::pair<const char*, const gl::Texture*>> LightVolume::textures() const {
  return {{"light volume: sun", &sun_},
          {"light volume: diffuse", &diffuse_},
          {"light volume: density", &density_},
          {"light volume: sheets", &sheets_},
          {"light volume: share", &share_},
          {"light volume: steps", &steps_},
          {"light volume: slice a", &scalarSlice_[0]},
          {"light volume: slice b", &scalarSlice_[1]},
          {"light volume: light slice a", &lightSlice_[0]},
          {"light volume: light slice b", &lightSlice_[1]}};
}

law::LightVolumeParams LightVolume::place(const glm::dvec2& position, const Drift& drift, const Shell& shell,
                                          const glm::vec3& sunDirection, int scene) {
  const bool sameClouds = scene == scene_ && shell.bottom == shell_.bottom && shell.top == shell_.top;
  const float turned = glm::distance(sunDirection, sunward_);
  if (!sameClouds || turned > kSunTurn || std::abs(drift.time - time_) > kAgeing) {
    for (Level& level : levels_) {
      level.fresh = false;
      level.known = level.known && sameClouds && turned < kSunJump;
    }
    scene_ = scene;
    shell_ = shell;
    sunward_ = sunDirection;
    time_ = drift.time;
  }
  inAir_ = position - driftOffset(drift);
  params_ = {};
  params_.levels.count = extent_.levels;
  params_.bottom = shell.bottom;
  params_.inverseHeight = 1.0f / (shell.top - shell.bottom);
  params_.slices = static_cast<float>(slices_);
  const float rise = (shell.top - shell.bottom) / static_cast<float>(slices_);
  params_.shift = glm::vec4(glm::vec2(sunward_) * (rise / std::max(sunward_.z, kLeastSlant)),
                            static_cast<float>(1.0 / kPlanetRadius), static_cast<float>(extent_.texels));
  params_.inverseDepth = 1.0f / static_cast<float>(sun_.depth());
  for (int i = 0; i < extent_.levels; ++i) {
    Level& level = levels_[static_cast<std::size_t>(i)];
    const glm::dvec2 away = glm::abs(inAir_ - level.centre);
    if (!level.fresh || std::max(away.x, away.y) > kLeash * extent_.edge(i)) {
      level.centre = levelCentre(extent_, i, inAir_);
      level.fresh = false;
    }
    levelOf(params_.levels, i) = clipLevel(extent_, i, inAir_ - level.centre);
  }
  return params_;
}

bool LightVolume::stale() const {
  return std::any_of(levels_.begin(), levels_.end(), [](const Level& level) { return !level.fresh; });
}

glm::vec4 LightVolume::square(const glm::dvec2& centre, int level, float w) const {
  return {glm::vec2(centre - inAir_), static_cast<float>(extent_.edge(level)), w};
}

void LightVolume::draw(const gl::Program& density, const gl::Program& sheets, const glm::vec4& sheetHeights,
                       gl::Framebuffer& framebuffer) {
  block_.upload(&params_, sizeof params_);
  block_.bind(kBlockBinding);
  for (int i = extent_.levels - 1; i >= 0; --i) {
    Level& level = levels_[static_cast<std::size_t>(i)];
    if (level.fresh) continue;
    fillDensity(density, framebuffer, i);
    if (sheets.id()) fillSheets(sheets, framebuffer, i);
    fillSun(sheets.id() ? sheetHeights : glm::vec4(-1e9f), framebuffer, i);
    fillDiffuse(framebuffer, i);
    level.fresh = level.known = true;
    level.before = level.centre;
  }
}

void LightVolume::use(const gl::Program& program, int level) {
  gl_.UseProgram(program.id());
  const glm::vec4 place =
      square(levels_[static_cast<std::size_t>(level)].centre, level, static_cast<float>(extent_.texels));
  gl_.Uniform4f(program.uniform("uLevel"), place.x, place.y, place.z, place.w);
  gl_.Uniform1i(program.uniform("uFirst"), level * slices_);
  bind(program, "uDensity", density_, kUnits);
  bind(program, "uSun", sun_, kUnits + 1);
  bind(program, "uDiffuse", diffuse_, kUnits + 2);
}

void LightVolume::bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(texture.target(), texture.id());
  gl_.Uniform1i(program.uniform(name), unit);
}

void LightVolume::slice(const gl::Program& program, int number) const {
  const float height = (shell_.top - shell_.bottom) / static_cast<float>(slices_);
  gl_.Uniform3f(program.uniform("uSlice"), shell_.bottom + (static_cast<float>(number) + 0.5f) * height, height,
                static_cast<float>(number));
}

// What the framebuffer's target of that number shows goes into a slice of a volume.
void LightVolume::copy(int target, const gl::Texture& to, int slice) const {
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(target));
  gl_.ActiveTexture(GL_TEXTURE0 + kUnits + 5);
  gl_.BindTexture(to.target(), to.id());
  gl_.CopyTexSubImage3D(to.target(), 0, 0, 0, slice, 0, 0, extent_.texels, extent_.texels);
}

void LightVolume::fillDensity(const gl::Program& program, gl::Framebuffer& framebuffer, int level) {
  use(program, level);
  for (int s = 0; s < slices_; ++s) {
    slice(program, s);
    const gl::Texture* const targets[] = {&density_};
    framebuffer.target(targets, s);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

// The sun's direction as these passes take it.
void LightVolume::sunUniform(const gl::Program& program) const {
  gl_.Uniform4f(program.uniform("uSunward"), sunward_.x, sunward_.y, sunward_.z, kLeastSlant);
}

void LightVolume::fillSheets(const gl::Program& program, gl::Framebuffer& framebuffer, int level) {
  use(program, level);
  sunUniform(program);
  gl_.Uniform1f(program.uniform("uTop"), shell_.top);
  const gl::Texture* const targets[] = {&sheets_};
  framebuffer.target(targets);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LightVolume::fillSun(const glm::vec4& sheetHeights, gl::Framebuffer& framebuffer, int level) {
  use(sunPass_, level);
  bind(sunPass_, "uSheets", sheets_, kUnits + 4);
  gl_.Uniform4f(sunPass_.uniform("uSheetHeights"), sheetHeights.x, sheetHeights.y, sheetHeights.z, sheetHeights.w);
  const float height = shell_.top - shell_.bottom, slice = height / static_cast<float>(slices_);
  const float edge = static_cast<float>(extent_.edge(level)), texel = edge / static_cast<float>(extent_.texels);
  const float rise = std::max(sunward_.z, kLeastSlant), across = std::max(glm::length(glm::vec2(sunward_)), 1e-3f);
  const float step = std::min(slice / rise, texel / across);
  const float longest = std::min(height / rise, 1.42f * edge / across);
  const int doublings = static_cast<int>(std::ceil(std::log2(std::max(longest / step, 2.0f))));
  sunUniform(sunPass_);
  gl_.Uniform1i(sunPass_.uniform("uCoarsest"), level == extent_.levels - 1 ? 1 : 0);
  for (int i = 0; i <= doublings; ++i) {
    const bool last = i == doublings;
    gl_.Uniform2f(sunPass_.uniform("uWay"), i == 0 ? 0.0f : std::ldexp(step, i - 1), step);
    gl_.Uniform1i(sunPass_.uniform("uLast"), last ? 1 : 0);
    const gl::Texture &from = i % 2 == 0 ? share_ : steps_, &to = i % 2 == 0 ? steps_ : share_;
    bind(sunPass_, "uSteps", from, kUnits + 3);
    for (int s = 0; s < slices_; ++s) {
      this->slice(sunPass_, s);
      const gl::Texture* const targets[] = {last ? &scalarSlice_[0] : &to};
      framebuffer.target(targets, last ? 0 : s);
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
      if (last) copy(0, sun_, level * slices_ + s);
    }
  }
}

void LightVolume::fillDiffuse(gl::Framebuffer& framebuffer, int level) {
  const Level& now = levels_[static_cast<std::size_t>(level)];
  const bool coarsest = level == extent_.levels - 1;
  const int first = level * slices_;
  use(startPass_, level);
  const glm::vec4 before = square(now.before, level, now.known ? 1.0f : 0.0f);
  const glm::vec4 coarser =
      coarsest ? glm::vec4(0, 0, 1, 0) : square(levels_[static_cast<std::size_t>(level) + 1].centre, level + 1, 1.0f);
  gl_.Uniform4f(startPass_.uniform("uBefore"), before.x, before.y, before.z, before.w);
  gl_.Uniform4f(startPass_.uniform("uCoarser"), coarser.x, coarser.y, coarser.z, coarser.w);
  const gl::Texture* const only[] = {&lightSlice_[0]};
  framebuffer.target(only);
  for (int s = 0; s < slices_; ++s) {
    slice(startPass_, s);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    copy(0, diffuse_, first + s);
  }
  const int steps = now.known ? kNextSteps : kFirstSteps;
  for (int step = 0; step < steps; ++step) {
    use(diffusionPass_, level);
    gl_.Uniform1f(diffusionPass_.uniform("uSideways"), coarsest && !now.known && step == 0 ? 0.0f : 1.0f);
    for (int s = slices_ - 1; s >= 0; --s) {
      const auto turn = static_cast<std::size_t>(s & 1);
      slice(diffusionPass_, s);
      bind(diffusionPass_, "uLightAbove", lightSlice_[1 - turn], kUnits + 3);
      bind(diffusionPass_, "uShareAbove", scalarSlice_[1 - turn], kUnits + 4);
      const gl::Texture* const targets[] = {&lightSlice_[turn], &scalarSlice_[turn]};
      framebuffer.target(targets);
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
      copy(0, diffuse_, first + s);
      copy(1, share_, s);
    }
    use(columnPass_, level);
    bind(columnPass_, "uShare", share_, kUnits + 4);
    gl_.Uniform1f(columnPass_.uniform("uBeam"), step == steps - 1 ? kBeam : 0.0f);
    for (int s = 0; s < slices_; ++s) {
      const auto turn = static_cast<std::size_t>(s & 1);
      slice(columnPass_, s);
      bind(columnPass_, "uBelow", lightSlice_[1 - turn], kUnits + 3);
      const gl::Texture* const targets[] = {&lightSlice_[turn]};
      framebuffer.target(targets);
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
      copy(0, diffuse_, first + s);
    }
  }
}

}  // namespace welkin::realtime
