#include "apps/viewer/flight/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace welkin::viewer {

namespace {

constexpr float kHandFrame = static_cast<float>(kFlightFrame);

struct Control {
  std::string_view name;
  float Controls::*member;
  float least;
};
constexpr Control kControls[] = {{"pitch", &Controls::pitch, -1.0f}, {"bank", &Controls::bank, -1.0f},
                                 {"yaw", &Controls::yaw, -1.0f},     {"throttle", &Controls::throttle, 0.0f},
                                 {"flaps", &Controls::flaps, 0.0f},  {"brake", &Controls::brake, 0.0f}};
constexpr std::string_view kViews[] = {"cockpit", "chase"};

float toward(float now, float wanted, float seconds) {
  const float most = kHandFrame / seconds;
  return now + std::clamp(wanted - now, -most, most);
}

// Hundredths, and no -0.
float rounded(float x) { return std::isfinite(x) ? std::round(x * 100.0f) / 100.0f + 0.0f : 0.0f; }

}  // namespace

void Pilot::move(const Hands& hands) {
  if (hands.any()) scripted_ = false;
  if (scripted_) return;
  const auto stick = [](float now, float key, float pad) {
    return pad != 0.0f ? std::clamp(pad, -1.0f, 1.0f) : toward(now, std::clamp(key, -1.0f, 1.0f), 0.35f);
  };
  controls_.pitch = stick(controls_.pitch, hands.pitch, hands.stickPitch);
  controls_.bank = stick(controls_.bank, hands.bank, hands.stickBank);
  controls_.yaw = stick(controls_.yaw, hands.yaw, hands.stickYaw);
  controls_.throttle = std::clamp(controls_.throttle + hands.throttle * kHandFrame / 2.5f, 0.0f, 1.0f);
  controls_.brake = hands.brake ? 1.0f : 0.0f;
}

std::string Pilot::set(std::string_view word) {
  const std::size_t equals = word.find('=');
  const std::string_view name = word.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? std::string_view() : word.substr(equals + 1);
  if (name == "view") {
    const auto* const found = std::find(std::begin(kViews), std::end(kViews), value);
    if (found == std::end(kViews)) return fmt::format("'{}': write view=cockpit or view=chase", word);
    view_ = static_cast<FlightView>(found - std::begin(kViews));
    return "";
  }
  const auto* const control =
      std::find_if(std::begin(kControls), std::end(kControls), [&](const Control& c) { return c.name == name; });
  float number = 0.0f;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool right = control != std::end(kControls) && error == std::errc() && end == value.data() + value.size() &&
                     number >= control->least && number <= 1.0f;
  if (!right)
    return fmt::format("'{}': write pitch, bank or yaw = -1 to 1, throttle, flaps or brake = 0 to 1, or view=chase",
                       word);
  controls_.*control->member = number;
  scripted_ = true;
  return "";
}

void Pilot::moveFlaps(int steps) {
  controls_.flaps = std::clamp(std::round(controls_.flaps * 3.0f + static_cast<float>(steps)) / 3.0f, 0.0f, 1.0f);
}

void Pilot::changeView() { view_ = view_ == FlightView::chase ? FlightView::cockpit : FlightView::chase; }

Controls Pilot::controls() const {
  Controls out = controls_;
  for (const Control& c : kControls) out.*c.member = rounded(out.*c.member);
  return out;
}

void FlightRecorder::add(const Controls& controls, FlightView view) {
  std::string changes;
  for (const Control& c : kControls)
    if (controls.*c.member != last_.*c.member) changes += fmt::format(" {}={:.4g}", c.name, controls.*c.member);
  if (view != view_) changes += fmt::format(" view={}", kViews[static_cast<std::size_t>(view)]);
  if (!changes.empty() && frames_ > 0) flush();
  last_ = controls;
  view_ = view;
  if (!changes.empty()) changes_ = changes;
  ++frames_;
}

void FlightRecorder::flush() {
  text_ += fmt::format("fly {}{}\n", frames_, changes_);
  changes_.clear();
  frames_ = 0;
}

std::string FlightRecorder::text() const {
  FlightRecorder whole = *this;
  if (whole.frames_ > 0) whole.flush();
  return whole.text_;
}

}  // namespace welkin::viewer
