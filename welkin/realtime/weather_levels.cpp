#include "welkin/realtime/weather_levels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/density/weather_map.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {
constexpr int kCell = 4;  // texels of a cell of the bounds
// A level that moves on is made in blocks, kAcross along each edge: a frame waits for one of them only.
constexpr int kAcross = 8;
}  // namespace

WeatherExtent weatherExtent(QualityPreset preset) {
  if (preset == QualityPreset::low || preset == QualityPreset::medium) return {256, 4, 14000.0, 3.0};
  return {512, 4, 20000.0, 2.8};
}

WeatherLevels::WeatherLevels(const gl::Api& gl, const WeatherExtent& extent, int layers, bool onProcessor)
    : gl_(gl), extent_(extent), onProcessor_(onProcessor),
      main_(gl, gl::Texture::Kind::array, gl::kRg16F, extent.texels, extent.texels, layers * extent.levels,
            gl::Filter::linear, gl::Addressing::clamp, nullptr),
      extra_(gl, gl::Texture::Kind::array, gl::kRg16F, extent.texels, extent.texels, layers * extent.levels,
             gl::Filter::linear, gl::Addressing::clamp, nullptr),
      bounds_(gl, gl::Texture::Kind::array, gl::kRg16F, extent.texels / kCell, extent.texels / kCell,
              layers * extent.levels, gl::Filter::nearest, gl::Addressing::clamp, nullptr),
      boundsPass_(gl, "weather bounds", "", shaderText("welkin/realtime/shaders/weather_bounds.frag.glsl"),
                  shaderSource),
      levels_(static_cast<std::size_t>(layers) * static_cast<std::size_t>(extent.levels)) {}

bool WeatherLevels::fits(const WeatherExtent& extent, int layers) const {
  return extent.texels == extent_.texels && extent.levels == extent_.levels && extent.finest == extent_.finest &&
         extent.ratio == extent_.ratio &&
         levels_.size() == static_cast<std::size_t>(layers) * static_cast<std::size_t>(extent.levels);
}

void WeatherLevels::change() {
  for (Level& level : levels_) level.changed = true;
  job_.reset();
}

bool WeatherLevels::changing() const {
  return std::any_of(levels_.begin(), levels_.end(), [](const Level& l) { return l.shown && l.changed; });
}

double WeatherLevels::away(int level, const Level& cached, const glm::dvec2& inAir) const {
  const glm::dvec2 way = glm::abs(inAir - cached.centre);
  return std::max(way.x, way.y) / extent_.edge(level);
}

int WeatherLevels::update(int index, const Layer& layer, const glm::dvec2& position, const Drift& drift, int seed,
                          const gl::Program& program, gl::Framebuffer& framebuffer, gl::UniformBuffer& buffer,
                          const gl::Texture& map, int most) {
  const glm::dvec2 inAir = position - driftOffset(drift);
  const int first = index * extent_.levels;
  const auto at = [&](int level) -> Level& { return levels_.begin()[first + level]; };
  std::vector<int> useless, stale;
  for (int level = 0; level < extent_.levels; ++level) {
    const double far = away(level, at(level), inAir);
    if (!at(level).shown || far > kUseless)
      useless.push_back(level);
    else if (at(level).changed || far >= kLeash)
      stale.push_back(level);
  }
  std::stable_sort(stale.begin(), stale.end(), [&](int a, int b) { return at(a).drawn < at(b).drawn; });
  const int left = std::max(most - static_cast<int>(useless.size()), 0);
  if (left < static_cast<int>(stale.size())) stale.resize(static_cast<std::size_t>(left));
  stale.insert(stale.begin(), useless.begin(), useless.end());
  const auto inHand = [&](int level) { return job_ && job_->slice == first + level; };
  // What has come back into reach, or has to wait for another level, is not gone on with.
  for (int level = 0; level < extent_.levels; ++level)
    if (inHand(level) && std::find(stale.begin(), stale.end(), level) == stale.end()) job_.reset();
  int drawn = 0;
  for (const int level : stale) {
    const Level& now = at(level);
    const bool moves = now.shown && !now.changed && away(level, now, inAir) <= kUseless;
    if (moves && most != kAll && onProcessor_ && layer.weather.map.empty() && extent_.texels % kAcross == 0) {
      if (!job_)
        job_ = Job{first + level, 0, levelCentre(extent_, level, inAir), Volume(extent_.texels, extent_.texels, 1, 4)};
      if (inHand(level)) drawn += goOn(level, layer, drift, seed, framebuffer) ? 1 : 0;
      continue;
    }
    if (inHand(level)) job_.reset();
    ++drawn;
    at(level) = {levelCentre(extent_, level, inAir), true, false, ++count_};
    fill(level, first + level, layer, drift, seed, program, framebuffer, buffer, map);
  }
  return drawn;
}

