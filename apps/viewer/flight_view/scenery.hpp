#pragma once
// Land, airfield and aircraft as the sky's foreground.
#include "apps/viewer/flight/flight.hpp"
#include "apps/viewer/flight_view/land_mesh.hpp"
#include "apps/viewer/flight_view/model_mesh.hpp"
#include "apps/viewer/picture/foreground.hpp"
#include "welkin/gl/objects.hpp"

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

  // Of the air over the sea, m/s.
  void setWind(const Wind& wind) { wind_ = wind; }

  void drawSurfaces(const realtime::Frame& frame, const Bind& bind) override;
  void drawGlass(const realtime::Frame& frame, const Bind& bind) override;

 private:
  void drawLand(const realtime::Frame& frame, const Bind& bind);
  void drawModels(const realtime::Frame& frame, const Bind& bind);

  const gl::Api& gl_;
  const Flight& flight_;
  gl::Program land_, model_, propeller_;
  LandMesh mesh_;
  ModelBuffer aircraft_, airfield_;
  gl::VertexArray none_;
  Wind wind_;
};

}  // namespace welkin::viewer
