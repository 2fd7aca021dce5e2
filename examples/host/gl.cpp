#include "gl.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <stdexcept>

namespace host {

void* getProcAddress(const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

Gl openContext() {
  const auto getDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  EGLDisplay display =
      getDisplay ? getDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr) : eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (!eglInitialize(display, nullptr, nullptr)) throw std::runtime_error("no EGL display");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, nullptr, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    throw std::runtime_error("no OpenGL 3.3 context");
  Gl gl;
#define HOST_GL_LOAD(UPPER, Name)                                             \
  gl.Name = reinterpret_cast<PFNGL##UPPER##PROC>(getProcAddress("gl" #Name)); \
  if (!gl.Name) throw std::runtime_error("gl" #Name " is missing");
  HOST_GL_FUNCTIONS(HOST_GL_LOAD)
#undef HOST_GL_LOAD
  GLint major = 0, minor = 0, extensions = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  gl.GetIntegerv(GL_NUM_EXTENSIONS, &extensions);
  bool clips = major * 10 + minor >= 45;
  for (GLint i = 0; i < extensions; ++i)
    clips = clips || std::strcmp(reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))),
                                 "GL_ARB_clip_control") == 0;
  if (clips) gl.ClipControl = reinterpret_cast<PFNGLCLIPCONTROLPROC>(getProcAddress("glClipControl"));
  return gl;
}

static GLuint compiled(const Gl& gl, GLenum stage, const std::string& text) {
  const GLuint shader = gl.CreateShader(stage);
  const char* source = text.c_str();
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint ok = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  char log[4096] = "";
  if (!ok) gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  if (!ok) throw std::runtime_error(log);
  return shader;
}

GLuint makeProgram(const Gl& gl, const std::string& vertex, const std::string& fragment) {
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, compiled(gl, GL_VERTEX_SHADER, vertex));
  gl.AttachShader(program, compiled(gl, GL_FRAGMENT_SHADER, fragment));
  gl.LinkProgram(program);
  GLint ok = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
  char log[4096] = "";
  if (!ok) gl.GetProgramInfoLog(program, sizeof log, nullptr, log);
  if (!ok) throw std::runtime_error(log);
  return program;
}

}  // namespace host
