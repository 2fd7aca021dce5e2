#include "welkin/realtime/light_volume.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/density/params.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

constexpr float kSunTurn = 0.003f;    // rad that the sun may turn before
constexpr float kSunJump = 0.02f;     // rad after which nothing known of its light is of use
constexpr float kStretch = 0.1f;      // share of the shell's height by which it may change and leave the light of use
constexpr double kAgeing = 20.0;      // s in which noise that drifts at a speed of its own has moved
constexpr float kLeastSlant = 0.03f;  // a sun that is lower shines as from here
// Steps of relaxation of the coarsest level, of one that starts from the coarser one, and of one that knew most of its
// light.
constexpr int kCoarsestSteps = 8, kFinerSteps = 4, kNextSteps = 3;
// What one slice of each pass costs, in proportion (llvmpipe).
constexpr double kDensityWork = 6.0, kSunWork = 1.0, kStartWork = 0.5, kDownWork = 2.0, kUpWork = 1.0, kCopyWork = 0.4;
constexpr GLuint kBlockBinding = 3;
constexpr int kUnits = 10;  // the first texture unit of these passes; those before it hold the clouds

gl::Program lightPass(const gl::Api& gl, const std::string& name) {
  const std::string path = "welkin/realtime/shaders/" + name + ".frag.glsl";
  gl::Program program(gl, name, "", shaderText(path), shaderSource);
  program.bindBlock("Volume", kBlockBinding);
  return program;
}

}  // namespace

LightVolume::LightVolume(const gl::Api& gl, QualityPreset preset)
    : gl_(gl), preset_(preset), sunPass_(lightPass(gl, "light_sun")), startPass_(lightPass(gl, "light_start")),
      diffusionPass_(lightPass(gl, "light_diffusion")), columnPass_(lightPass(gl, "light_column")),
      belowPass_(lightPass(gl, "light_below")), groundPass_(lightPass(gl, "light_ground")),
      facesPass_(lightPass(gl, "light_faces")), sidesPass_(lightPass(gl, "light_sides")), block_(gl) {
  const bool small = preset == QualityPreset::low || preset == QualityPreset::medium;
  extent_ = {small ? 64 : 120, small ? 3 : 4, 12000.0, small ? 4.0 : 2.6};
  slices_ = small ? 19 : 30;
  levels_.resize(static_cast<std::size_t>(extent_.levels));
  const auto volume = [&](const gl::Format& format, int levels) {
    return gl::Texture(gl, gl::Texture::Kind::volume, format, extent_.texels, extent_.texels, slices_ * levels,
                       gl::Filter::linear, gl::Addressing::clamp, nullptr);
  };
  const auto plane = [&](const gl::Format& format) {
    return gl::Texture(gl, gl::Texture::Kind::plane, format, extent_.texels, extent_.texels, 0, gl::Filter::linear,
                       gl::Addressing::clamp, nullptr);
  };
  sun_ = volume(gl::kR16F, extent_.levels);
  diffuse_ = volume(gl::kRg16F, extent_.levels);
  below_ = gl::Texture(gl, gl::Texture::Kind::volume, gl::kRg16F, extent_.texels, extent_.texels, extent_.levels,
                       gl::Filter::linear, gl::Addressing::clamp, nullptr);
  density_ = volume(gl::kRg16F, 1);
  steps_ = volume(gl::kR16F, 1);
  share_ = volume(gl::kR16F, 1);
  light_ = volume(gl::kRg16F, 1);
  scalarSlice_ = {plane(gl::kR16F), plane(gl::kR16F)};
  lightSlice_ = {plane(gl::kRg16F), plane(gl::kRg16F)};
  for (gl::Texture* row : {&faces_, &sides_})
    *row = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba16F, slices_, 1, 0, gl::Filter::nearest,
                       gl::Addressing::clamp, nullptr);
}

std::vector<std::pair<const char*, const gl::Texture*>> LightVolume::textures() const {
  return {{"light volume: sun", &sun_},
          {"light volume: diffuse", &diffuse_},
          {"light volume: below", &below_},
          {"light volume: density", &density_},
          {"light volume: sheets", &sheets_},
          {"light volume: steps", &steps_},
          {"light volume: share", &share_},
          {"light volume: light", &light_},
          {"light volume: faces", &faces_},
          {"light volume: sides", &sides_},
          {"light volume: slice a", &scalarSlice_[0]},
          {"light volume: slice b", &scalarSlice_[1]},
          {"light volume: light slice a", &lightSlice_[0]},
          {"light volume: light slice b", &lightSlice_[1]}};
}

