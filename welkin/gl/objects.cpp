#include "welkin/gl/objects.hpp"

#include <fmt/format.h>

#include <array>
#include <regex>
#include <vector>

#include "welkin/base/error.hpp"

namespace welkin::gl {

Texture::Texture(const Api& gl, Kind kind, const Format& format, int width, int height, int depth, Filter filter,
                 Addressing addressing, const void* texels)
    : gl_(&gl),
      target_(kind == Kind::plane ? GL_TEXTURE_2D : (kind == Kind::array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_3D)),
      format_(format), width_(width), height_(height), depth_(kind == Kind::plane ? 0 : depth) {
  gl.GenTextures(1, &id_);
  gl.BindTexture(target_, id_);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const auto internal = static_cast<GLint>(format.internal);
  if (kind == Kind::plane)
    gl.TexImage2D(target_, 0, internal, width, height, 0, format.external, format.type, texels);
  else
    gl.TexImage3D(target_, 0, internal, width, height, depth, 0, format.external, format.type, texels);
  const GLint filtering = filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
  gl.TexParameteri(target_, GL_TEXTURE_MIN_FILTER, filtering);
  gl.TexParameteri(target_, GL_TEXTURE_MAG_FILTER, filtering);
  gl.TexParameteri(target_, GL_TEXTURE_MAX_LEVEL, 0);
  const GLint wrap = addressing == Addressing::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  gl.TexParameteri(target_, GL_TEXTURE_WRAP_S, addressing == Addressing::repeatX ? GL_REPEAT : wrap);
  gl.TexParameteri(target_, GL_TEXTURE_WRAP_T, wrap);
  gl.TexParameteri(target_, GL_TEXTURE_WRAP_R, wrap);
}

Texture::~Texture() {
  if (gl_) gl_->DeleteTextures(1, &id_);
}

void Texture::swap(Texture& o) noexcept {
  std::swap(gl_, o.gl_);
  std::swap(id_, o.id_);
  std::swap(target_, o.target_);
  std::swap(format_, o.format_);
  std::swap(width_, o.width_);
  std::swap(height_, o.height_);
  std::swap(depth_, o.depth_);
}

Framebuffer::Framebuffer(const Api& gl) : gl_(&gl) { gl.GenFramebuffers(1, &id_); }

Framebuffer::~Framebuffer() {
  if (gl_) gl_->DeleteFramebuffers(1, &id_);
}

void Framebuffer::target(std::span<const Texture* const> textures, int layer) {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, id_);
  std::array<GLenum, 8> buffers{};
  const int count = static_cast<int>(textures.size());
  for (int i = 0; i < count; ++i) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    const Texture& texture = *textures[static_cast<std::size_t>(i)];
    if (texture.target() == GL_TEXTURE_2D)
      gl_->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.id(), 0);
    else
      gl_->FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture.id(), 0, layer);
    buffers[static_cast<std::size_t>(i)] = attachment;
  }
  for (int i = count; i < attached_; ++i)
    gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i), GL_TEXTURE_2D, 0, 0);
  attached_ = count;
  gl_->DrawBuffers(count, buffers.data());
  gl_->Viewport(0, 0, textures[0]->width(), textures[0]->height());
  const GLenum status = gl_->CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ErrorKind::noOpenGl, "",
                fmt::format("the driver cannot render to {} (framebuffer status 0x{:04x})", textures[0]->format().name,
                            status));
}

std::string versionHeader(const Api& gl) {
  return std::string(gl.es ? "#version 300 es\n" : "#version 330 core\n") +
         "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp sampler3D;\n"
         "precision highp sampler2DArray;\n";
}

namespace {

constexpr const char* kFullScreenTriangle = R"(
out vec2 vUv;
void main() {
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  vUv = corner;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)";

// Drivers write "0:12(5): error" or "ERROR: 0:12:"; puts file and line for the number of the expanded line.
std::string withFileNames(const std::string& log, const ExpandedSource& source) {
  static const std::regex kPlace(R"((^|\s)\d+:(\d+))");
  std::string out;
  auto last = log.cbegin();
  for (auto it = std::sregex_iterator(log.begin(), log.end(), kPlace); it != std::sregex_iterator(); ++it) {
    out.append(last, it->prefix().second);
    out += (*it)[1].str() + source.place(std::stoul((*it)[2]));
    last = it->suffix().first;
  }
  out.append(last, log.cend());
  return out;
}

GLuint compile(const Api& gl, GLenum stage, const std::string& name, const std::string& header,
               const ExpandedSource& source) {
  const GLuint shader = gl.CreateShader(stage);
  const std::string start = header + "#line 1\n";
  const char* texts[] = {start.c_str(), source.text.c_str()};
  gl.ShaderSource(shader, 2, texts, nullptr);
  gl.CompileShader(shader);
  GLint ok = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    std::string log(16384, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteShader(shader);
    throw Error(ErrorKind::failed, "shader " + name, "does not compile:\n" + withFileNames(log, source));
  }
  return shader;
}

}  // namespace

Program::Program(const Api& gl, const std::string& name, const std::string& defines, const std::string& fragment,
                 const SourceResolver& resolver, const std::string& vertex)
    : gl_(&gl) {
  const std::string header = versionHeader(gl) + defines;
  const GLuint vs =
      compile(gl, GL_VERTEX_SHADER, name, header,
              expandIncludes(vertex.empty() ? kFullScreenTriangle : vertex, name + " (vertex)", resolver));
  GLuint fs = 0;
  try {
    fs = compile(gl, GL_FRAGMENT_SHADER, name, header, expandIncludes(fragment, name, resolver));
  } catch (...) {
    gl.DeleteShader(vs);
    throw;
  }
  id_ = gl.CreateProgram();
  gl.AttachShader(id_, vs);
  gl.AttachShader(id_, fs);
  gl.LinkProgram(id_);
  gl.DeleteShader(vs);
  gl.DeleteShader(fs);
  GLint ok = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (!ok) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteProgram(id_);
    throw Error(ErrorKind::failed, "shader " + name, "does not link:\n" + log);
  }
}

Program::~Program() {
  if (gl_) gl_->DeleteProgram(id_);
}

void Program::bindBlock(const char* block, GLuint binding) const {
  const GLuint index = gl_->GetUniformBlockIndex(id_, block);
  if (index != GL_INVALID_INDEX) gl_->UniformBlockBinding(id_, index, binding);
}

UniformBuffer::UniformBuffer(const Api& gl) : gl_(&gl) { gl.GenBuffers(1, &id_); }

UniformBuffer::~UniformBuffer() {
  if (gl_) gl_->DeleteBuffers(1, &id_);
}

void UniformBuffer::upload(const void* data, std::size_t bytes) {
  gl_->BindBuffer(GL_UNIFORM_BUFFER, id_);
  gl_->BufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_DRAW);
}

}  // namespace welkin::gl
