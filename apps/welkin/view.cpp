// welkin view: a window on a sky.
#include "apps/welkin/window.hpp"

namespace welkin::app {

void addView(CLI::App& app) {
  auto* command = app.add_subcommand("view", "a window on a sky: change it, fly through it, save it");
  auto arguments = std::make_shared<WindowArguments>();
  arguments->addTo(*command);
  command->callback([arguments] {
#ifdef WELKIN_HAS_VIEWER
    viewer::runViewer(arguments->options());
#else
    refuseWithoutWindow();
#endif
  });
}

}  // namespace welkin::app
