#include "welkin/realtime/blocks.hpp"
#include "welkin/realtime/falling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

constexpr int kMapSize = 128, kCellsAcross = 16;
constexpr double kFlutterPeriod = 16.0;  // s, after which all flutter repeats

// The uniform block "Drops".
struct DropsBlock {
  law::DropParams params;
  std::array<law::DropClass, kDropLevels * kFallClasses> classes;
};

}  // namespace

FallingPass::FallingPass(const gl::Api& gl) : gl_(gl), buffer_(gl) {}

std::vector<std::pair<const char*, const gl::Texture*>> FallingPass::textures() const {
  return {{"rain map", &map_},         {"rain light", &light_},     {"drops: cells", &cells_},
          {"drops: places", &places_}, {"drops: lights", &lights_}, {"drops: sizes", &sizes_}};
}

void FallingPass::compile(const std::string& clouds, bool lit) {
  const std::string text = clouds + (lit ? "#define LIGHT_VOLUME\n" : "");
  if (text == text_) return;
  const auto program = [&](const char* name, const char* path) {
    return gl::Program(gl_, name, text, shaderText(path), shaderSource);
  };
  mapProgram_ = program("rain map", "welkin/realtime/shaders/rain_map.frag.glsl");
  lightProgram_ = program("rain light", "welkin/realtime/shaders/rain_light.frag.glsl");
  segmentsProgram_ = program("rain segments", "welkin/realtime/shaders/rain_segments.frag.glsl");
  text_ = text;
}

void FallingPass::bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(texture.target(), texture.id());
  gl_.Uniform1i(program.uniform(name), unit);
}

void FallingPass::drawMap(const FallingInputs& inputs, gl::Framebuffer& framebuffer, const glm::dvec2& wind) {
  const auto target = [&](const gl::Format& format, int width, int height, gl::Filter filter) {
    return gl::Texture(gl_, gl::Texture::Kind::plane, format, width, height, 0, filter, gl::Addressing::clamp, nullptr);
  };
  if (!map_) {
    map_ = target(gl::kRg16F, kMapSize, kMapSize, gl::Filter::linear);
    light_ = target(gl::kRgba32F, 2, 1, gl::Filter::nearest);
  }
  const auto draw = [&](const gl::Program& program, const gl::Texture& to) {
    const gl::Texture* targets[] = {&to};
    framebuffer.target(targets);
    inputs.layers.bind(kLayersBlock);
    inputs.march.bind(kMarchBlock);
    program.bindBlock("Layers", kLayersBlock);
    program.bindBlock("March", kMarchBlock);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  };
  gl_.UseProgram(mapProgram_.id());
  inputs.bindClouds(mapProgram_, 0);
  gl_.Uniform4f(mapProgram_.uniform("uPlace"), kRainMapEdge, static_cast<float>(wind.x), static_cast<float>(wind.y),
                0.0f);
  draw(mapProgram_, map_);
  gl_.UseProgram(lightProgram_.id());
  bind(lightProgram_, "uTransmittance", inputs.transmittance, 0);
  if (inputs.light) {
    bind(lightProgram_, "uSun", inputs.light->sun(), 1);
    bind(lightProgram_, "uBelow", inputs.light->below(), 2);
  }
  draw(lightProgram_, light_);
}

glm::ivec2 rainPictureSize(int width, int height, int marched) {
  const int edge = std::max(law::kRainPixels, 2 * marched);
  return glm::ivec2(law::kRainColumns, law::kRainRows) * ((glm::ivec2(width, height) + edge - 1) / edge);
}

void FallingPass::drawSegments(const FallingInputs& inputs, gl::Framebuffer& framebuffer,
                               const gl::UniformBuffer& frame, const gl::Texture& picture) {
  const gl::Texture* targets[] = {&picture};
  framebuffer.target(targets);
  const gl::Program& program = segmentsProgram_;
  gl_.UseProgram(program.id());
  program.bindBlock("Frame", kFrameBlock);
  program.bindBlock("Layers", kLayersBlock);
  program.bindBlock("March", kMarchBlock);
  frame.bind(kFrameBlock);
  inputs.layers.bind(kLayersBlock);
  inputs.march.bind(kMarchBlock);
  if (inputs.light) {
    bind(program, "uSun", inputs.light->sun(), 0);
    bind(program, "uBelow", inputs.light->below(), 1);
  }
  inputs.bindClouds(program, 2);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

// Cells, and room for what stands in them.
void FallingPass::keepCells(const std::vector<glm::vec4>& cells) {
  const int rows = (static_cast<int>(cells.size()) + kCellsAcross - 1) / kCellsAcross;
  std::vector<glm::vec4> texels(cells);
  texels.resize(static_cast<std::size_t>(rows) * kCellsAcross);
  if (!cells_ || cells_.height() < rows) {
    const auto target = [&](const gl::Format& format, int width) {
      return gl::Texture(gl_, gl::Texture::Kind::plane, format, width, rows, 0, gl::Filter::nearest,
                         gl::Addressing::clamp, nullptr);
    };
    cells_ = target(gl::kRgba32F, kCellsAcross);
    places_ = target(gl::kRgba32F, kCellsAcross * kDropsPerCell);
    lights_ = target(gl::kRgba32F, kCellsAcross * kDropsPerCell);
    sizes_ = target(gl::kRg16F, kCellsAcross * kDropsPerCell);
  }
  gl_.BindTexture(GL_TEXTURE_2D, cells_.id());
  gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kCellsAcross, rows, GL_RGBA, GL_FLOAT, texels.data());
}

