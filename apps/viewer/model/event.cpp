#include "apps/viewer/model/event.hpp"

#include <array>

namespace welkin::viewer {

namespace {

constexpr std::array<std::string_view, kKeys> kNames{
    "",     "a",      "b",     "c",    "d",     "e",         "f",      "g",      "h",     "i",     "j",      "k",
    "l",    "m",      "n",     "o",    "p",     "q",         "r",      "s",      "t",     "u",     "v",      "w",
    "x",    "y",      "z",     "0",    "1",     "2",         "3",      "4",      "5",     "6",     "7",      "8",
    "9",    "f1",     "f2",    "f3",   "f4",    "f5",        "f6",     "f7",     "f8",    "f9",    "f10",    "f11",
    "f12",  "escape", "enter", "tab",  "space", "backspace", "delete", "insert", "home",  "end",   "pageup", "pagedown",
    "left", "right",  "up",    "down", "plus",  "minus",     "comma",  "period", "slash", "shift", "ctrl",   "alt"};

}  // namespace

std::string_view nameOf(Key key) { return kNames[static_cast<std::size_t>(key)]; }

Key keyNamed(std::string_view name) {
  for (std::size_t i = 1; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<Key>(i);
  return Key::none;
}

std::string nameOf(const Chord& chord) {
  std::string name;
  if (chord.modifiers.ctrl) name += "ctrl+";
  if (chord.modifiers.alt) name += "alt+";
  if (chord.modifiers.shift) name += "shift+";
  return name += nameOf(chord.key);
}

Chord chordNamed(std::string_view name) {
  Chord chord;
  for (std::size_t plus = name.find('+'); plus != std::string_view::npos; plus = name.find('+')) {
    const std::string_view modifier = name.substr(0, plus);
    bool* flag = modifier == "ctrl"    ? &chord.modifiers.ctrl
                 : modifier == "alt"   ? &chord.modifiers.alt
                 : modifier == "shift" ? &chord.modifiers.shift
                                       : nullptr;
    if (!flag) return {};
    *flag = true;
    name.remove_prefix(plus + 1);
  }
  chord.key = keyNamed(name);
  return chord.key == Key::none ? Chord{} : chord;
}

}  // namespace welkin::viewer
