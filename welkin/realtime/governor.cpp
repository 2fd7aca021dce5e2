#include "welkin/realtime/governor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/base/error.hpp"

namespace welkin::realtime {

namespace {

// Shares of a frame of quality high, fitted to what the rungs cost on bench/governor.cpp's flight (llvmpipe): the
// march, where each near step toward the sun costs kPerLightStep of a point and longer steps save less than they skip;
// what every pixel of the history and of the picture costs. The light volume's, when a level takes 24 frames, is an
// estimate: in small pictures it is far more.
constexpr double kMarch = 0.64, kHistory = 0.17, kPicture = 0.11, kLight = 0.08, kPerLightStep = 0.12;
constexpr double kStepPower = 0.55;

constexpr int kCutFrames = 4;        // after a cut
constexpr int kLag = 3;              // frames after a change whose times may still be of those before
constexpr std::size_t kSpike = 5;    // the median of so many frames sees through two long ones
constexpr std::size_t kMild = 15;    // frames before a small excess counts
constexpr std::size_t kCalm = 24;    // frames before a better rung is tried
constexpr std::size_t kProof = 120;  // frames after which a climb has proved right
constexpr std::size_t kMostPatience = 16;
constexpr double kFarOver = 1.25, kOver = 1.03;      // times over the target that call for less
constexpr double kAimDown = 0.95, kAimUp = 0.9;      // where a change is meant to end
constexpr double kMostRest = 0.9;                    // share of a frame that may be out of reach
constexpr double kMostRestDown = 0.5;                // the same while time is short: too far down is put right soon
constexpr int kSlowLight = 96, kSlowestLight = 240;  // frames for a level of the light volume, at first and at last
constexpr double kStepRatio = 1.2;                   // between rungs that differ in step scale
constexpr float kScaleRatio = 0.84f;                 // between those that differ in resolution: 0.7 of the pixels

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Ladder {
  std::vector<Quality> rungs;
  std::vector<float> scales;
};

// From best to worst one switch after the other, in the order of what each loses for the time that it saves.
Ladder ladder(const Quality& best, const Quality& worst, float leastScale) {
  Ladder all{{best}, {1.0f}};
  Quality q = best;
  float scale = 1.0f;
  const auto push = [&] {
    if (scale == all.scales.back() && relativeCost(q) >= relativeCost(all.rungs.back())) return;
    all.rungs.push_back(q);
    all.scales.push_back(scale);
  };
  const auto pictureTo = [&](float least) {
    while (scale * kScaleRatio >= std::max(least, leastScale) * 0.99f) {
      scale *= kScaleRatio;
      push();
    }
  };
  const auto interleaveTo = [&](int most) {
    while (q.interleave < std::min(most, worst.interleave)) {
      q.interleave *= 2;
      push();
    }
  };
  const auto scaleTo = [&](int most) {
    while (q.historyScale < std::min(most, worst.historyScale)) {
      ++q.historyScale;
      // Where so much has to be saved, light must not take more than clouds.
      if (q.historyScale > 2) q.lightFrames = std::max(q.lightFrames, std::min(2 * q.lightFrames, worst.lightFrames));
      push();
    }
  };
  const auto stepsTo = [&](float most) {
    const float end = std::min(most, worst.stepScale);
    while (q.stepScale < end) {
      const float next = q.stepScale * static_cast<float>(kStepRatio);
      q.stepScale = next * 1.05f > end ? end : next;
      push();
    }
  };
  // Light that follows a little later is the last that anyone sees.
  while (q.lightVolume && q.lightFrames < std::min(kSlowLight, worst.lightFrames)) {
    q.lightFrames = std::min(4 * q.lightFrames, kSlowLight);
    push();
  }
  interleaveTo(2);
  stepsTo(1.0f);
  scaleTo(2);
  interleaveTo(4);
  stepsTo(1.2f);
  // Without the light volume each of them counts; with it a quarter of them.
  while (q.lightSteps > worst.lightSteps) {
    q.lightSteps = std::max(q.lightSteps - (q.lightVolume ? 4 : 1), worst.lightSteps);
    push();
  }
  pictureTo(0.84f);
  scaleTo(3);
  stepsTo(1.5f);
  pictureTo(0.7f);
  scaleTo(4);
  pictureTo(0.59f);
  stepsTo(worst.stepScale);
  pictureTo(0.5f);
  // Of so small a picture the clouds keep more, which costs little beside all else that a host draws.
  if (scale * kScaleRatio >= leastScale * 0.99f) q.historyScale = std::min(q.historyScale, 3);
  pictureTo(leastScale);
  return all;
}

double checkedTarget(double seconds) {
  if (std::isfinite(seconds) && seconds > 0.0) return seconds;
  throw Error(
      ErrorKind::badInput, "",
      fmt::format("a frame cannot be held to {} s; the target is a positive time, 1/60 s for example", seconds));
}

}  // namespace

double relativeCost(const Quality& q) {
  const Quality high = qualityPreset(QualityPreset::high);
  const auto march = [](const Quality& of) {
    const double light = of.lightVolume ? std::clamp(of.lightSteps / 4, 1, 3) : of.lightSteps + of.ambientSteps;
    const double rays = 1.0 / (of.historyScale * of.historyScale);
    const double interleave = of.reprojection ? of.interleave : 1;
    return rays / (interleave * interleave) * (1.0 + kPerLightStep * light) * std::pow(of.stepScale, -kStepPower);
  };
  const double history = 4.0 / (q.historyScale * q.historyScale);
  const double light = q.lightVolume ? static_cast<double>(high.lightFrames) / q.lightFrames : 0.0;
  return kMarch * march(q) / march(high) + kHistory * history + kPicture + kLight * light;
}

Quality GovernorSettings::coarsest() {
  Quality q = qualityPreset(QualityPreset::low);
  q.historyScale = 4;
  q.lightFrames = kSlowestLight;
  return q;
}

Governor::Governor(const GovernorSettings& settings) : target_(checkedTarget(settings.target)), skip_(kCutFrames) {
  Ladder all = ladder(settings.best, settings.worst, std::clamp(settings.leastScale, 0.25f, 1.0f));
  rungs_ = std::move(all.rungs);
  scales_ = std::move(all.scales);
}

void Governor::setTarget(double seconds) {
  target_ = checkedTarget(seconds);
  patience_ = 1;
}

void Governor::cut() {
  skip_ = kCutFrames;
  times_.clear();
  change_.reset();
}

double Governor::medianOfLast(std::size_t frames) const {
  return median({times_.end() - static_cast<std::ptrdiff_t>(frames), times_.end()});
}

double Governor::predicted(double now, std::size_t rung, double rest) const {
  return rest + (now - rest) * cost(rung) / cost(rung_);
}

// What the last change has done tells how much of a frame the switches reach.
void Governor::learn() {
  const double after = medianOfLast(kSpike), perCost = (change_->before - after) / (change_->cost - cost(rung_));
  const double most = kMostRest * std::min(change_->before, after);
  rest_ = std::clamp(0.5 * (rest_ + after - perCost * cost(rung_)), 0.0, most);
  change_.reset();
}

void Governor::go(std::size_t rung) {
  change_ = Change{medianOfLast(kSpike), cost(rung_)};
  climbed_ = rung < rung_;
  rung_ = rung;
  times_.clear();
  stood_ = 0;
  skip_ = kLag;
}

bool Governor::take(double seconds) {
  if (!std::isfinite(seconds) || seconds <= 0.0) return false;
  if (skip_ > 0) {
    --skip_;
    return false;
  }
  times_.push_back(seconds);
  if (times_.size() > kCalm) times_.pop_front();
  if (++stood_ == kProof && climbed_) {
    climbed_ = false;
    patience_ = 1;
  }
  const std::size_t frames = times_.size();
  if (frames < kSpike) return false;
  if (change_) learn();

  const double recent = medianOfLast(kSpike);
  const bool over = recent > kFarOver * target_ || (frames >= kMild && medianOfLast(kMild) > kOver * target_);
  if (over) {
    if (rung_ + 1 == rungs_.size()) return false;
    if (climbed_) patience_ = std::min(2 * patience_, kMostPatience);
    const double rest = std::min(rest_, kMostRestDown * recent);
    std::size_t next = rung_ + 1;
    while (next + 1 < rungs_.size() && predicted(recent, next, rest) > kAimDown * target_) ++next;
    go(next);
    return true;
  }
  if (rung_ == 0 || frames < kCalm || stood_ < kCalm * patience_) return false;
  const double usual = medianOfLast(kCalm);
  if (predicted(usual, rung_ - 1, std::min(rest_, kMostRest * usual)) > kAimUp * target_) return false;
  go(rung_ - 1);
  return true;
}

}  // namespace welkin::realtime
