#include "welkin/gl/context.hpp"

#include <gtest/gtest.h>

#include "welkin/base/error.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/gl/state.hpp"

namespace welkin::gl {
namespace {

TEST(Context, OffersDesktopAndEmbeddedOpenGl) {
  for (const ContextKind kind : {ContextKind::desktop, ContextKind::es}) {
    const Context context(kind);
    const Api gl = loadApi(context.loader());
    EXPECT_EQ(gl.es, kind == ContextKind::es);
    EXPECT_GE(gl.major, 3);
  }
}

TEST(Context, LoadingWithoutAContextIsRefused) {
  Loader loader;
  { loader = Context().loader(); }
  EXPECT_THROW(loadApi([](const char*) -> void* { return nullptr; }), Error);
  EXPECT_THROW(loadApi(loader), Error);
}

TEST(Program, MessageNamesFileAndLine) {
  const Context context;
  const Api gl = loadApi(context.loader());
  try {
    Program(gl, "bad", "", "#include \"part.glsl\"\nvoid main() {}\n",
            [](std::string_view) -> std::string_view { return "int ok;\nfloat f = nonsense;\n"; });
    FAIL() << "compiled";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("part.glsl:2"), std::string::npos) << e.what();
  }
}

// Every toggle, mask, function and binding that the guard promises, set to something unusual, survives.
TEST(StateGuard, PutsEverythingBack) {
  const Context context;
  const Api gl = loadApi(context.loader());
  Framebuffer framebuffer(gl);
  const Texture target(gl, Texture::Kind::plane, kRgba8, 8, 8, 0, Filter::nearest, Addressing::clamp, nullptr);
  const Texture volume(gl, Texture::Kind::volume, kR8, 2, 2, 2, Filter::nearest, Addressing::clamp, nullptr);
  UniformBuffer buffer(gl);
  const float zero = 0.0f;
  buffer.upload(&zero, sizeof zero);
  const VertexArray vertices(gl);
  const Texture* targets[] = {&target};
  framebuffer.target(targets);
  GLuint sampler = 0;
  gl.GenSamplers(1, &sampler);
  gl.BindSampler(3, sampler);
  gl.BindVertexArray(vertices.id());
  gl.ActiveTexture(GL_TEXTURE0 + 5);
  gl.BindTexture(GL_TEXTURE_2D, target.id());
  gl.ActiveTexture(GL_TEXTURE0 + 2);
  gl.BindTexture(GL_TEXTURE_3D, volume.id());
  gl.ActiveTexture(GL_TEXTURE0 + 7);
  buffer.bind(4);
  gl.Enable(GL_SCISSOR_TEST);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Scissor(1, 2, 3, 4);
  gl.Viewport(5, 6, 7, 8);
  gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  gl.DepthMask(GL_TRUE);
  gl.BlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_SRC_ALPHA, GL_ONE);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);

  const auto snapshot = [&] {
    std::vector<GLint> s;
    const auto take = [&](GLenum name, int count) {
      GLint v[4] = {};
      gl.GetIntegerv(name, v);
      s.insert(s.end(), v, v + count);
    };
    for (const GLenum name :
         {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING,
          GL_ACTIVE_TEXTURE, GL_UNIFORM_BUFFER_BINDING, GL_UNPACK_ALIGNMENT, GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB,
          GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA, GL_DEPTH_WRITEMASK})
      take(name, 1);
    take(GL_VIEWPORT, 4);
    take(GL_SCISSOR_BOX, 4);
    take(GL_COLOR_WRITEMASK, 4);
    take(GL_POLYGON_MODE, 1);
    for (const GLenum name : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB})
      s.push_back(gl.IsEnabled(name));
    GLint bound = 0;
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 4, &bound);
    s.push_back(bound);
    const GLint active = s[4];
    for (int unit = 0; unit < 8; ++unit) {
      gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      for (const GLenum name : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D, GL_SAMPLER_BINDING}) take(name, 1);
    }
    gl.ActiveTexture(static_cast<GLenum>(active));
    return s;
  };
  const std::vector<GLint> before = snapshot();
  {
    const StateGuard guard(gl);
    EXPECT_NE(snapshot(), before) << "inside the guard the state is Welkin's";
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.Enable(GL_BLEND);
    gl.Viewport(0, 0, 1, 1);
    gl.BindTexture(GL_TEXTURE_2D, 0);
  }
  EXPECT_EQ(snapshot(), before);
  gl.DeleteSamplers(1, &sampler);
}

}  // namespace
}  // namespace welkin::gl
