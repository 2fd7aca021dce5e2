#pragma once
// Holds the time of a frame by trading quality for it. Plain arithmetic: it knows no OpenGL, and what it answers goes
// to Renderer::setQuality().
#include <deque>
#include <optional>
#include <vector>

#include "welkin/scene/quality.hpp"

namespace welkin::realtime {

// What a frame of this quality costs against one of quality high, the sky being the same: an estimate from the passes
// of bench/governor.cpp, which the governor corrects by what it sees.
double relativeCost(const Quality& quality);

struct GovernorSettings {
  double target = 1.0 / 60.0;  // s a frame, of what is measured
  Quality best = qualityPreset(QualityPreset::high);
  Quality worst = coarsest();
  float leastScale = 1.0f;  // of the picture's width and height, for hosts that can draw at scale(); 0.25 to 1

  // Quality low with a history of a quarter of the picture's width and light that takes its time.
  static Quality coarsest();
};

// Between `best` and `worst` lie rungs that differ in frames for light, step scale, light steps, interleave and history
// scale: what can be changed from one frame to the next with no shader or table made anew, and in the picture's own
// resolution where `leastScale` allows it. All other switches stay as in `best`.
class Governor {
 public:
  // Throws Error (badInput) when the target is not a positive number of seconds.
  explicit Governor(const GovernorSettings& settings);

  // Takes the time of the last frame, s: of all that shall keep the target, without waiting for the screen. It may come
  // some frames late, as GPU timers do. Returns whether quality() is another one from now on. Numbers that are no times
  // are passed over.
  bool take(double seconds);
  // The view has been reset: what the next frames cost says nothing of those after them. Single long frames need no
  // word, they are seen through.
  void cut();
  // Goes on toward another target, s. Throws as the constructor.
  void setTarget(double seconds);

  const Quality& quality() const { return rungs_[rung_]; }
  // Share of the picture's width and height at which it is to be drawn; 1 unless the settings allow less.
  float scale() const { return scales_[rung_]; }
  double target() const { return target_; }
  const std::vector<Quality>& rungs() const { return rungs_; }  // from the best to the worst
  std::size_t rung() const { return rung_; }

 private:
  double cost(std::size_t rung) const {
    return relativeCost(rungs_[rung]) * static_cast<double>(scales_[rung] * scales_[rung]);
  }
  double predicted(double now, std::size_t rung, double rest) const;
  double medianOfLast(std::size_t frames) const;
  void learn();
  void go(std::size_t rung);

  std::vector<Quality> rungs_;
  std::vector<float> scales_;  // of each
  std::size_t rung_ = 0;
  double target_;
  std::deque<double> times_;  // of the last frames at this rung, without those that came too early to be its own
  std::size_t stood_ = 0;     // frames at this rung in all
  int skip_;                  // frames that are yet to be passed over
  double rest_ = 0.0;         // s, the share of a frame that no switch changes
  struct Change {
    double before, cost;  // s, and relative cost of the rung it came from
  };
  std::optional<Change> change_;  // the last one, until its effect is known
  // A rung that proved too dear soon after it was climbed is tried again later and later.
  bool climbed_ = false;
  std::size_t patience_ = 1;
};

}  // namespace welkin::realtime
