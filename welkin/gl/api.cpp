#include "welkin/gl/api.hpp"

#include <fmt/format.h>

#include <cstring>

#include "welkin/base/error.hpp"

namespace welkin::gl {

namespace {

template <class Function>
void load(const Loader& loader, const char* name, Function& function) {
  function = reinterpret_cast<Function>(loader(name));
}

}  // namespace

Api loadApi(const Loader& loader) {
  Api gl;
  std::string missing;
#define WELKIN_GL_LOAD(UPPER, Name)  \
  load(loader, "gl" #Name, gl.Name); \
  if (!gl.Name) missing += missing.empty() ? "gl" #Name : ", gl" #Name;
  WELKIN_GL_FUNCTIONS(WELKIN_GL_LOAD)
#undef WELKIN_GL_LOAD
#define WELKIN_GL_LOAD(UPPER, Name) load(loader, "gl" #Name, gl.Name);
  WELKIN_GL_OPTIONAL_FUNCTIONS(WELKIN_GL_LOAD)
#undef WELKIN_GL_LOAD
  if (!gl.GetString || !gl.GetString(GL_VERSION))
    throw Error(ErrorKind::noOpenGl, "", "no OpenGL context is current on this thread; make one current first");
  const char* version = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  gl.es = std::strncmp(version, "OpenGL ES", 9) == 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &gl.major);
  gl.GetIntegerv(GL_MINOR_VERSION, &gl.minor);
  const int have = gl.major * 10 + gl.minor, need = gl.es ? 30 : 33;
  if (have < need)
    throw Error(ErrorKind::noOpenGl, "",
                fmt::format("the context is \"{}\", but Welkin needs OpenGL 3.3 or OpenGL ES 3.0", version));
  if (!missing.empty())
    throw Error(ErrorKind::noOpenGl, "", fmt::format("\"{}\" lacks the functions {}", version, missing));
  if (gl.es && !gl.hasExtension("GL_EXT_color_buffer_float") && !gl.hasExtension("GL_EXT_color_buffer_half_float"))
    throw Error(ErrorKind::noOpenGl, "",
                fmt::format("\"{}\" cannot render to float textures (EXT_color_buffer_float is missing)", version));
  return gl;
}

bool Api::hasExtension(const char* name) const {
  GLint count = 0;
  GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
    if (std::strcmp(reinterpret_cast<const char*>(GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))), name) == 0)
      return true;
  return false;
}

std::string Api::driver() const {
  const GLubyte* text = GetString(GL_RENDERER);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

bool Api::software() const {
  const std::string name = driver();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

void Api::check(const char* doing) const {
  const GLenum error = GetError();
  if (error != GL_NO_ERROR)
    throw Error(ErrorKind::failed, "", fmt::format("OpenGL reported error 0x{:04x} while {}", error, doing));
}

}  // namespace welkin::gl
