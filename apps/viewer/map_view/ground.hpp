#pragma once
// A map as the sky's foreground: the ground, curved as the planet is, with a picture on it and the clouds' shadows.
#include <glm/vec3.hpp>

#include "apps/viewer/model/map_picture.hpp"
#include "apps/viewer/picture/foreground.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::viewer {

class MapGround final : public Foreground {
 public:
  static constexpr int kLargest = 8192;  // texels a side; larger pictures are halved

  MapGround(const gl::Api& gl, MapPicture map);
  const MapPicture& map() const { return map_; }
  // Albedo of the land beyond the picture.
  void setSurroundings(const glm::vec3& albedo) { surroundings_ = albedo; }

  glm::dvec3 velocity() const override { return glm::dvec3(0.0); }
  void drawSurfaces(const realtime::Frame& frame, const Target& target, const Bind& bind) override;
  void drawGlass(const realtime::Frame& /*frame*/, const Bind& /*bind*/) override {}

 private:
  void upload();

  const gl::Api& gl_;
  MapPicture map_;  // its pixels are let go once the texture has them
  gl::Program program_;
  gl::Texture texture_;
  gl::VertexArray none_;
  glm::vec3 surroundings_{0.1f};
};

}  // namespace welkin::viewer
