#pragma once
// The light volume: optical depth toward the sun, and the light that has lost its direction in the clouds, on a lattice
// in nested squares round the camera (light_volume.glsl says what it means). It stands in for the far part of the
// march's steps toward the light, and lights ground and air below the clouds.
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "welkin/density/clip_levels.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/scene/quality.hpp"

namespace welkin::realtime {

class LightVolume {
 public:
  LightVolume(const gl::Api& gl, QualityPreset preset);

  // For positions relative to `position`, with clouds between these altitudes (m); `scene` changes with the clouds.
  // Levels that have to be made anew are found here and made by draw().
  law::LightVolumeParams place(const glm::dvec2& position, const Drift& drift, const Shell& shell,
                               const glm::vec3& sunDirection, int scene);
  // Whether draw() has anything to do.
  bool stale() const;
  // Makes what place() has found out of date, coarse levels first. `density`: shaders/light_density.frag.glsl with the
  // clouds' blocks and textures bound, on units below 10. Leaves framebuffer, program and viewport changed.
  // `sheets`: shaders/light_sheets.frag.glsl with the same blocks, where there are sheets, whose heights (m) the vector
  // gives.
  void draw(const gl::Program& density, const gl::Program& sheets, const glm::vec4& sheetHeights,
            gl::Framebuffer& framebuffer);

  QualityPreset preset() const { return preset_; }
  const gl::Texture& sun() const { return sun_; }          // optical depth toward the sun
  const gl::Texture& diffuse() const { return diffuse_; }  // light without direction
  // With what only its own passes use.
  std::vector<std::pair<const char*, const gl::Texture*>> textures() const;

 private:
  struct Level {
    glm::dvec2 centre{0.0};  // in the air's own frame, which drifts with the wind
    glm::dvec2 before{0.0};  // its centre when `diffuse` was made
    bool fresh = false, known = false;
  };
  void fillDensity(const gl::Program& program, gl::Framebuffer& framebuffer, int level);
  void fillSheets(const gl::Program& program, gl::Framebuffer& framebuffer, int level);
  void fillSun(const glm::vec4& sheetHeights, gl::Framebuffer& framebuffer, int level);
  void fillDiffuse(gl::Framebuffer& framebuffer, int level);
  void use(const gl::Program& program, int level);
  void sunUniform(const gl::Program& program) const;
  void slice(const gl::Program& program, int number) const;
  void bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const;
  void copy(int target, const gl::Texture& to, int slice) const;
  glm::vec4 square(const glm::dvec2& centre, int level, float w) const;

  const gl::Api& gl_;
  QualityPreset preset_;
  WeatherExtent extent_;  // squares and their texels
  int slices_;            // of a level, from the bottom of the clouds to their top
  gl::Texture density_, sun_, diffuse_;
  gl::Texture sheets_;         // light_sheets.frag.glsl
  gl::Texture share_, steps_;  // light_diffusion.frag.glsl and light_sun.frag.glsl, which uses both by turns
  std::array<gl::Texture, 2> scalarSlice_, lightSlice_;
  gl::Program sunPass_, startPass_, diffusionPass_, columnPass_;
  gl::UniformBuffer block_;
  std::vector<Level> levels_;
  // What the levels were made for.
  Shell shell_{};
  glm::vec3 sunward_{0.0f};
  double time_ = 0.0;
  int scene_ = -1;
  // Of the last place().
  glm::dvec2 inAir_{0.0};
  law::LightVolumeParams params_{};
};

}  // namespace welkin::realtime
