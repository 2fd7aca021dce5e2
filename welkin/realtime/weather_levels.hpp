#pragma once
// Clip levels of the weather: nested squares round the camera in one texture array, made anew when the camera leaves
// the middle of a level or the weather changes.
#include <array>
#include <glm/vec2.hpp>

#include "welkin/density/params.hpp"
#include "welkin/gl/objects.hpp"

namespace welkin::realtime {

// Size of the cached weather.
struct WeatherExtent {
  int texels = 512;
  int levels = 4;
  double finest = 20000.0;  // m, edge of level 0
  double ratio = 2.6;       // each level against the one before
};

class WeatherLevels {
 public:
  WeatherLevels(const gl::Api& gl, const WeatherExtent& extent);

  // Makes what is missing for a camera at `position`. `map`: the layer's authoring picture (a white texel if none).
  // Returns the number of levels drawn. Leaves framebuffer, program and viewport changed.
  int update(const Layer& layer, const glm::dvec2& position, const Drift& drift, int seed, const gl::Program& program,
             gl::Framebuffer& framebuffer, gl::UniformBuffer& buffer, const gl::Texture& map);
  void invalidate() { fresh_.fill(false); }

  // For positions relative to `position`.
  law::ClipParams params(const glm::dvec2& position, const Drift& drift) const;
  const gl::Texture& texture() const { return texture_; }

 private:
  double edge(int level) const;
  const gl::Api& gl_;
  WeatherExtent extent_;
  gl::Texture texture_;
  std::array<glm::dvec2, 4> centre_{};  // in the air's own frame, which drifts with the wind
  std::array<bool, 4> fresh_{};
};

}  // namespace welkin::realtime
