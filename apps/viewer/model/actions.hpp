#pragma once
// What menu, keyboard and scripts can ask for: one list for all three.
#include <optional>
#include <span>
#include <string_view>

#include "apps/viewer/model/event.hpp"

namespace welkin::viewer {

enum class Action {
  open,
  save,
  saveAs,
  copyCommand,
  savePicture,
  quit,
  undo,
  redo,
  play,
  resetTime,
  navigation,
  homeView,
  below,
  inside,
  above,
  mapView,
  panels,
  focusPanel,
  search,
  gallery,
  parameters,
  sun,
  wind,
  weather,
  camera,
  film,
  pace,
  inspect,
  reference,
  trace,
  biggerInterface,
  smallerInterface,
  help
};

enum class ActionGroup { file, edit, time, camera, panel, window };

struct ActionInfo {
  Action action;
  ActionGroup group;
  std::string_view name;   // for scripts
  std::string_view label;  // for people
  Chord chord;
};

std::span<const ActionInfo> actions();
const ActionInfo& infoOf(Action action);
std::optional<Action> actionNamed(std::string_view name);
std::optional<Action> actionOf(const Chord& chord);

}  // namespace welkin::viewer
