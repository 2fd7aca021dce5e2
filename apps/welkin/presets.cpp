// welkin presets: the skies that come with Welkin.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/sky_file.hpp"

namespace welkin::app {

namespace fs = std::filesystem;

namespace {

// The comment at the head of a preset, without its marks, as one line.
std::string headline(const std::string& text) {
  std::string sentence;
  for (std::size_t begin = 0; begin < text.size() && text[begin] == '#';) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t word = std::min(text.find_first_not_of("# ", begin), end);
    if (!sentence.empty() && word < end) sentence += ' ';
    sentence += text.substr(word, end - word);
    begin = end + 1;
  }
  return sentence;
}

std::string genusOf(const Scene& scene) {
  for (const Layer& layer : scene.layers)
    if (layer.cloud.genus != Genus::none)
      return std::string(ChoiceNames<Genus>::names[static_cast<std::size_t>(layer.cloud.genus)]);
  if (!scene.sheets.empty())
    return std::string(ChoiceNames<SheetKind>::names[static_cast<std::size_t>(scene.sheets[0].kind)]);
  return "none";
}

}  // namespace

std::string presetFolder() {
  if (const char* chosen = std::getenv("WELKIN_PRESETS"); chosen && *chosen) return chosen;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder : {program / "../share/welkin/presets", program / "../../../presets"})
    if (!program.empty() && fs::is_directory(folder, none)) return folder.lexically_normal().string();
  return "";
}

std::vector<Preset> findPresets() {
  const std::string folder = presetFolder();
  std::vector<Preset> presets;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string file = entry.path().filename().string();
    constexpr std::string_view kEnding = ".sky.toml";
    if (!file.ends_with(kEnding)) continue;
    const std::string path = entry.path().string(), text = readFile(path, 1 << 20);
    presets.push_back(
        {file.substr(0, file.size() - kEnding.size()), genusOf(parseSky(text, path)), headline(text), path});
  }
  std::sort(presets.begin(), presets.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
  return presets;
}

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
