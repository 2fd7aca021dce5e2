#pragma once
// The passes of rain and snow: what the march sees of them far away, and near the eye a map of what falls at the
// ground, the light there, and the drops and flakes themselves (drops.hpp). Like gl/objects.hpp, for .cpp files only.
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "welkin/gl/objects.hpp"
#include "welkin/realtime/drops.hpp"
#include "welkin/realtime/light_volume.hpp"

namespace welkin::realtime {

// Of the picture of rain along a view's rays, for a target of such a size of which a ray is marched in every
// `marched` pixels.
glm::ivec2 rainPictureSize(int width, int height, int marched);

inline constexpr float kRainMapEdge = 8000.0f;  // m

// What the renderer has bound and made for its own march.
struct FallingInputs {
  const gl::UniformBuffer &layers, &march;
  std::function<void(const gl::Program& program, int unit)> bindClouds;  // on this unit and those after it
  const gl::Texture& transmittance;
  const LightVolume* light;  // null: none
};

class FallingPass {
 public:
  explicit FallingPass(const gl::Api& gl);

  // For clouds of this text (renderer.cpp, makeMarch); `lit`: whether there is a light volume. Quick where nothing has
  // changed.
  void compile(const std::string& clouds, bool lit);

  // The map and the light round the eye; `wind` carries the clouds, m/s. Leaves framebuffer, program and viewport
  // changed.
  void drawMap(const FallingInputs& inputs, gl::Framebuffer& framebuffer, const glm::dvec2& wind);

  // What the drops of a frame need to know besides.
  struct Drops {
    const Frame& frame;
    const FrameParams& view;  // not locked to the history's grid
    const gl::UniformBuffer& frameBlock;
    DropLevels levels;
    glm::dvec3 eye;  // in the world of the clouds, m
    glm::dvec3 up;   // away from the planet's centre
    float altitude;  // m
    glm::vec3 toSun;
    glm::dvec2 wind;      // near the ground, m/s
    glm::dvec3 velocity;  // of the eye, east-north-up, m/s
    float rate;           // mm/h for which there are all drops
    float shutter;        // s
    int most;
    gl::Framebuffer& framebuffer;  // for what is drawn in between
  };
  // Over the frame's target, which is left bound. Returns how many drops were drawn.
  int drawDrops(const Drops& drops);

  // The view's rain and snow along its rays, for the march (rain_segments.glsl): into `picture`, with the frame's block
  // `frame`.
  void drawSegments(const FallingInputs& inputs, gl::Framebuffer& framebuffer, const gl::UniformBuffer& frame,
                    const gl::Texture& picture);

  const gl::Texture& map() const { return map_; }
  // All of it, with their names for a table of memory.
  std::vector<std::pair<const char*, const gl::Texture*>> textures() const;

 private:
  void bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const;
  void keepCells(const std::vector<glm::vec4>& cells);
  void place(const std::vector<glm::vec4>& cells, const gl::Program& program, const Drops& drops);
  const gl::Program& program(std::map<std::string, gl::Program>& variants, const std::string& defines,
                             const char* fragment, const char* vertex) const;

  const gl::Api& gl_;
  gl::Texture map_, light_, cells_, places_, lights_, sizes_;
  gl::Program mapProgram_, lightProgram_, segmentsProgram_;
  std::map<std::string, gl::Program> placePrograms_, dropsPrograms_;  // by the defines of the variant
  gl::UniformBuffer buffer_;
  std::string text_;
};

}  // namespace welkin::realtime
