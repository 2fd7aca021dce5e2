#include "apps/viewer/picture/screenshot.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "welkin/gl/state.hpp"
#include "welkin/io/png.hpp"

namespace welkin::viewer {

void savePngOf(const gl::Api& gl, unsigned framebuffer, int width, int height, const std::string& path) {
  const std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::vector<std::uint8_t> rgba(w * h * 4), rgb(w * h * 3);
  {
    const gl::StateGuard guard(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.ReadBuffer(framebuffer ? GL_COLOR_ATTACHMENT0 : GL_BACK);
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    gl.check("reading the window back");
  }
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x)
      std::copy_n(rgba.data() + ((h - 1 - y) * w + x) * 4, 3, rgb.data() + (y * w + x) * 3);
  savePng(path, width, height, 3, rgb);
}

}  // namespace welkin::viewer
