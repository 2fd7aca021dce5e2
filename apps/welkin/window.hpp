#pragma once
// What `welkin view` and `welkin fly` have in common: a window, or what stands for it.
#include <string>

#include "apps/welkin/command.hpp"
#ifdef WELKIN_HAS_VIEWER
#include "apps/viewer/viewer.hpp"
#endif

namespace welkin::app {

struct WindowArguments {
  SkyArguments sky;
  std::string size = "1280x720", script, screenshot;
  double uiScale = 0.0, scale = 0.0, rate = -1.0;
  bool headless = false;

  void addTo(CLI::App& command);
#ifdef WELKIN_HAS_VIEWER
  // Throws UsageError for arguments that do not go together.
  viewer::ViewerOptions options() const;
#endif
};

// Throws the Error of a program without a window.
[[noreturn]] void refuseWithoutWindow();

}  // namespace welkin::app