const gl::Program& FallingPass::program(std::map<std::string, gl::Program>& variants, const std::string& defines,
                                        const char* fragment, const char* vertex) const {
  gl::Program& found = variants[defines];
  if (!found.id())
    found = gl::Program(gl_, "drops", defines, shaderText(fragment), shaderSource, vertex ? shaderText(vertex) : "");
  return found;
}

int FallingPass::drawDrops(const Drops& drops) {
  const auto most = static_cast<std::size_t>(std::max(drops.most, 0)) / kDropsPerCell;
  const std::vector<glm::vec4> cells = dropCells(drops.levels, drops.view, glm::vec3(drops.up), drops.altitude, most);
  if (cells.empty()) return 0;
  DropsBlock block{};
  law::DropParams& p = block.params;
  const glm::mat4 rows = glm::transpose(drops.view.clipFromWorld);
  p.clip0 = rows[0];
  p.clip1 = rows[1];
  p.clip3 = rows[3];
  for (int k = 0; k < kDropLevels; ++k) {
    p.edges[k] = drops.levels.edge[k];
    p.reaches[k] = drops.levels.reach[k];
  }
  p.sun = glm::vec4(drops.toSun, drops.frame.preExposure);
  p.up = glm::vec4(glm::vec3(drops.up), drops.altitude);
  p.rate = drops.rate;
  p.mapScale = 1.0f / kRainMapEdge;
  p.turns = static_cast<float>(std::fmod(drops.frame.time, kFlutterPeriod) / kFlutterPeriod);
  p.shutter = drops.shutter;
  block.classes = dropClasses(drops.levels, drops.eye, drops.up, drops.wind, drops.velocity, drops.frame.time);
  buffer_.upload(&block, sizeof block);
  const auto& classes = drops.levels.falling.classes;
  const bool flakes = std::any_of(classes.begin(), classes.end(), [](const FallClass& c) { return c.snow > 0.5f; });
  const bool panorama = drops.frame.mapping == Projection::equirectangular;
  place(cells,
        program(placePrograms_,
                fmt::format("#define DROP_LEVELS {}\n#define DROP_CLASSES {}\n#define DROPS_PER_CELL {}\n{}{}",
                            kDropLevels, kFallClasses, kDropsPerCell, flakes ? "#define FLAKES\n" : "",
                            panorama ? "#define PANORAMA\n" : ""),
                "welkin/realtime/shaders/drop_places.frag.glsl", nullptr),
        drops);

  const gl::Program& show =
      program(dropsPrograms_, drops.frame.depthTexture ? "#define HOST_DEPTH\n" : "",
              "welkin/realtime/shaders/drops.frag.glsl", "welkin/realtime/shaders/drops.vert.glsl");
  gl_.BindFramebuffer(GL_FRAMEBUFFER, drops.frame.framebuffer);
  gl_.Viewport(0, 0, drops.frame.width, drops.frame.height);
  gl_.UseProgram(show.id());
  show.bindBlock("Frame", kFrameBlock);
  bind(show, "uPlaces", places_, 0);
  bind(show, "uLights", lights_, 1);
  bind(show, "uSizes", sizes_, 2);
  gl_.ActiveTexture(GL_TEXTURE3);
  gl_.BindTexture(GL_TEXTURE_2D, drops.frame.depthTexture);
  gl_.Uniform1i(show.uniform("uHostDepth"), 3);
  gl_.Enable(GL_BLEND);
  gl_.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
  gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const int count = static_cast<int>(cells.size()) * kDropsPerCell;
  gl_.DrawArrays(GL_TRIANGLES, 0, 3 * count);
  return count;
}

// Works out all drops of these cells.
void FallingPass::place(const std::vector<glm::vec4>& cells, const gl::Program& program, const Drops& drops) {
  gl_.ActiveTexture(GL_TEXTURE0);
  keepCells(cells);
  const gl::Texture* const targets[] = {&places_, &lights_, &sizes_};
  drops.framebuffer.target(targets);
  const int rows = (static_cast<int>(cells.size()) + kCellsAcross - 1) / kCellsAcross;
  gl_.Viewport(0, 0, places_.width(), rows);
  gl_.Disable(GL_BLEND);
  gl_.UseProgram(program.id());
  program.bindBlock("Frame", kFrameBlock);
  program.bindBlock("Drops", kDropsBlock);
  drops.frameBlock.bind(kFrameBlock);
  buffer_.bind(kDropsBlock);
  bind(program, "uCells", cells_, 0);
  bind(program, "uRainMap", map_, 1);
  bind(program, "uRainLight", light_, 2);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace welkin::realtime
