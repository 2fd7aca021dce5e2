#pragma once
// The light volume: optical depth toward the sun, and the light that has lost its direction in the clouds, on a lattice
// in nested squares round the camera (light_volume.glsl says what it means). It stands in for the far part of the
// march's steps toward the light, and lights ground and air below the clouds.
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "welkin/density/clip_levels.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/scene/quality.hpp"

namespace welkin::realtime {

// What draws clouds into the volume: shaders/light_density.frag.glsl and, where there are sheets,
// light_sheets.frag.glsl, with the clouds' blocks and textures bound, on units below 10; and the sheets' heights, m.
struct CloudPasses {
  const gl::Program& density;
  const gl::Program& sheets;
  glm::vec4 sheetHeights;
};

class LightVolume {
 public:
  LightVolume(const gl::Api& gl, QualityPreset preset);

  // What it shall be for: positions relative to `position`, clouds between these altitudes (m); `scene` changes with
  // the clouds. Levels that have to be made anew are found here and made by draw().
  void place(const glm::dvec2& position, const Drift& drift, const Shell& shell, const glm::vec3& sunDirection,
             int scene);
  // Nothing that it holds is of use any more: other clouds altogether.
  void forget();
  // Whether draw() has anything to do.
  bool stale() const;
  // Whether there is a level without light that is of any use; with `standIn`, only of the coarsest, which can stand in
  // for the others.
  bool lost(bool standIn) const;
  // How often a level has been shown that does not go on from the light that it had.
  int jumps() const { return jumps_; }
  // Makes what place() has found out of date, a share of a level with each call; `frames` calls for a level, 1: all of
  // it at once. A level keeps its old light until the new one is complete. While light is lost(standIn) it is made at
  // once.
  // Leaves framebuffer, program and viewport changed.
  void draw(const CloudPasses& clouds, gl::Framebuffer& framebuffer, int frames, bool standIn);
  // What is there, for positions relative to that of the last place().
  law::LightVolumeParams params() const;

  QualityPreset preset() const { return preset_; }
  const gl::Texture& sun() const { return sun_; }          // optical depth toward the sun
  const gl::Texture& diffuse() const { return diffuse_; }  // light without direction
  const gl::Texture& below() const { return below_; }      // what of it comes down below the clouds, a slice a level
  // With what only its own passes use.
  std::vector<std::pair<const char*, const gl::Texture*>> textures() const;

 private:
  // What a level is made for.
  struct Purpose {
    glm::dvec2 centre{0.0};  // in the air's own frame, which drifts with the wind
    glm::vec3 sunward{0.0f};
    double time = 0.0;
    int version = -1;  // of clouds and sun; not newer than that of the coarser level that it leans on
  };
  struct Level : Purpose {
    bool shown = false;  // holds light
  };
  enum class Phase { density, sun, start, down, up, publish };
  // A level on its way: where it stands, a run of slices at a time.
  struct Job : Purpose {
    int level = 0;
    bool known = false;  // starts from the light that it had
    Phase phase = Phase::density;
    int round = 0, slice = 0;
  };

  bool outOfDate(int level) const;
  bool useless(int level) const;
  double away(int level) const;
  int doublings() const;
  float firstStep() const;
  Job nextJob();
  // Goes on with the job, over at most so much work (costs of the passes in light_volume.cpp); returns what is left.
  double go(const CloudPasses& clouds, gl::Framebuffer& framebuffer, double work);
  void fillDensity(const gl::Program& program, gl::Framebuffer& framebuffer, int count);
  void fillSheets(const gl::Program& program, gl::Framebuffer& framebuffer);
  void fillSun(const glm::vec4& sheetHeights, gl::Framebuffer& framebuffer, int count, int doublings);
  void start(gl::Framebuffer& framebuffer, int count);
  void lightBetween(gl::Framebuffer& framebuffer);
  void diffuseDown(gl::Framebuffer& framebuffer, int count);
  void passOn(const gl::Program& program, const char* before, gl::Framebuffer& framebuffer, int s);
  void diffuseUp(gl::Framebuffer& framebuffer, int count);
  void lightBelow(gl::Framebuffer& framebuffer);
  void draw(const gl::Program& program, gl::Framebuffer& framebuffer, const gl::Texture& plane) const;
  void publish(gl::Framebuffer& framebuffer);
  void use(const gl::Program& program);
  void sunUniform(const gl::Program& program) const;
  void slice(const gl::Program& program, int number) const;
  void bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const;
  void copy(int target, const gl::Texture& to, int slice) const;
  glm::vec4 square(const glm::dvec2& centre, int level, float w) const;
  glm::vec4 coarser(int level) const;

  const gl::Api& gl_;
  QualityPreset preset_;
  WeatherExtent extent_;               // squares and their texels
  int slices_;                         // of a level, from the bottom of the clouds to their top
  gl::Texture sun_, diffuse_, below_;  // all levels
  // Of the level that is being made: light_density, light_sheets (where there are sheets), light_sun (whose last
  // doubling ends in steps_), light_diffusion; light_faces and light_sides, a texel for a slice.
  gl::Texture density_, sheets_, steps_, share_, light_, faces_, sides_;
  std::array<gl::Texture, 2> scalarSlice_, lightSlice_;
  gl::Program sunPass_, startPass_, diffusionPass_, columnPass_, belowPass_, groundPass_, facesPass_, sidesPass_;
  gl::UniformBuffer block_;
  std::vector<Level> levels_;
  std::optional<Job> job_;
  double due_ = 0.0;  // work of this frame; below 0: done ahead of the next ones
  int last_ = 0;      // level that was made last; coarse ones come before finer ones, then coarse ones again
  // Of the last place().
  Purpose wanted_;
  Shell shell_{};
  int scene_ = -1, jumps_ = 0;
  glm::dvec2 inAir_{0.0};
};

}  // namespace welkin::realtime