void LightVolume::place(const glm::dvec2& position, const Drift& drift, const Shell& shell,
                        const glm::vec3& sunDirection, int scene) {
  const bool sameShell = shell.bottom == shell_.bottom && shell.top == shell_.top;
  if (!sameShell) {
    // All levels are stretched to it, and what is half made was made for another one.
    const float moved = std::max(std::abs(shell.bottom - shell_.bottom), std::abs(shell.top - shell_.top));
    if (moved > kStretch * (shell_.top - shell_.bottom)) forget();
    shell_ = shell;
    job_.reset();
  }
  if (!sameShell || scene != scene_ || glm::distance(sunDirection, wanted_.sunward) > kSunJump) ++wanted_.version;
  scene_ = scene;
  inAir_ = position - driftOffset(drift);
  wanted_.sunward = sunDirection;
  wanted_.time = drift.time;
}

void LightVolume::forget() {
  for (Level& level : levels_) level.shown = false;
  job_.reset();
}

double LightVolume::away(int level) const {
  const glm::dvec2 way = glm::abs(inAir_ - levels_[static_cast<std::size_t>(level)].centre);
  return std::max(way.x, way.y) / extent_.edge(level);
}

bool LightVolume::useless(int level) const {
  return !levels_[static_cast<std::size_t>(level)].shown || away(level) > kUseless;
}

bool LightVolume::outOfDate(int level) const {
  const Level& has = levels_[static_cast<std::size_t>(level)];
  return useless(level) || away(level) > kLeash || has.version != wanted_.version ||
         glm::distance(has.sunward, wanted_.sunward) > kSunTurn || std::abs(has.time - wanted_.time) > kAgeing;
}

bool LightVolume::stale() const {
  for (int i = 0; i < extent_.levels; ++i)
    if (outOfDate(i)) return true;
  return job_.has_value();
}

bool LightVolume::lost(bool standIn) const {
  for (int i = standIn ? extent_.levels - 1 : 0; i < extent_.levels; ++i)
    if (useless(i)) return true;
  return false;
}

law::LightVolumeParams LightVolume::params() const {
  law::LightVolumeParams p{};
  p.levels.count = extent_.levels;
  p.bottom = shell_.bottom;
  p.inverseHeight = 1.0f / (shell_.top - shell_.bottom);
  p.slices = static_cast<float>(slices_);
  p.inverseDepth = 1.0f / static_cast<float>(sun_.depth());
  const float rise = (shell_.top - shell_.bottom) / static_cast<float>(slices_);
  const auto finest = std::find_if(levels_.begin(), levels_.end(), [](const Level& level) { return level.shown; });
  const glm::vec3& sunward = finest == levels_.end() ? wanted_.sunward : finest->sunward;
  p.shift = glm::vec4(glm::vec2(sunward) * (rise / std::max(sunward.z, kLeastSlant)),
                      static_cast<float>(1.0 / kPlanetRadius), static_cast<float>(extent_.texels));
  for (int i = 0; i < extent_.levels; ++i) {
    const Level& level = levels_[static_cast<std::size_t>(i)];
    law::ClipLevel& clip = levelOf(p.levels, i);
    clip = clipLevel(extent_, i, inAir_ - level.centre);
    if (!level.shown) clip.margin = 1.0f;  // holds nothing
  }
  return p;
}

glm::vec4 LightVolume::square(const glm::dvec2& centre, int level, float w) const {
  return {glm::vec2(centre - inAir_), static_cast<float>(extent_.edge(level)), w};
}

// The next coarser level's; w: its number, 0 when there is none.
glm::vec4 LightVolume::coarser(int level) const {
  if (level == extent_.levels - 1) return {0.0f, 0.0f, 1.0f, 0.0f};
  return square(levels_[static_cast<std::size_t>(level) + 1].centre, level + 1, static_cast<float>(level + 1));
}

