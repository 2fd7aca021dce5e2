#include "welkin/gl/context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <cstring>

#include "welkin/base/error.hpp"

namespace welkin::gl {

struct Context::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  Loader loader;
  ~State() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }
};

namespace {

[[noreturn]] void refuse(const char* step) {
  throw Error(ErrorKind::noOpenGl, "",
              fmt::format("no OpenGL: {} failed (EGL error 0x{:04x}); install Mesa's software driver "
                          "(Debian: apt-get install libegl1 libgl1-mesa-dri) or check the graphics driver",
                          step, static_cast<unsigned>(eglGetError())));
}

EGLDisplay openDisplay() {
  const auto getPlatformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (getPlatformDisplay && extensions && std::strstr(extensions, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display = getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) refuse("opening an EGL display");
  return display;
}

}  // namespace

Context::Context(ContextKind kind) : state_(std::make_unique<State>()) {
  state_->display = openDisplay();
  const bool es = kind == ContextKind::es;
  if (!eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API)) refuse("eglBindAPI");
  const EGLint configAttributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                     es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(state_->display, configAttributes, &config, 1, &count) || count == 0) config = nullptr;
  const EGLint desktop[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLint embedded[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
  state_->context = eglCreateContext(state_->display, config, EGL_NO_CONTEXT, es ? embedded : desktop);
  if (state_->context == EGL_NO_CONTEXT)
    refuse(es ? "creating an OpenGL ES 3 context" : "creating an OpenGL 3.3 context");
  if (!eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context))
    refuse("making the context current without a surface");
  state_->loader = [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); };
}

Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
const Loader& Context::loader() const { return state_->loader; }

}  // namespace welkin::gl
