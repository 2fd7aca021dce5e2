#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/welkin/presets.hpp"
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

std::vector<Preset> presetsIn(const std::string& folder) {
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

Scene loadSkyNamed(const std::string& sky, const std::string& folder) {
  if (sky.empty()) return Scene{};
  std::error_code ignored;
  if (fs::exists(sky, ignored) || sky.find('/') != std::string::npos || sky.ends_with(".toml")) return loadSky(sky);
  std::vector<std::string> names;
  for (const Preset& preset : presetsIn(folder)) {
    if (preset.name == sky) return loadSky(preset.file);
    names.push_back(preset.name);
  }
  const std::string near = nearestName(sky, names);
  throw Error(
      ErrorKind::badInput, sky,
      fmt::format("is neither a file nor a preset; {}",
                  near.empty() ? "`welkin presets` lists the presets" : fmt::format("did you mean '{}'?", near)));
}

}  // namespace welkin::app