// The next level in turn, from the coarsest to the finest and round again, so that none waits for ever.
LightVolume::Job LightVolume::nextJob() {
  Job job;
  job.level = last_;
  do job.level = job.level == 0 ? extent_.levels - 1 : job.level - 1;
  while (!outOfDate(job.level) && job.level != last_);
  const Level& has = levels_[static_cast<std::size_t>(job.level)];
  static_cast<Purpose&>(job) = wanted_;
  job.centre = levelCentre(extent_, job.level, inAir_);
  if (job.level + 1 < extent_.levels)
    job.version = std::min(job.version, levels_[static_cast<std::size_t>(job.level) + 1].version);
  job.known = has.shown && has.version == job.version && glm::distance(has.sunward, job.sunward) < kSunJump;
  return job;
}

void LightVolume::draw(const CloudPasses& clouds, gl::Framebuffer& framebuffer, int frames, bool standIn) {
  const auto mustNow = [&] { return lost(standIn) || (frames <= 1 && stale()); };
  if (mustNow()) {
    job_.reset();
    last_ = 0;
  }
  // A slice more than this frame's share is taken off the next one's.
  due_ = std::min(due_, 0.0) +
         slices_ * (kDensityWork + 8.0 * kSunWork + kNextSteps * (kDownWork + kUpWork)) / std::max(frames, 1);
  while (stale()) {
    const bool now = mustNow();
    if (!now && due_ <= 0.0) break;
    if (!job_) job_ = nextJob();
    const double left = go(clouds, framebuffer, now ? 1e30 : due_);
    due_ = now ? 0.0 : left;
  }
}

int LightVolume::doublings() const {
  const float height = shell_.top - shell_.bottom, edge = static_cast<float>(extent_.edge(job_->level));
  const float rise = std::max(job_->sunward.z, kLeastSlant);
  const float across = std::max(glm::length(glm::vec2(job_->sunward)), 1e-3f);
  const float longest = std::min(height / rise, 1.42f * edge / across);
  return static_cast<int>(std::ceil(std::log2(std::max(longest / firstStep(), 2.0f))));
}

// Of the way toward the sun: no longer than a cell.
float LightVolume::firstStep() const {
  const float rise = std::max(job_->sunward.z, kLeastSlant);
  const float across = std::max(glm::length(glm::vec2(job_->sunward)), 1e-3f);
  return std::min((shell_.top - shell_.bottom) / static_cast<float>(slices_) / rise,
                  static_cast<float>(extent_.edge(job_->level)) / static_cast<float>(extent_.texels) / across);
}

double LightVolume::go(const CloudPasses& clouds, gl::Framebuffer& framebuffer, double work) {
  law::LightVolumeParams params = this->params();
  levelOf(params.levels, job_->level) = clipLevel(extent_, job_->level, inAir_ - job_->centre);
  block_.upload(&params, sizeof params);
  block_.bind(kBlockBinding);
  const bool coarsest = job_->level == extent_.levels - 1;
  const int steps = job_->known ? kNextSteps : coarsest ? kCoarsestSteps : kFinerSteps, doublings = this->doublings();
  while (job_ && work > 0.0) {
    constexpr double kWork[] = {kDensityWork, kSunWork, kStartWork, kDownWork, kUpWork, kCopyWork};
    Job& job = *job_;
    const double each = kWork[static_cast<std::size_t>(job.phase)];
    // A level is shown in one go.
    const int left = slices_ - job.slice;
    const int count =
        job.phase == Phase::publish || work > each * left ? left : static_cast<int>(std::ceil(work / each));
    work -= each * count;
    const bool ends = count == left;
    switch (job.phase) {
      case Phase::density:
        fillDensity(clouds.density, framebuffer, count);
        if (ends && clouds.sheets.id()) fillSheets(clouds.sheets, framebuffer);
        if (ends) job.phase = Phase::sun;
        break;
      case Phase::sun:
        fillSun(clouds.sheets.id() ? clouds.sheetHeights : glm::vec4(-1e9f), framebuffer, count, doublings);
        if (ends && job.round++ == doublings) job.phase = Phase::start;
        break;
      case Phase::start:
        start(framebuffer, count);
        if (ends) job.phase = Phase::down, job.round = 0;
        break;
      case Phase::down:
        diffuseDown(framebuffer, count);
        if (ends) job.phase = Phase::up;
        break;
      case Phase::up:
        diffuseUp(framebuffer, count);
        if (ends) job.phase = ++job.round == steps ? Phase::publish : Phase::down;
        break;
      case Phase::publish:
        publish(framebuffer);
        return work;
    }
    job.slice = ends ? 0 : job.slice + count;
  }
  return work;
}

