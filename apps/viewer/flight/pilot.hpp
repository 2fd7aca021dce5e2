#pragma once
// From keys, sticks and scripts to the controls of an aircraft.
#include <string>
#include <string_view>

#include "apps/viewer/flight/aircraft.hpp"
#include "apps/viewer/model/event.hpp"

namespace welkin::viewer {

inline constexpr double kFlightFrame = 1.0 / 60.0;  // s, after which the hands have moved

enum class FlightView { cockpit, chase };

// What hands do at one moment, each in [-1, 1].
struct Hands {
  float pitch = 0.0f, bank = 0.0f, yaw = 0.0f;  // keys
  float throttle = 0.0f;                        // a rate
  bool brake = false;
  // Sticks of a gamepad, which reach the surfaces without delay.
  float stickPitch = 0.0f, stickBank = 0.0f, stickYaw = 0.0f;
  bool any() const {
    return pitch != 0 || bank != 0 || yaw != 0 || throttle != 0 || brake || stickPitch != 0 || stickBank != 0 ||
           stickYaw != 0;
  }
};

class Pilot {
 public:
  // A sixtieth of a second of these hands. Keys move the stick there and back in a third of a second.
  void move(const Hands& hands);
  // A step of a script: "throttle=1", "view=chase". Returns what is wrong with it, or an empty text.
  std::string set(std::string_view word);
  // Flaps by a third.
  void moveFlaps(int steps);
  void changeView();

  // Rounded to hundredths, so that what is recorded is what was flown.
  Controls controls() const;
  void setThrottle(float throttle) { controls_.throttle = throttle; }
  void setFlaps(float flaps) { controls_.flaps = flaps; }
  FlightView view() const { return view_; }
  void setView(FlightView view) { view_ = view; }

 private:
  Controls controls_;
  FlightView view_ = FlightView::chase;
  bool scripted_ = false;  // the controls stand where a script has put them
};

// Writes what was flown as a script: runs of frames with the controls that changed.
class FlightRecorder {
 public:
  void add(const Controls& controls, FlightView view);
  std::string text() const;

 private:
  void flush();
  std::string text_, changes_;
  Controls last_;
  FlightView view_ = FlightView::chase;
  int frames_ = 0;
};

}  // namespace welkin::viewer
