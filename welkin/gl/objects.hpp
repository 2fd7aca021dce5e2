#pragma once
// Owners of OpenGL objects. Like api.hpp, for .cpp files only.
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "welkin/gl/api.hpp"
#include "welkin/gl/source.hpp"

namespace welkin::gl {

// A texture's internal format with what TexImage needs to know of it.
struct Format {
  GLenum internal, external, type;
  int channels, bytesPerTexel;
  const char* name;
};
inline constexpr Format kR8{GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, 1, "R8"};
inline constexpr Format kRgba8{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, "RGBA8"};
inline constexpr Format kR16F{GL_R16F, GL_RED, GL_FLOAT, 1, 2, "R16F"};
inline constexpr Format kRg16F{GL_RG16F, GL_RG, GL_FLOAT, 2, 4, "RG16F"};
inline constexpr Format kRgba16F{GL_RGBA16F, GL_RGBA, GL_FLOAT, 4, 8, "RGBA16F"};
inline constexpr Format kR32F{GL_R32F, GL_RED, GL_FLOAT, 1, 4, "R32F"};
inline constexpr Format kRgba32F{GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16, "RGBA32F"};
inline constexpr Format kDepth32F{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4, "DEPTH32F"};
inline constexpr Format kDepth32FStencil8{
    GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 1, 8, "DEPTH32F_STENCIL8"};

enum class Filter { nearest, linear };
enum class Addressing { repeat, clamp, repeatX };  // repeatX: repeats in x, clamps in y

// Owns a texture of one mip level: 2D (depth 0), a 2D array, or 3D.
class Texture {
 public:
  enum class Kind { plane, array, volume };
  Texture() = default;
  // `texels`: floats (or bytes for 8-bit formats), channels interleaved, x fastest; may be null.
  Texture(const Api& gl, Kind kind, const Format& format, int width, int height, int depth, Filter filter,
          Addressing addressing, const void* texels);
  ~Texture();
  Texture(Texture&& o) noexcept { swap(o); }
  Texture& operator=(Texture&& o) noexcept {
    Texture t(std::move(o));
    swap(t);
    return *this;
  }

  GLuint id() const { return id_; }
  GLenum target() const { return target_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int depth() const { return depth_; }
  const Format& format() const { return format_; }
  std::size_t bytes() const {
    return static_cast<std::size_t>(width_) * height_ * (depth_ > 0 ? depth_ : 1) * format_.bytesPerTexel;
  }
  explicit operator bool() const { return id_ != 0; }

 private:
  void swap(Texture& o) noexcept;
  const Api* gl_ = nullptr;
  GLuint id_ = 0;
  GLenum target_ = GL_TEXTURE_2D;
  Format format_ = kR8;
  int width_ = 0, height_ = 0, depth_ = 0;
};

// Owns a framebuffer object whose colour attachments are set anew for each pass.
class Framebuffer {
 public:
  Framebuffer() = default;
  explicit Framebuffer(const Api& gl);
  ~Framebuffer();
  Framebuffer(Framebuffer&& o) noexcept { swap(o); }
  Framebuffer& operator=(Framebuffer&& o) noexcept {
    Framebuffer t(std::move(o));
    swap(t);
    return *this;
  }

  // Binds the framebuffer with these textures (layer `layer` of an array or volume) as colour targets and sets the
  // viewport to their size. Throws Error when the driver finds the combination incomplete.
  void target(std::span<const Texture* const> textures, int layer = 0);

 private:
  void swap(Framebuffer& o) noexcept {
    std::swap(gl_, o.gl_);
    std::swap(id_, o.id_);
    std::swap(attached_, o.attached_);
  }
  const Api* gl_ = nullptr;
  GLuint id_ = 0;
  int attached_ = 0;
};

// Owns a linked program made of the full-screen triangle and one fragment shader, or of two given shaders.
class Program {
 public:
  Program() = default;
  // `defines` is put before the text, after the version header. Throws Error (failed) with the driver's message, file
  // names put in for its numbers.
  Program(const Api& gl, const std::string& name, const std::string& defines, const std::string& fragment,
          const SourceResolver& resolver, const std::string& vertex = "");
  ~Program();
  Program(Program&& o) noexcept { swap(o); }
  Program& operator=(Program&& o) noexcept {
    Program t(std::move(o));
    swap(t);
    return *this;
  }

  GLuint id() const { return id_; }
  // -1 where the program does not use the name; setting that location is harmless.
  GLint uniform(const char* name) const { return gl_->GetUniformLocation(id_, name); }
  void bindBlock(const char* block, GLuint binding) const;

 private:
  void swap(Program& o) noexcept {
    std::swap(gl_, o.gl_);
    std::swap(id_, o.id_);
  }
  const Api* gl_ = nullptr;
  GLuint id_ = 0;
};

// Owns a uniform buffer.
class UniformBuffer {
 public:
  UniformBuffer() = default;
  explicit UniformBuffer(const Api& gl);
  ~UniformBuffer();
  UniformBuffer(UniformBuffer&& o) noexcept { swap(o); }
  UniformBuffer& operator=(UniformBuffer&& o) noexcept {
    UniformBuffer t(std::move(o));
    swap(t);
    return *this;
  }
  void upload(const void* data, std::size_t bytes);
  void bind(GLuint binding) const { gl_->BindBufferBase(GL_UNIFORM_BUFFER, binding, id_); }
  explicit operator bool() const { return id_ != 0; }

 private:
  void swap(UniformBuffer& o) noexcept {
    std::swap(gl_, o.gl_);
    std::swap(id_, o.id_);
  }
  const Api* gl_ = nullptr;
  GLuint id_ = 0;
};

// Owns the empty vertex array that full-screen triangles are drawn with.
class VertexArray {
 public:
  VertexArray() = default;
  explicit VertexArray(const Api& gl) : gl_(&gl) { gl.GenVertexArrays(1, &id_); }
  ~VertexArray() {
    if (gl_) gl_->DeleteVertexArrays(1, &id_);
  }
  VertexArray(VertexArray&& o) noexcept { swap(o); }
  VertexArray& operator=(VertexArray&& o) noexcept {
    VertexArray t(std::move(o));
    swap(t);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  void swap(VertexArray& o) noexcept {
    std::swap(gl_, o.gl_);
    std::swap(id_, o.id_);
  }
  const Api* gl_ = nullptr;
  GLuint id_ = 0;
};

// The "#version" line and precision statements that begin every shader of this context.
std::string versionHeader(const Api& gl);

}  // namespace welkin::gl
