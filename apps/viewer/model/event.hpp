#pragma once
// What a user does, whoever reports it: the window, or a script that plays it.
#include <string>
#include <string_view>

namespace welkin::viewer {

// Keys that mean something here; `none` is any other.
enum class Key {
  none,
  a,
  b,
  c,
  d,
  e,
  f,
  g,
  h,
  i,
  j,
  k,
  l,
  m,
  n,
  o,
  p,
  q,
  r,
  s,
  t,
  u,
  v,
  w,
  x,
  y,
  z,
  digit0,
  digit1,
  digit2,
  digit3,
  digit4,
  digit5,
  digit6,
  digit7,
  digit8,
  digit9,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
  escape,
  enter,
  tab,
  space,
  backspace,
  del,
  insert,
  home,
  end,
  pageup,
  pagedown,
  left,
  right,
  up,
  down,
  plus,
  minus,
  comma,
  period,
  slash,
  shift,
  ctrl,
  alt
};
inline constexpr int kKeys = static_cast<int>(Key::alt) + 1;

// "a", "1", "f5", "pageup"; empty for Key::none.
std::string_view nameOf(Key key);
// Key::none for an unknown name.
Key keyNamed(std::string_view name);

struct Modifiers {
  bool shift = false, ctrl = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

// A key with its modifiers: "ctrl+shift+z".
struct Chord {
  Key key = Key::none;
  Modifiers modifiers;
  bool operator==(const Chord&) const = default;
};
std::string nameOf(const Chord& chord);
// Key::none for what is not a chord.
Chord chordNamed(std::string_view name);

enum class MouseButton { left, right, middle };

// Of a gamepad: sticks from -1 to 1, right and down positive; triggers from 0 to 1. Its buttons are keys.
enum class PadAxis { leftX, leftY, rightX, rightY, leftTrigger, rightTrigger };
inline constexpr int kPadAxes = static_cast<int>(PadAxis::rightTrigger) + 1;

enum class EventKind { mouseMove, mouseButton, wheel, key, padAxis, text, drop, resize, quit };

struct Event {
  EventKind kind = EventKind::quit;
  float x = 0.0f, y = 0.0f;  // mouseMove: pixels from the upper left; wheel: clicks; resize: new size in pixels;
                             // padAxis: where it stands, in x
  MouseButton button = MouseButton::left;
  bool down = false;  // mouseButton, key
  Key key = Key::none;
  PadAxis axis = PadAxis::leftX;
  std::string text{};  // text: UTF-8; drop: path of a file
};

}  // namespace welkin::viewer
