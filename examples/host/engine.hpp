#pragma once
// The host's engine: y points up, depth is reversed and infinite, light is linear and exposed. A land and a glass disc
// with a grid, high up, where an airspace begins.
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gl.hpp"

namespace host {

struct Eye {
  glm::dvec3 position{0.0};  // east, up, south in m
  double heading = 0.0;      // rad, clockwise from north
  double pitch = 0.0;        // rad, above the horizon
  double fov = 1.1;          // rad, across
  glm::mat4 view() const;    // without the position
};

// What an eye's picture is drawn into.
struct Target {
  Target(const Gl& gl, int width, int height);
  int width, height;
  GLuint colour = 0, depth = 0;  // textures
  GLuint all = 0;                // framebuffer with both
  GLuint colourOnly = 0;         // for passes that read the depth
};

class Engine {
 public:
  // `include`: text that declares what the shaders of land and glass call (see engine.cpp).
  Engine(const Gl& gl, const std::string& include);

  glm::mat4 projection(const Eye& eye, const Target& target) const;
  bool zeroToOne() const { return gl_.ClipControl != nullptr; }
  GLuint landProgram() const { return land_; }
  GLuint glassProgram() const { return glass_; }
  static constexpr float kExposure = 0.05f;  // from kcd/m^2 to what the screen shows as white

  void drawLand(const Eye& eye, const Target& target);
  void drawGlass(const Eye& eye, const Target& target);

  // RGB, 8 bits, top row first; each pixel the mean of four of the target's, against stairs.
  std::vector<unsigned char> shown(const Target& target) const;

 private:
  void use(GLuint program, const Eye& eye, const Target& target);
  const Gl& gl_;
  GLuint land_, glass_, vertices_ = 0, glassVertices_ = 0;
  GLsizei indices_ = 0;
};

// Height of the land in m, 0 at the sea; x points east, z south.
double landHeight(double x, double z);

}  // namespace host
