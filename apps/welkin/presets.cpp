// welkin presets: the skies that come with Welkin.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"

namespace welkin::app {

namespace fs = std::filesystem;

std::string presetFolder() {
  if (const char* chosen = std::getenv("WELKIN_PRESETS"); chosen && *chosen) return chosen;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder : {program / "../share/welkin/presets", program / "../../../presets"})
    if (!program.empty() && fs::is_directory(folder, none)) return folder.lexically_normal().string();
  return "";
}

std::vector<Preset> findPresets() { return presetsIn(presetFolder()); }

void addPresets(CLI::App& app) {
  auto* command = app.add_subcommand("presets", "the skies that come with Welkin");
  const auto json = addJsonFlag(*command);
  command->callback([json] {
    const std::vector<Preset> presets = findPresets();
    if (presets.empty())
      fmt::print(stderr, "welkin: no presets were found next to the program; WELKIN_PRESETS may name their folder\n");
    auto all = nlohmann::ordered_json::array();
    for (const Preset& p : presets) {
      if (*json)
        all.push_back({{"name", p.name}, {"genus", p.genus}, {"sentence", p.sentence}, {"file", p.file}});
      else
        fmt::print("{:<24} {}\n", p.name, p.sentence);
    }
    if (*json) fmt::print("{}\n", all.dump(2));
  });
}

}  // namespace welkin::app
