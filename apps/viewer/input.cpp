// What hands do: events, keys, actions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/frame_loop.hpp"
#include "apps/viewer/model/command_line.hpp"
#include "apps/viewer/model/map_camera.hpp"
#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

void Viewer::handle(const Event& event) {
  if (event.kind == EventKind::text && swallowText_) return;
  interface_.feed(event);
  switch (event.kind) {
    case EventKind::quit:
      leave();
      break;
    case EventKind::mouseMove: {
      const glm::vec2 now(event.x, event.y);
      if (dragging_) dragView(now - pointer_);
      pointer_ = now;
      break;
    }
    case EventKind::mouseButton:
      if (!event.down)
        dragging_.reset();
      else if (!interface_.wantsMouse())
        dragging_ = event.button;
      break;
    case EventKind::wheel:
      if (interface_.wantsMouse()) break;
      {
        Camera camera = bench_.document.scene().camera;
        bench_.navigation.stop();
        if (bench_.mapShown)
          zoomMap(camera, event.y);
        else if (interface_.modifiers().ctrl)
          bench_.navigation.zoom(camera, event.y);
        else
          bench_.navigation.dolly(camera, event.y);
        bench_.document.moveCamera(camera);
      }
      break;
    case EventKind::key:
      if (event.down) pressed(event.key);
      break;
    case EventKind::drop:
      if (event.text.ends_with(".tif") || event.text.ends_with(".tiff"))
        openMap(event.text);
      else
        openSky(event.text, {event.text, event.text});
      break;
    case EventKind::resize:
      // A script's wish; the window answers with a resize event of its own.
      if (static_cast<int>(event.x) != platform_->width() || static_cast<int>(event.y) != platform_->height())
        platform_->resize(static_cast<int>(event.x), static_cast<int>(event.y));
      break;
    case EventKind::padAxis:
      pad_[static_cast<std::size_t>(event.axis)] = event.x;
      break;
    case EventKind::text:
      break;
  }
}

void Viewer::pressed(Key key) {
  const Modifiers modifiers = interface_.modifiers();
  // In a text field letters are letters; on widgets space and tab belong to them.
  if (interface_.wantsText() && !modifiers.ctrl && (key < Key::f1 || key > Key::f12)) return;
  if (interface_.wantsText() && modifiers.ctrl && (key == Key::z || key == Key::c || key == Key::a)) return;
  if (interface_.wantsKeys() && key == Key::space) return;
  // Away from the panels, unless there is something to close first.
  if (key == Key::escape && !ImGui::IsAnyItemActive() &&
      !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
    if (bench_.helpShown)
      bench_.helpShown = false;
    else
      ImGui::SetWindowFocus(nullptr);
    return;
  }
  if (flight_ && flightKey(key)) {
    swallowText_ = true;
    return;
  }
  if (key >= Key::digit1 && key <= Key::digit9 && !modifiers.alt && !modifiers.shift) {
    bookmark(static_cast<int>(key) - static_cast<int>(Key::digit1), modifiers.ctrl);
    swallowText_ = true;
    return;
  }
  const std::optional<Action> action = actionOf({key, modifiers});
  if (!action) return;
  swallowText_ = true;
  perform(*action, "");
}

void Viewer::bookmark(int number, bool keep) {
  std::optional<Camera>& place = bench_.bookmarks[static_cast<std::size_t>(number)];
  const Camera& here = bench_.document.scene().camera;
  if (keep) {
    place = here;
    bench_.say(fmt::format("Bookmark {} kept.", number + 1));
  } else if (place) {
    bench_.navigation.travel(here, *place);
  } else {
    bench_.say(fmt::format("There is no bookmark {0}; ctrl+{0} keeps one.", number + 1));
  }
}

