#pragma once
#include <string>

#include "welkin/gl/api.hpp"

namespace welkin::viewer {

// What a framebuffer of 8 bits shows, as a PNG. Throws Error (failed).
void savePngOf(const gl::Api& gl, unsigned framebuffer, int width, int height, const std::string& path);

}  // namespace welkin::viewer
