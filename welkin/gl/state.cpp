#include "welkin/gl/state.hpp"

namespace welkin::gl {

namespace {

struct Toggle {
  GLenum name;
  bool desktopOnly;
};
constexpr std::array<Toggle, 9> kToggleNames{{{GL_BLEND, false},
                                              {GL_CULL_FACE, false},
                                              {GL_DEPTH_TEST, false},
                                              {GL_STENCIL_TEST, false},
                                              {GL_SCISSOR_TEST, false},
                                              {GL_RASTERIZER_DISCARD, false},
                                              {GL_FRAMEBUFFER_SRGB, true},
                                              {GL_COLOR_LOGIC_OP, true},
                                              {GL_MULTISAMPLE, true}}};

// Pixel store and the value that tightly packed floats and bytes need.
struct Store {
  GLenum name;
  GLint value;
};
constexpr std::array<Store, 10> kStoreNames{{{GL_UNPACK_ALIGNMENT, 4},
                                             {GL_UNPACK_ROW_LENGTH, 0},
                                             {GL_UNPACK_SKIP_ROWS, 0},
                                             {GL_UNPACK_SKIP_PIXELS, 0},
                                             {GL_UNPACK_IMAGE_HEIGHT, 0},
                                             {GL_UNPACK_SKIP_IMAGES, 0},
                                             {GL_PACK_ALIGNMENT, 4},
                                             {GL_PACK_ROW_LENGTH, 0},
                                             {GL_PACK_SKIP_ROWS, 0},
                                             {GL_PACK_SKIP_PIXELS, 0}}};

}  // namespace

StateGuard::StateGuard(const Api& gl) : gl_(gl) {
  gl.GetIntegerv(GL_CURRENT_PROGRAM, &program_);
  gl.GetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertexArray_);
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawFramebuffer_);
  gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &readFramebuffer_);
  gl.GetIntegerv(GL_ACTIVE_TEXTURE, &activeTexture_);
  gl.GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &uniformBuffer_);
  gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &packBuffer_);
  gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpackBuffer_);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (std::size_t i = 0; i < kStoreNames.size(); ++i) {
    gl.GetIntegerv(kStoreNames[i].name, &stores_[i]);
    gl.PixelStorei(kStoreNames[i].name, kStoreNames[i].value);
  }
  gl.GetIntegerv(GL_VIEWPORT, viewport_.data());
  gl.GetIntegerv(GL_SCISSOR_BOX, scissor_.data());
  gl.GetIntegerv(GL_BLEND_SRC_RGB, &blend_[0]);
  gl.GetIntegerv(GL_BLEND_DST_RGB, &blend_[1]);
  gl.GetIntegerv(GL_BLEND_SRC_ALPHA, &blend_[2]);
  gl.GetIntegerv(GL_BLEND_DST_ALPHA, &blend_[3]);
  gl.GetIntegerv(GL_BLEND_EQUATION_RGB, &blend_[4]);
  gl.GetIntegerv(GL_BLEND_EQUATION_ALPHA, &blend_[5]);
  gl.GetBooleanv(GL_COLOR_WRITEMASK, colourMask_.data());
  gl.GetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
  if (!gl.es && gl.PolygonMode) gl.GetIntegerv(GL_POLYGON_MODE, polygonMode_.data());
  for (GLuint i = 0; i < kBuffers; ++i) {
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &buffers_[i].name);
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_START, i, &buffers_[i].start);
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_SIZE, i, &buffers_[i].size);
  }
  for (int i = 0; i < kUnits; ++i) {
    Unit& unit = units_[static_cast<std::size_t>(i)];
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &unit.plane);
    gl.GetIntegerv(GL_TEXTURE_BINDING_3D, &unit.volume);
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &unit.array);
    gl.GetIntegerv(GL_SAMPLER_BINDING, &unit.sampler);
    gl.BindSampler(static_cast<GLuint>(i), 0);
  }
  for (std::size_t i = 0; i < kToggleNames.size(); ++i) {
    if (gl.es && kToggleNames[i].desktopOnly) continue;
    toggles_[i] = gl.IsEnabled(kToggleNames[i].name);
    if (kToggleNames[i].name != GL_MULTISAMPLE) gl.Disable(kToggleNames[i].name);
  }
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_FALSE);
  if (!gl.es && gl.PolygonMode) gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

StateGuard::~StateGuard() {
  const auto unsignedOf = [](GLint x) { return static_cast<GLuint>(x); };
  for (int i = 0; i < kUnits; ++i) {
    const Unit& unit = units_[static_cast<std::size_t>(i)];
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    gl_.BindTexture(GL_TEXTURE_2D, unsignedOf(unit.plane));
    gl_.BindTexture(GL_TEXTURE_3D, unsignedOf(unit.volume));
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, unsignedOf(unit.array));
    gl_.BindSampler(unsignedOf(i), unsignedOf(unit.sampler));
  }
  for (GLuint i = 0; i < kBuffers; ++i) {
    const Buffer& b = buffers_[i];
    if (b.name != 0 && b.size > 0)
      gl_.BindBufferRange(GL_UNIFORM_BUFFER, i, unsignedOf(b.name), b.start, b.size);
    else
      gl_.BindBufferBase(GL_UNIFORM_BUFFER, i, unsignedOf(b.name));
  }
  gl_.BindBuffer(GL_UNIFORM_BUFFER, unsignedOf(uniformBuffer_));
  for (std::size_t i = 0; i < kToggleNames.size(); ++i) {
    if (gl_.es && kToggleNames[i].desktopOnly) continue;
    if (toggles_[i])
      gl_.Enable(kToggleNames[i].name);
    else
      gl_.Disable(kToggleNames[i].name);
  }
  const auto enumOf = [](GLint x) { return static_cast<GLenum>(x); };
  gl_.BlendFuncSeparate(enumOf(blend_[0]), enumOf(blend_[1]), enumOf(blend_[2]), enumOf(blend_[3]));
  gl_.BlendEquationSeparate(enumOf(blend_[4]), enumOf(blend_[5]));
  gl_.ColorMask(colourMask_[0], colourMask_[1], colourMask_[2], colourMask_[3]);
  gl_.DepthMask(depthMask_);
  if (!gl_.es && gl_.PolygonMode) gl_.PolygonMode(GL_FRONT_AND_BACK, enumOf(polygonMode_[0]));
  for (std::size_t i = 0; i < kStoreNames.size(); ++i) gl_.PixelStorei(kStoreNames[i].name, stores_[i]);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, unsignedOf(packBuffer_));
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, unsignedOf(unpackBuffer_));
  gl_.ActiveTexture(enumOf(activeTexture_));
  gl_.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  gl_.Scissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, unsignedOf(drawFramebuffer_));
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, unsignedOf(readFramebuffer_));
  gl_.BindVertexArray(unsignedOf(vertexArray_));
  gl_.UseProgram(unsignedOf(program_));
}

}  // namespace welkin::gl
