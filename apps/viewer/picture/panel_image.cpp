#include "apps/viewer/picture/panel_image.hpp"

#include "welkin/gl/state.hpp"

namespace welkin::viewer {

void PanelImage::set(int width, int height, std::span<const std::uint8_t> rgba) {
  const gl::StateGuard guard(gl_);
  texture_ = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba8, width, height, 0, gl::Filter::linear,
                         gl::Addressing::clamp, rgba.data());
}

ImTextureID PanelImage::texture() const {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's backend takes a texture's name as a pointer.
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_.id()));
}

}  // namespace welkin::viewer
