// Flying: the aircraft in the place of the camera, hands on its controls instead of the view.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/viewer/flight_view/instruments.hpp"
#include "apps/viewer/frame_loop.hpp"
#include "apps/viewer/picture/screenshot.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin::viewer {

namespace {

constexpr int kFramesASecond = 60, kMostFrames = 15;  // of flight at a time, when drawing does not keep up
constexpr float kDeadZone = 0.12f;                    // of a gamepad's sticks

// What is left of an axis beyond its dead zone; small movements count less.
float stickOf(float axis) {
  const float beyond = std::max(std::abs(axis) - kDeadZone, 0.0f) / (1.0f - kDeadZone);
  return std::copysign(std::min(beyond, 1.0f) * std::min(beyond, 1.0f), axis);
}

}  // namespace

void Viewer::beginFlight() {
  const Scene& scene = bench_.document.scene();
  flight_.emplace(scene, options_.fly->start);
  scenery_ = std::make_unique<Scenery>(gl_, *flight_);
  picture_.setForeground(scenery_.get());
  skyTime_ = static_cast<double>(scene.time);
  bench_.panels = false;
  bench_.playing = bench_.keepCamera = true;
  takeScene();
  if (!options_.fly->frames.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options_.fly->frames, failed);
    if (failed) throw Error(ErrorKind::failed, options_.fly->frames, "cannot be made: " + failed.message());
  }
  if (!options_.fly->record.empty()) requireWritable(options_.fly->record);
}

// What a key does once, when it is pressed. Those that are held are read in hands().
bool Viewer::flightKey(Key key) {
  const Modifiers modifiers = interface_.modifiers();
  if (modifiers.ctrl || modifiers.alt) return false;
  switch (key) {
    case Key::c:
      flight_->pilot.changeView();
      gaze_ = {};
      picture_.cut();
      return true;
    case Key::f:
      flight_->pilot.moveFlaps(1);
      return true;
    case Key::g:
      flight_->pilot.moveFlaps(-1);
      return true;
    case Key::backspace:
      flight_->restart(bench_.document.scene());
      gaze_ = {};
      picture_.cut();
      return true;
    case Key::home:
      gaze_ = {};
      return true;
    case Key::a:
    case Key::b:
    case Key::d:
    case Key::i:
    case Key::o:
    case Key::r:
    case Key::s:
    case Key::u:
    case Key::w:
      return true;  // held, or of the view without an aircraft
    default:
      return key >= Key::digit0 && key <= Key::digit9;
  }
}

Hands Viewer::hands() const {
  Hands hands;
  if (!interface_.wantsText() && !interface_.modifiers().ctrl) {
    const auto axis = [&](Key plus, Key minus) {
      return (interface_.isDown(plus) ? 1.0f : 0.0f) - (interface_.isDown(minus) ? 1.0f : 0.0f);
    };
    hands.throttle = axis(Key::w, Key::s);
    hands.yaw = axis(Key::d, Key::a);
    hands.brake = interface_.isDown(Key::b);
    if (!interface_.wantsKeys()) {
      hands.pitch = axis(Key::down, Key::up);
      hands.bank = axis(Key::right, Key::left);
    }
  }
  const auto pad = [&](PadAxis a) { return pad_[static_cast<std::size_t>(a)]; };
  hands.stickPitch = stickOf(pad(PadAxis::leftY));
  hands.stickBank = stickOf(pad(PadAxis::leftX));
  hands.stickYaw = stickOf(pad(PadAxis::rightX));
  hands.throttle += stickOf(pad(PadAxis::rightTrigger)) - stickOf(pad(PadAxis::leftTrigger));
  return hands;
}

void Viewer::fly(double seconds) {
  Document& document = bench_.document;
  if (document.scene().time != static_cast<float>(skyTime_)) skyTime_ = static_cast<double>(document.scene().time);
  takeScene();
  if (bench_.playing) {
    unflown_ = std::min(unflown_ + seconds * kFramesASecond, static_cast<double>(kMostFrames));
    // A script's frame is one of the flight's.
    const int frames = script_ ? 1 : static_cast<int>(unflown_);
    unflown_ -= frames;
    const bool crashed = flight_->aircraft().crashed;
    for (int i = 0; i < frames; ++i) {
      skyTime_ += static_cast<double>(bench_.timeRate) / kFramesASecond;
      flight_->advance(hands(), skyTime_);
    }
    if (flight_->aircraft().crashed != crashed) bench_.say("The aircraft is broken: Backspace begins again.");
    document.moveTime(static_cast<float>(skyTime_));
  }
  document.moveCamera(flight_->camera(document.scene().camera, gaze_));
}

void Viewer::steer(const ScriptStep& step) {
  if (!flight_) script_->fail(step, "there is nothing to fly: it is a step for `welkin fly`");
  for (std::size_t i = 1; i < step.words.size(); ++i) {
    const FlightView view = flight_->pilot.view();
    if (const std::string wrong = flight_->pilot.set(step.words[i]); !wrong.empty()) script_->fail(step, wrong);
    if (flight_->pilot.view() != view) picture_.cut();
  }
}

void Viewer::drawFlight() {
  const Region part = region();
  const auto x = static_cast<float>(part.x), top = static_cast<float>(platform_->height() - part.y - part.height);
  drawInstruments(*flight_, {x, top}, {x + static_cast<float>(part.width), top + static_cast<float>(part.height)},
                  !bench_.playing);
}

void Viewer::keepFrame() {
  if (options_.fly->frames.empty()) return;
  const std::string name = fmt::format("frame_{:05}.png", ++kept_);
  savePngOf(gl_, platform_->framebuffer(), platform_->width(), platform_->height(),
            (std::filesystem::path(options_.fly->frames) / name).string());
}

void Viewer::endFlight() {
  if (flight_ && !options_.fly->record.empty()) writeFileAtomically(options_.fly->record, flight_->recording());
}

}  // namespace welkin::viewer
