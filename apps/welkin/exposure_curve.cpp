#include "apps/welkin/exposure_curve.hpp"

#include <algorithm>
#include <cmath>

#include "welkin/base/tone.hpp"

namespace welkin::app {

namespace {

constexpr double kEvery = 0.5;   // s between readings, at least
constexpr double kSpread = 0.7;  // s: standard deviation of the smoothing

}  // namespace

ExposureCurve::ExposureCurve(const Shot& shot, const std::function<Image(int frame)>& picture) {
  const int step = std::max(1, static_cast<int>(std::lround(kEvery * shot.framesPerSecond)));
  for (int frame = 0;; frame = std::min(frame + step, shot.frames - 1)) {
    if (shot.at(frame).film.exposure == ExposureMode::automatic)
      readings_.push_back({shot.secondsAt(frame), automaticEv(picture(frame))});
    if (frame == shot.frames - 1) break;
  }
}

double ExposureCurve::ev(const Film& film, double seconds) const {
  if (film.exposure == ExposureMode::manual || readings_.empty()) return film.ev;
  double sum = 0.0, weights = 0.0;
  for (const Reading& r : readings_) {
    const double away = (r.seconds - seconds) / kSpread, weight = std::exp(-0.5 * away * away) + 1e-30;
    sum += weight * r.ev;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace welkin::app
