#pragma once
// Clip levels of the weather: nested squares round the camera in two texture arrays, those of all cloud layers one
// after the other, made anew when the camera leaves the middle of a level or the weather changes.
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "welkin/density/clip_levels.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/scene/quality.hpp"

namespace welkin::realtime {

WeatherExtent weatherExtent(QualityPreset preset);

class WeatherLevels {
 public:
  static constexpr int kAll = 1 << 20;

  // `onProcessor`: layers without an authoring picture are made by bakeWeather and uploaded, which is faster where the
  // driver draws on the processor too.
  WeatherLevels(const gl::Api& gl, const WeatherExtent& extent, int layers, bool onProcessor);

  // Whether the weather of so many layers would be kept in the same textures.
  bool fits(const WeatherExtent& extent, int layers) const;
  // The layers have changed: every level is out of date, and is shown until its turn comes.
  void change();
  // Whether there are levels from before the last change().
  bool changing() const;

  // Makes what layer `index` lacks for a camera at `position`: all levels that are of no use there and, of those that
  // have but to be brought up to date, so many (`most`), those that have waited longest. `map`: its authoring picture
  // (a white texel if none). On the processor levels that have moved on are made a block with each call, unless all are
  // asked for. Returns the number of levels drawn. Leaves framebuffer, program and viewport changed.
  int update(int index, const Layer& layer, const glm::dvec2& position, const Drift& drift, int seed,
             const gl::Program& program, gl::Framebuffer& framebuffer, gl::UniformBuffer& buffer,
             const gl::Texture& map, int most = kAll);

  // For positions relative to `position`.
  law::ClipParams params(int index, const glm::dvec2& position, const Drift& drift) const;
  // (height or coverage, base shift or type) and (anvil or precipitation, precipitation or base shift).
  const gl::Texture& main() const { return main_; }
  const gl::Texture& extra() const { return extra_; }
  // Between which altitudes above the layer's base a block of texels has clouds: shaders/weather_bounds.frag.glsl.
  const gl::Texture& bounds() const { return bounds_; }

 private:
  struct Level {
    glm::dvec2 centre{0.0};  // in the air's own frame, which drifts with the wind
    bool shown = false;      // holds weather
    bool changed = false;    // from before the last change
    long drawn = 0;          // when, counted in levels
  };
  // A level on its way, made on the processor.
  struct Job {
    int slice = 0, block = 0;
    glm::dvec2 centre{0.0};
    Volume weather;
  };
  double away(int level, const Level& cached, const glm::dvec2& inAir) const;
  void fill(int level, int slice, const Layer& layer, const Drift& drift, int seed, const gl::Program& program,
            gl::Framebuffer& framebuffer, gl::UniformBuffer& buffer, const gl::Texture& map);
  // Goes on with the job; returns whether its level is drawn.
  bool goOn(int level, const Layer& layer, const Drift& drift, int seed, gl::Framebuffer& framebuffer);
  void upload(int slice, const Volume& weather);
  void fillBounds(const Layer& layer, int level, int slice, gl::Framebuffer& framebuffer);

  const gl::Api& gl_;
  WeatherExtent extent_;
  bool onProcessor_;
  gl::Texture main_, extra_, bounds_;
  gl::Program boundsPass_;
  std::vector<Level> levels_;  // layer by layer
  long count_ = 0;             // of levels drawn
  std::optional<Job> job_;
};

}  // namespace welkin::realtime