void Viewer::perform(Action action, const std::string& argument) {
  Document& document = bench_.document;
  switch (action) {
    case Action::open:
    case Action::saveAs:
    case Action::savePicture:
      if (argument.empty())
        askForFile(bench_, action);
      else if (action == Action::open)
        openSky(argument, {argument, argument});
      else if (action == Action::saveAs)
        saveSky(argument);
      else
        savePicture(argument);
      break;
    case Action::save:
      if (document.origin().file.empty())
        askForFile(bench_, Action::saveAs);
      else
        saveSky(document.origin().file);
      break;
    case Action::copyCommand:
      for (std::size_t i = 0; i < document.scene().layers.size(); ++i)
        if (document.unsavedWeather(i))
          return bench_.complain("The painted weather is in no file yet: save the sky first.");
      platform_->setClipboard(commandLine(document.scene(), document.savedScene(), document.origin().name));
      bench_.say("The command that renders this picture is on the clipboard.");
      break;
    case Action::quit:
      leave();
      break;
    case Action::undo:
      if (document.canUndo()) {
        bench_.say("Undone: " + document.undoName());
        document.undo();
      }
      break;
    case Action::redo:
      if (document.canRedo()) {
        bench_.say("Done again: " + document.redoName());
        document.redo();
      }
      break;
    case Action::play:
      bench_.playing = !bench_.playing;
      break;
    case Action::trace:
      if (bench_.mapShown) return bench_.complain("The path tracer knows nothing of maps: leave the map view first.");
      bench_.referenceWanted = !bench_.referenceWanted;
      if (bench_.referenceWanted) bench_.say("The path tracer begins when the picture has come to rest.");
      break;
    case Action::resetTime:
      document.moveTime(0.0f);
      break;
    case Action::navigation: {
      NavigationMode& mode = bench_.navigation.mode;
      mode = mode == NavigationMode::look ? NavigationMode::orbit : NavigationMode::look;
      bench_.say(mode == NavigationMode::look ? "Dragging looks round." : "Dragging orbits.");
      break;
    }
    case Action::below:
    case Action::inside:
    case Action::above: {
      const Vantage vantage = action == Action::below    ? Vantage::below
                              : action == Action::inside ? Vantage::inside
                                                         : Vantage::above;
      bench_.navigation.travel(document.scene().camera, cameraAt(document.scene(), vantage));
      break;
    }
    case Action::homeView:
      bench_.navigation.travel(document.scene().camera, document.savedScene().camera);
      break;
    case Action::mapView:
      showMap(!bench_.mapShown);
      break;
    case Action::panels:
      bench_.panels = !bench_.panels;
      break;
    case Action::focusPanel:
      bench_.panels = true;
      ImGui::SetWindowFocus(interface_.wantsKeys() ? nullptr : kSide);
      break;
    case Action::search:
      bench_.panels = bench_.focusSearch = true;
      bench_.wantedTab = Tab::parameters;
      break;
    case Action::gallery:
    case Action::parameters:
    case Action::sun:
    case Action::wind:
    case Action::weather:
    case Action::camera:
    case Action::film:
    case Action::pace:
    case Action::inspect:
    case Action::reference:
      bench_.panels = true;
      bench_.wantedTab = tabOf(action);
      break;
    case Action::help:
      bench_.helpShown = !bench_.helpShown;
      break;
    case Action::biggerInterface:
      interface_.setScale(std::min(interface_.scale() * 1.125f, 4.0f));
      break;
    case Action::smallerInterface:
      interface_.setScale(std::max(interface_.scale() / 1.125f, 0.6f));
      break;
  }
}

// What held keys do, and time.
void Viewer::move(double seconds) {
  if (flight_) return fly(seconds);
  Camera camera = bench_.document.scene().camera;
  Thrust thrust;
  const Modifiers modifiers = interface_.modifiers();
  if (!interface_.wantsText() && !modifiers.ctrl) {
    const auto axis = [&](Key plus, Key minus) {
      return (interface_.isDown(plus) ? 1.0f : 0.0f) - (interface_.isDown(minus) ? 1.0f : 0.0f);
    };
    const float pace = modifiers.shift ? 6.0f : modifiers.alt ? 0.15f : 1.0f;
    thrust.forward = pace * axis(Key::w, Key::s);
    thrust.right = pace * axis(Key::d, Key::a);
    thrust.up = pace * axis(Key::e, Key::q);
    if (!interface_.wantsKeys()) {
      thrust.yaw = axis(Key::right, Key::left);
      thrust.pitch = axis(Key::up, Key::down);
    }
  }
  if (thrust.any()) {
    bench_.navigation.stop();
    if (bench_.mapShown)
      steerMap(camera, thrust, seconds);
    else
      bench_.navigation.fly(camera, thrust, seconds);
    lively_ = 3;
  }
  bench_.navigation.advance(camera, seconds);
  bench_.document.moveCamera(camera);
  if (bench_.playing)
    bench_.document.moveTime(bench_.document.scene().time + bench_.timeRate * static_cast<float>(seconds));
}

void Viewer::dragView(const glm::vec2& by) {
  Camera camera = bench_.document.scene().camera;
  const glm::vec2 drag = by / static_cast<float>(std::max(region().width, 1));
  if (flight_) {
    const double fov = static_cast<double>(camera.fov);
    gaze_.yaw = std::remainder(gaze_.yaw + fov * static_cast<double>(drag.x), 6.283185307179586);
    gaze_.pitch = std::clamp(gaze_.pitch - fov * static_cast<double>(drag.y), -1.2, 1.2);
    return;
  }
  bench_.navigation.stop();
  if (bench_.mapShown) return dragMap(drag);
  switch (*dragging_) {
    case MouseButton::left:
      bench_.navigation.turn(camera, drag);
      break;
    case MouseButton::right:
      bench_.navigation.orbit(camera, drag);
      break;
    case MouseButton::middle:
      bench_.navigation.pan(camera, drag);
      break;
  }
  bench_.document.moveCamera(camera);
}

}  // namespace welkin::viewer
