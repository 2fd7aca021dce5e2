// welkin check: reads a sky file and says whether it is right.
#include <fmt/format.h>

#include "apps/welkin/command.hpp"
#include "welkin/io/grids.hpp"

namespace welkin::app {

void addCheck(CLI::App& app) {
  auto* command = app.add_subcommand("check", "reads a sky file and says what is wrong with it");
  auto arguments = std::make_shared<SkyArguments>();
  arguments->addTo(*command, SkyArguments::Need::required);
  command->callback([arguments] {
    const Scene scene = arguments->scene();
    const auto counted = [](std::size_t n, const char* what) {
      return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    fmt::print("{}: a sky of {} and {}{}{}\n", arguments->sky, counted(scene.layers.size(), "layer"),
               counted(scene.sheets.size(), "sheet"),
               scene.grids.empty() ? "" : " and " + counted(loadGrids(scene).size(), "grid"),
               scene.heroes.empty() ? "" : " and " + counted(scene.heroes.size(), "hero cloud"));
  });
}

}  // namespace welkin::app