// With the level's centre as anchor, in still air.
void WeatherLevels::fill(int level, int slice, const Layer& layer, const Drift& drift, int seed,
                         const gl::Program& program, gl::Framebuffer& framebuffer, gl::UniformBuffer& buffer,
                         const gl::Texture& map) {
  const Drift still{drift.windSpeed, drift.windFrom, 0.0};
  if (onProcessor_ && layer.weather.map.empty()) {
    upload(slice, bakeWeather(layer, levels_[static_cast<std::size_t>(slice)].centre, extent_.edge(level),
                              extent_.texels, still, seed));
    return fillBounds(layer, level, slice, framebuffer);
  }
  const law::WeatherParams params = weatherParams(layer, levels_[static_cast<std::size_t>(slice)].centre, still, seed);
  buffer.upload(&params, sizeof params);
  buffer.bind(0);
  gl_.UseProgram(program.id());
  program.bindBlock("Weather", 0);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, map.id());
  gl_.Uniform1i(program.uniform("uMap"), 0);
  gl_.Uniform4f(program.uniform("uLevel"), 0.0f, 0.0f, static_cast<float>(extent_.edge(level)),
                layer.cloud.shape == LayerShape::nubis ? 1.0f : 0.0f);
  const gl::Texture* targets[] = {&main_, &extra_};
  framebuffer.target(targets, slice);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  fillBounds(layer, level, slice, framebuffer);
}

bool WeatherLevels::goOn(int level, const Layer& layer, const Drift& drift, int seed, gl::Framebuffer& framebuffer) {
  Job& job = *job_;
  const int texels = extent_.texels / kAcross, column = job.block % kAcross, row = job.block / kAcross;
  const double edge = extent_.edge(level) / kAcross;
  const glm::dvec2 centre = job.centre + edge * (glm::dvec2(column, row) + 0.5 - 0.5 * kAcross);
  const Volume block = bakeWeather(layer, centre, edge, texels, {drift.windSpeed, drift.windFrom, 0.0}, seed);
  const auto wide = static_cast<std::ptrdiff_t>(4) * texels;
  for (int y = 0; y < texels; ++y)
    std::copy_n(block.texels.begin() + y * wide, wide,
                job.weather.texels.begin() +
                    ((static_cast<std::ptrdiff_t>(row) * texels + y) * extent_.texels + column * texels) * 4);
  if (++job.block < kAcross * kAcross) return false;
  levels_[static_cast<std::size_t>(job.slice)] = {job.centre, true, false, ++count_};
  upload(job.slice, job.weather);
  fillBounds(layer, level, job.slice, framebuffer);
  job_.reset();
  return true;
}

void WeatherLevels::upload(int slice, const Volume& weather) {
  std::vector<float> pairs(weather.texels.size() / 2);
  gl_.ActiveTexture(GL_TEXTURE0);
  for (std::size_t part = 0; part < 2; ++part) {
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = weather.texels[2 * (i - i % 2) + 2 * part + i % 2];
    const gl::Texture& to = part == 0 ? main_ : extra_;
    gl_.BindTexture(to.target(), to.id());
    gl_.TexSubImage3D(to.target(), 0, 0, 0, slice, extent_.texels, extent_.texels, 1, to.format().external,
                      to.format().type, pairs.data());
  }
}

void WeatherLevels::fillBounds(const Layer& layer, int level, int slice, gl::Framebuffer& framebuffer) {
  const bool nubis = layer.cloud.shape == LayerShape::nubis;
  const double texel = extent_.edge(level) / extent_.texels;
  // Filtering reaches half a texel beyond a cell, the warp of profile.glsl half its strength.
  const int reach = 1 + (nubis ? 0 : static_cast<int>(std::ceil(0.5 * layer.profile.warp / texel)));
  gl_.UseProgram(boundsPass_.id());
  const gl::Texture* const sources[] = {&main_, &extra_};
  const char* const names[] = {"uWeather", "uExtra"};
  for (int i = 0; i < 2; ++i) {
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    gl_.BindTexture(sources[i]->target(), sources[i]->id());
    gl_.Uniform1i(boundsPass_.uniform(names[i]), i);
  }
  gl_.Uniform4i(boundsPass_.uniform("uCells"), kCell, reach, slice, extent_.texels);
  gl_.Uniform4f(boundsPass_.uniform("uLayer"), layer.cloud.thickness, nubis ? 0.0f : layer.profile.baseRagged,
                nubis ? 0.0f : 0.5f * layer.profile.fineDetail, nubis ? 1.0f : 0.0f);
  const gl::Texture* const targets[] = {&bounds_};
  framebuffer.target(targets, slice);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

law::ClipParams WeatherLevels::params(int index, const glm::dvec2& position, const Drift& drift) const {
  const glm::dvec2 inAir = position - driftOffset(drift);
  law::ClipParams clip{};
  clip.count = extent_.levels;
  clip.firstSlice = static_cast<float>(index * extent_.levels);
  for (int level = 0; level < extent_.levels; ++level) {
    const int slice = index * extent_.levels + level;
    const Level& cached = levels_[static_cast<std::size_t>(slice)];
    levelOf(clip, level) = clipLevel(extent_, level, inAir - cached.centre);
  }
  return clip;
}

}  // namespace welkin::realtime