void LightVolume::use(const gl::Program& program) {
  gl_.UseProgram(program.id());
  const glm::vec4 place = square(job_->centre, job_->level, static_cast<float>(extent_.texels));
  gl_.Uniform4f(program.uniform("uLevel"), place.x, place.y, place.z, place.w);
  bind(program, "uDensity", density_, kUnits);
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

void LightVolume::fillDensity(const gl::Program& program, gl::Framebuffer& framebuffer, int count) {
  use(program);
  for (int s = job_->slice; s < job_->slice + count; ++s) {
    slice(program, s);
    const gl::Texture* const targets[] = {&density_};
    framebuffer.target(targets, s);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

// The sun's direction as these passes take it.
void LightVolume::sunUniform(const gl::Program& program) const {
  const glm::vec3& sunward = job_->sunward;
  gl_.Uniform4f(program.uniform("uSunward"), sunward.x, sunward.y, sunward.z, kLeastSlant);
}

void LightVolume::fillSheets(const gl::Program& program, gl::Framebuffer& framebuffer) {
  if (sheets_.width() == 0)
    sheets_ = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba16F, extent_.texels, extent_.texels, 0,
                          gl::Filter::linear, gl::Addressing::clamp, nullptr);
  use(program);
  sunUniform(program);
  gl_.Uniform1f(program.uniform("uTop"), shell_.top);
  const gl::Texture* const targets[] = {&sheets_};
  framebuffer.target(targets);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LightVolume::fillSun(const glm::vec4& sheetHeights, gl::Framebuffer& framebuffer, int count, int doublings) {
  use(sunPass_);
  const int round = job_->round;
  sunUniform(sunPass_);
  gl_.Uniform1i(sunPass_.uniform("uCoarsest"), job_->level == extent_.levels - 1 ? 1 : 0);
  gl_.Uniform2f(sunPass_.uniform("uWay"), round == 0 ? 0.0f : std::ldexp(firstStep(), round - 1), firstStep());
  gl_.Uniform1i(sunPass_.uniform("uLast"), round == doublings ? 1 : 0);
  const bool ends = (doublings - round) % 2 == 0;
  bind(sunPass_, "uSteps", ends ? share_ : steps_, kUnits + 1);
  bind(sunPass_, "uSun", sun_, kUnits + 2);
  bind(sunPass_, "uSheets", sheets_, kUnits + 3);
  gl_.Uniform4f(sunPass_.uniform("uSheetHeights"), sheetHeights.x, sheetHeights.y, sheetHeights.z, sheetHeights.w);
  for (int s = job_->slice; s < job_->slice + count; ++s) {
    slice(sunPass_, s);
    const gl::Texture* const targets[] = {ends ? &steps_ : &share_};
    framebuffer.target(targets, s);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

void LightVolume::start(gl::Framebuffer& framebuffer, int count) {
  const int level = job_->level;
  const Level& has = levels_[static_cast<std::size_t>(level)];
  use(startPass_);
  bind(startPass_, "uDiffuse", diffuse_, kUnits + 1);
  const glm::vec4 before = square(has.centre, level, job_->known ? 1.0f : 0.0f);
  const glm::vec4 coarser = this->coarser(level);
  gl_.Uniform4f(startPass_.uniform("uBefore"), before.x, before.y, before.z, before.w);
  gl_.Uniform4f(startPass_.uniform("uCoarser"), coarser.x, coarser.y, coarser.z, coarser.w);
  gl_.Uniform1i(startPass_.uniform("uFirst"), level * slices_);
  for (int s = job_->slice; s < job_->slice + count; ++s) {
    slice(startPass_, s);
    const gl::Texture* const targets[] = {&light_};
    framebuffer.target(targets, s);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

void LightVolume::draw(const gl::Program& program, gl::Framebuffer& framebuffer, const gl::Texture& plane) const {
  const gl::Texture* const targets[] = {&plane};
  framebuffer.target(targets);
  slice(program, 0);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

// What the clouds of each slice and the air between them exchange, in the mean over the level.
void LightVolume::lightBetween(gl::Framebuffer& framebuffer) {
  use(facesPass_);
  bind(facesPass_, "uDiffuse", light_, kUnits + 1);
  bind(facesPass_, "uSides", sides_, kUnits + 2);
  gl_.Uniform1f(facesPass_.uniform("uKnown"), job_->round > 0 ? 1.0f : 0.0f);
  draw(facesPass_, framebuffer, faces_);
  use(sidesPass_);
  bind(sidesPass_, "uFaces", faces_, kUnits + 1);
  draw(sidesPass_, framebuffer, sides_);
}

void LightVolume::diffuseDown(gl::Framebuffer& framebuffer, int count) {
  if (job_->slice == 0) lightBetween(framebuffer);
  use(diffusionPass_);
  bind(diffusionPass_, "uSides", sides_, kUnits + 6);
  bind(diffusionPass_, "uDiffuse", light_, kUnits + 1);
  bind(diffusionPass_, "uSun", steps_, kUnits + 2);
  const bool alone = job_->level == extent_.levels - 1 && !job_->known && job_->round == 0;
  gl_.Uniform1f(diffusionPass_.uniform("uSideways"), alone ? 0.0f : 1.0f);
  for (int done = job_->slice; done < job_->slice + count; ++done) {
    const int s = slices_ - 1 - done;
    const auto turn = static_cast<std::size_t>(s & 1);
    slice(diffusionPass_, s);
    bind(diffusionPass_, "uLightAbove", lightSlice_[1 - turn], kUnits + 3);
    bind(diffusionPass_, "uShareAbove", scalarSlice_[1 - turn], kUnits + 4);
    const gl::Texture* const targets[] = {&lightSlice_[turn], &scalarSlice_[turn]};
    framebuffer.target(targets);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    copy(0, light_, s);
    copy(1, share_, s);
  }
}

// Slice s of the light from itself and the slice before it, which the sampler `before` reads.
void LightVolume::passOn(const gl::Program& program, const char* before, gl::Framebuffer& framebuffer, int s) {
  const auto turn = static_cast<std::size_t>(s & 1);
  slice(program, s);
  bind(program, before, lightSlice_[1 - turn], kUnits + 3);
  const gl::Texture* const targets[] = {&lightSlice_[turn]};
  framebuffer.target(targets);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  copy(0, light_, s);
}

void LightVolume::diffuseUp(gl::Framebuffer& framebuffer, int count) {
  use(columnPass_);
  bind(columnPass_, "uDiffuse", light_, kUnits + 1);
  bind(columnPass_, "uShare", share_, kUnits + 4);
  for (int s = job_->slice; s < job_->slice + count; ++s) passOn(columnPass_, "uBelow", framebuffer, s);
}

void LightVolume::lightBelow(gl::Framebuffer& framebuffer) {
  use(belowPass_);
  bind(belowPass_, "uDiffuse", light_, kUnits + 1);
  bind(belowPass_, "uFaces", faces_, kUnits + 2);
  draw(belowPass_, framebuffer, lightSlice_[0]);
  use(groundPass_);
  bind(groundPass_, "uOverhead", lightSlice_[0], kUnits + 1);
  bind(groundPass_, "uGround", below_, kUnits + 2);
  const glm::vec4 coarser = this->coarser(job_->level);
  gl_.Uniform4f(groundPass_.uniform("uCoarser"), coarser.x, coarser.y, coarser.z, coarser.w);
  draw(groundPass_, framebuffer, lightSlice_[1]);
  copy(0, below_, job_->level);
}

void LightVolume::publish(gl::Framebuffer& framebuffer) {
  const gl::Texture* const from[] = {&steps_, &light_};
  const gl::Texture* const to[] = {&sun_, &diffuse_};
  for (std::size_t i = 0; i < 2; ++i)
    for (int s = 0; s < slices_; ++s) {
      framebuffer.target({&from[i], 1}, s);
      copy(0, *to[i], job_->level * slices_ + s);
    }
  lightBelow(framebuffer);
  if (!job_->known) ++jumps_;
  Level& level = levels_[static_cast<std::size_t>(job_->level)];
  static_cast<Purpose&>(level) = *job_;
  level.shown = true;
  last_ = job_->level;
  job_.reset();
}

}  // namespace welkin::realtime
