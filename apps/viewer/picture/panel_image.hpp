#pragma once
// A picture that a panel shows.
#include <cstdint>
#include <span>

#include "apps/viewer/ui/interface.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::viewer {

class PanelImage {
 public:
  explicit PanelImage(const gl::Api& gl) : gl_(gl) {}

  // RGBA, rows from the top.
  void set(int width, int height, std::span<const std::uint8_t> rgba);
  // For ImGui's draw lists.
  ImTextureID texture() const;
  explicit operator bool() const { return static_cast<bool>(texture_); }

 private:
  const gl::Api& gl_;
  gl::Texture texture_;
};

}  // namespace welkin::viewer
