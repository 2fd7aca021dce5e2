#pragma once
// Land, airfield and aircraft as the sky's foreground.
#include <array>

#include "apps/viewer/flight/flight.hpp"
#include "apps/viewer/flight_view/land_mesh.hpp"
#include "apps/viewer/flight_view/model_mesh.hpp"
#include "apps/viewer/picture/foreground.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/scene/rain.hpp"

namespace welkin::viewer {

// Triangles on the GPU.
class ModelBuffer {
 public:
  ModelBuffer(const gl::Api& gl, const ModelMesh& mesh);
  ~ModelBuffer();
  ModelBuffer(const ModelBuffer&) = delete;
  ModelBuffer& operator=(const ModelBuffer&) = delete;
  void draw() const;

 private:
  const gl::Api& gl_;
  GLuint array_ = 0, buffers_[2] = {};
  GLsizei count_ = 0;
};

class Scenery final : public Foreground {
 public:
  // Both outlive it.
  Scenery(const gl::Api& gl, const Flight& flight);

  // The wind over the sea, and whether anything falls.
  void setScene(const Scene& scene) {
    wind_ = scene.wind;
    rains_ = rains(scene);
  }
  glm::dvec3 velocity() const override { return flight_.aircraft().velocity; }

  void drawSurfaces(const realtime::Frame& frame, const Target& target, const Bind& bind) override;
  void drawGlass(const realtime::Frame& frame, const Bind& bind) override;

 private:
  void drawShape(const realtime::Frame& frame, const Target& target, const LandMesh::Blocks& blocks);
  void drawLand(const realtime::Frame& frame, const Target& target, const Bind& bind);
  const gl::Program& landProgram(LandKind kind);
  void drawModels(const realtime::Frame& frame, const Target& target, const Bind& bind);
  void drawModel(const ModelBuffer& model, const glm::vec3& origin, const glm::mat3& worldFromModel,
                 const realtime::Frame& frame, const Target& target, const Bind& bind);

  const gl::Api& gl_;
  const Flight& flight_;
  std::array<std::array<gl::Program, 2>, kLandKinds> land_;  // dry, and where it rains; compiled when first needed
  gl::Program shape_, place_, model_, propeller_;
  LandMesh mesh_;
  ModelBuffer aircraft_, airfield_;
  gl::Texture light_;  // at a model's place
  gl::VertexArray none_;
  gl::Texture along_;  // the view's way to the land, m
  gl::Framebuffer shapes_, lights_;
  Wind wind_;
  bool rains_ = false;
};

}  // namespace welkin::viewer
