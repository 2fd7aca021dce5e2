// welkin check: reads a sky file and says whether it is right.
#include <fmt/format.h>

#include "apps/welkin/command.hpp"

namespace welkin::app {

void addCheck(CLI::App& app) {
  auto* command = app.add_subcommand("check", "reads a sky file and says what is wrong with it");
  auto arguments = std::make_shared<SkyArguments>();
  arguments->addTo(*command, SkyArguments::Need::required);
  command->callback([arguments] {
    const Scene scene = arguments->scene();
    fmt::print("{}: a sky of {} layer{} and {} sheet{}\n", arguments->sky, scene.layers.size(),
               scene.layers.size() == 1 ? "" : "s", scene.sheets.size(), scene.sheets.size() == 1 ? "" : "s");
  });
}

}  // namespace welkin::app
