#pragma once
// What the panels share.
#include <functional>
#include <map>
#include <string>

#include "apps/viewer/model/actions.hpp"
#include "apps/viewer/model/document.hpp"
#include "apps/viewer/model/navigation.hpp"
#include "apps/viewer/picture/sky_picture.hpp"
#include "apps/viewer/ui/interface.hpp"
#include "apps/viewer/viewer.hpp"

namespace welkin::viewer {

// How the frame loop is doing.
struct Pace {
  double frameMs = 0.0;   // smoothed, of frames that drew the sky
  double renderMs = 0.0;  // of them, the sky
  float scale = 1.0f;
};

struct Workbench {
  const ViewerOptions& options;
  Document document;
  Navigation navigation{};
  Bookmarks bookmarks{};
  SkyPicture& picture;
  Interface& interface;
  Pace pace{};

  // Time.
  bool playing = false;
  float timeRate = 1.0f;  // seconds of the sky to a second

  // Window.
  bool panels = true, simple = true;
  std::string search{};
  bool focusSearch = false, helpShown = false;
  std::string message{};  // in the status bar
  bool messageIsError = false;
  std::map<std::string, std::string> refusals{};  // by parameter: why its last value was not taken

  std::function<void(Action, const std::string& argument)> perform{};

  void say(const std::string& text) {
    message = text;
    messageIsError = false;
  }
  void complain(const std::string& text) {
    message = text;
    messageIsError = true;
  }
};

}  // namespace welkin::viewer
