#include "apps/viewer/model/command_line.hpp"

#include <fmt/format.h>

#include "welkin/scene/sections.hpp"

namespace welkin::viewer {

std::string shellQuoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted(1, '\'');
  for (const char c : word)
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  quoted += '\'';
  return quoted;
}

std::string commandLine(const Scene& scene, const Scene& opened, const std::string& name) {
  std::string line = "welkin render";
  if (!name.empty()) line.append(" ").append(shellQuoted(name));
  line += " -o sky.png";
  Scene now = scene, then = opened;
  const std::vector<Section> left = sectionsOf(now), right = sectionsOf(then);
  for (std::size_t i = 0; i < left.size() && i < right.size(); ++i)
    for (const Field& f : left[i].fields) {
      const FieldValue value = f.get(left[i].object);
      if (value == f.get(right[i].object)) continue;
      const std::string& path = left[i].path;
      line.append(" --set ").append(
          shellQuoted(fmt::format("{}{}{}={}", path, path.empty() ? "" : ".", f.name, formatValue(f, value))));
    }
  return line;
}

}  // namespace welkin::viewer
