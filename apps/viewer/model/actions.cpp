#include "apps/viewer/model/actions.hpp"

#include <algorithm>

namespace welkin::viewer {

namespace {

constexpr Modifiers kCtrl{.ctrl = true}, kCtrlShift{.shift = true, .ctrl = true};

constexpr ActionInfo kActions[] = {
    {Action::open, ActionGroup::file, "open", "Open…", {Key::o, kCtrl}},
    {Action::save, ActionGroup::file, "save", "Save", {Key::s, kCtrl}},
    {Action::saveAs, ActionGroup::file, "save_as", "Save as…", {Key::s, kCtrlShift}},
    {Action::savePicture, ActionGroup::file, "save_picture", "Save picture…", {Key::f12, {}}},
    {Action::copyCommand, ActionGroup::file, "copy_command", "Copy as command line", {Key::c, kCtrlShift}},
    {Action::quit, ActionGroup::file, "quit", "Quit", {Key::q, kCtrl}},
    {Action::undo, ActionGroup::edit, "undo", "Undo", {Key::z, kCtrl}},
    {Action::redo, ActionGroup::edit, "redo", "Redo", {Key::z, kCtrlShift}},
    {Action::play, ActionGroup::time, "play", "Let time run", {Key::space, {}}},
    {Action::resetTime, ActionGroup::time, "reset_time", "Time to 0", {Key::t, kCtrl}},
    {Action::navigation, ActionGroup::camera, "navigation", "Look or orbit", {Key::o, {}}},
    {Action::homeView, ActionGroup::camera, "home_view", "The sky's own view", {Key::home, {}}},
    {Action::below, ActionGroup::camera, "below", "Below the clouds", {Key::b, {}}},
    {Action::inside, ActionGroup::camera, "inside", "Inside the clouds", {Key::i, {}}},
    {Action::above, ActionGroup::camera, "above", "Above the clouds", {Key::u, {}}},
    {Action::mapView, ActionGroup::camera, "map_view", "Map view", {Key::m, {}}},
    {Action::gallery, ActionGroup::panel, "gallery", "Gallery", {Key::f2, {}}},
    {Action::parameters, ActionGroup::panel, "parameters", "Parameters", {Key::f3, {}}},
    {Action::sun, ActionGroup::panel, "sun", "Sun", {Key::f4, {}}},
    {Action::wind, ActionGroup::panel, "wind", "Wind", {Key::f5, {}}},
    {Action::weather, ActionGroup::panel, "weather", "Weather map", {Key::p, {}}},
    {Action::camera, ActionGroup::panel, "camera", "Camera", {Key::f6, {}}},
    {Action::film, ActionGroup::panel, "film", "Film", {Key::f7, {}}},
    {Action::pace, ActionGroup::panel, "pace", "Pace", {Key::f8, {}}},
    {Action::inspect, ActionGroup::panel, "inspect", "Density and noise", {Key::n, {}}},
    {Action::reference, ActionGroup::panel, "reference", "Reference", {Key::f11, {}}},
    {Action::trace, ActionGroup::time, "trace", "Path-traced reference", {Key::r, {}}},
    {Action::search, ActionGroup::panel, "search", "Search a parameter", {Key::slash, {}}},
    {Action::focusPanel, ActionGroup::window, "focus_panel", "Keyboard to panel or picture", {Key::f10, {}}},
    {Action::panels, ActionGroup::window, "panels", "Panels on and off", {Key::f9, {}}},
    {Action::biggerInterface, ActionGroup::window, "bigger_interface", "Larger interface", {Key::plus, kCtrl}},
    {Action::smallerInterface, ActionGroup::window, "smaller_interface", "Smaller interface", {Key::minus, kCtrl}},
    {Action::help, ActionGroup::window, "help", "Keys and mouse", {Key::f1, {}}},
};

template <class Predicate>
std::optional<Action> actionWhere(Predicate predicate) {
  const auto found = std::find_if(std::begin(kActions), std::end(kActions), predicate);
  if (found == std::end(kActions)) return std::nullopt;
  return found->action;
}

}  // namespace

std::span<const ActionInfo> actions() { return kActions; }

const ActionInfo& infoOf(Action action) {
  return *std::find_if(std::begin(kActions), std::end(kActions),
                       [&](const ActionInfo& i) { return i.action == action; });
}

std::optional<Action> actionNamed(std::string_view name) {
  return actionWhere([&](const ActionInfo& i) { return i.name == name; });
}

std::optional<Action> actionOf(const Chord& chord) {
  return actionWhere([&](const ActionInfo& i) { return i.chord == chord; });
}

}  // namespace welkin::viewer
