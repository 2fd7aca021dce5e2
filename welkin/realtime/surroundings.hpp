#pragma once
// What is cached round the eye: weather and light. Views whose eyes stand close together share it, others have their
// own, so that none spoils another's.
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "welkin/realtime/light_volume.hpp"
#include "welkin/realtime/weather_levels.hpp"

namespace welkin::realtime {

struct Eye {
  glm::dvec2 place{0.0};  // where its view was drawn last, m
};

struct Surroundings {
  std::unique_ptr<WeatherLevels> weather;
  std::unique_ptr<LightVolume> light;
  int weatherNumber = -1, skyNumber = -1;  // of the renderer's, for which they were made
  int waited = 0;                          // frames in which the light has waited for changing weather
  std::vector<std::weak_ptr<const Eye>> eyes;
};

// Knows those that are in use; the views own them.
class SurroundingsPool {
 public:
  // For an eye at `place` (m) that had `current` (or none) before: the same again unless another eye that uses it is
  // too far away by now.
  std::shared_ptr<Surroundings> of(const std::shared_ptr<Eye>& eye, const std::shared_ptr<Surroundings>& current,
                                   const glm::dvec2& place);

 private:
  std::vector<std::weak_ptr<Surroundings>> known_;
};

}  // namespace welkin::realtime
