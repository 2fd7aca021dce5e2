#pragma once
#include <functional>

namespace welkin::gl {

// Answers the address of an OpenGL function, as eglGetProcAddress, glXGetProcAddress, SDL_GL_GetProcAddress do.
using Loader = std::function<void*(const char* name)>;

}  // namespace welkin::gl
