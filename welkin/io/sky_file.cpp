#include "welkin/io/sky_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin {

namespace {

constexpr std::size_t kMaxSkyBytes = 1 << 20;
constexpr int kMaxDots = 32;
constexpr std::int64_t kFormat = 1;
constexpr double kLatest = 1e7;  // s, of a keyframe: as long as Scene::time goes

struct Position {
  std::size_t line = 1, column = 1;
  bool operator<(const Position& o) const { return std::tie(line, column) < std::tie(o.line, o.column); }
};

Position positionOf(const toml::source_region& source) {
  return {std::max<std::size_t>(source.begin.line, 1), std::max<std::size_t>(source.begin.column, 1)};
}

[[noreturn]] void refuse(const std::string& name, Position at, const std::string& what) {
  throw Error(ErrorKind::badInput, fmt::format("{}:{}:{}", name, at.line, at.column), what);
}

// The parser recurses once for every part of a dotted key, so their number is bounded before it sees the text.
void refuseLongKeys(std::string_view text, const std::string& name) {
  Position at;
  int dots = 0;
  std::string_view quote;  // that ends the text we are in
  for (std::size_t i = 0; i < text.size(); ++i, ++at.column) {
    const char c = text[i];
    if (!quote.empty()) {
      if (c == '\\' && quote[0] == '"' && i + 1 < text.size() && text[i + 1] != '\n') {
        ++i, ++at.column;
      } else if (text.substr(i).starts_with(quote) || (c == '\n' && quote.size() == 1)) {
        i += quote.size() - 1, at.column += quote.size() - 1;
        quote = {};
      }
    } else if (c == '"' || c == '\'') {
      const std::string_view three = c == '"' ? "\"\"\"" : "'''";
      quote = text.substr(i).starts_with(three) ? three : three.substr(0, 1);
      i += quote.size() - 1, at.column += quote.size() - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++dots > kMaxDots) refuse(name, at, "this key has too many parts");
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') {
      dots = 0;
    }
    if (i < text.size() && text[i] == '\n') {
      ++at.line;
      at.column = 0;
      if (quote.size() < 2) dots = 0;
    }
  }
}

toml::table parseToml(std::string_view text, const std::string& name) {
  if (text.size() > kMaxSkyBytes) refuse(name, {}, "a sky file is at most 1 MiB long");
  refuseLongKeys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    refuse(name, positionOf(e.source()), std::string(e.description()));
  }
}

std::optional<FieldValue> valueOf(const toml::node& node) {
  if (const auto* v = node.as_floating_point()) return FieldValue(v->get());
  if (const auto* v = node.as_integer()) return FieldValue(v->get());
  if (const auto* v = node.as_boolean()) return FieldValue(v->get());
  if (const auto* v = node.as_string()) return FieldValue(v->get());
  const toml::array* list = node.as_array();
  if (!list || list->size() != 3) return std::nullopt;
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> component = (*list)[i].is_number() ? (*list)[i].value<double>() : std::nullopt;
    if (!component) return std::nullopt;
    vector[i] = *component;
  }
  return FieldValue(vector);
}

std::string joined(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

class Reader {
 public:
  Reader(Scene& scene, const std::string& name) : scene_(scene), name_(name) {
    folder_ = std::filesystem::path(name).parent_path();
  }

  void read(const toml::table& root) {
    checkFormat(root);
    sizeLists(root);
    sections_ = sectionsOf(scene_);
    readTable(root, "");
    if (const toml::node* keyframes = root.get("keyframe")) readKeyframes(*keyframes);
    finish();
  }

  // A file that has nothing but keyframes, for the scene.
  void readKeyframesOf(const toml::table& root) {
    checkFormat(root);
    for (auto&& [key, node] : root)
      if (key != "format" && key != "keyframe")
        report(key.source(), fmt::format("'{}' does not belong here: this file has [[keyframe]] alone", key.str()));
    const toml::node* keyframes = root.get("keyframe");
    if (!keyframes) report(root.source(), "a file of keyframes has at least one [[keyframe]]");
    scene_.keyframes.clear();
    if (keyframes) readKeyframes(*keyframes);
    finish();
  }

 private:
  void finish() const {
    if (problem_) refuse(name_, problem_->first, problem_->second);
  }

  // The tables of the document come sorted by name; of several problems, the reader wants to hear of the first.
  void report(const toml::source_region& source, std::string what) {
    const Position at = positionOf(source);
    if (!problem_ || at < problem_->first) problem_ = {at, std::move(what)};
  }

  void checkFormat(const toml::table& root) {
    const toml::node* node = root.get("format");
    if (!node) refuse(name_, {}, fmt::format("a sky file says 'format = {}' in its first lines", kFormat));
    const auto* format = node->as_integer();
    if (!format || format->get() != kFormat)
      refuse(name_, positionOf(node->source()),
             fmt::format("format must be {}, the only one that this version reads", kFormat));
  }

  void sizeLists(const toml::table& root) {
    const toml::node *layers = root.get("layer"), *sheets = root.get("sheet"), *grids = root.get("grid");
    const toml::node *classical = root.get("classical"), *heroes = root.get("hero");
    if (layers)
      scene_.layers.assign(listSize(*layers, "layer", kMaxLayers), Layer{});
    else if (sheets || grids || classical || heroes)
      scene_.layers.clear();
    if (sheets) scene_.sheets.assign(listSize(*sheets, "sheet", kMaxSheets), Sheet{});
    if (grids) scene_.grids.assign(listSize(*grids, "grid", kMaxGrids), GridCloud{});
    if (classical) scene_.classical.assign(listSize(*classical, "classical", kMaxClassical), Classical{});
    if (heroes) scene_.heroes.assign(listSize(*heroes, "hero", kMaxHeroes), Hero{});
  }

  std::size_t listSize(const toml::node& node, const char* list, std::size_t most) {
    const toml::array* array = node.as_array();
    if (!array || std::any_of(array->begin(), array->end(), [](const toml::node& n) { return !n.is_table(); })) {
      report(node.source(), fmt::format("'{0}' is a list of tables; write [[{0}]]", list));
      return 0;
    }
    if (array->size() > most) {
      report((*array)[most].source(), fmt::format("a sky has at most {} [[{}]]", most, list));
      return most;
    }
    return array->size();
  }

  void readTable(const toml::table& table, const std::string& path) {
    const auto section =
        std::find_if(sections_.begin(), sections_.end(), [&](const Section& s) { return s.path == path; });
    const auto readKey = [&](const toml::key& key, const toml::node& node) {
      const Field* field = section == sections_.end() ? nullptr : findField(*section, key.str());
      if (field)
        readValue(*section, *field, node);
      else if (!path.empty() || (key != "format" && key != "keyframe"))
        readChild(path, key, node);
    };
    // Presets first, whatever else stands in the table wins.
    const char* preset = path == "quality"                                        ? "preset"
                         : path.starts_with("hero.") && tableName(path) == "hero" ? "species"
                                                                                  : "";
    if (*preset && table.contains(preset)) readValue(*section, *findField(*section, preset), *table.get(preset));
    for (auto&& [key, node] : table)
      if (key != preset) readKey(key, node);
  }

  void readChild(const std::string& path, const toml::key& key, const toml::node& node) {
    const std::string child = joined(path, key.str());
    if (path.empty() &&
        (child == "layer" || child == "sheet" || child == "grid" || child == "classical" || child == "hero")) {
      const toml::array* array = node.as_array();
      const std::size_t size = child == "layer"       ? scene_.layers.size()
                               : child == "sheet"     ? scene_.sheets.size()
                               : child == "grid"      ? scene_.grids.size()
                               : child == "classical" ? scene_.classical.size()
                                                      : scene_.heroes.size();
      for (std::size_t i = 0; array && i < size; ++i)
        if (const toml::table* element = (*array)[i].as_table()) readTable(*element, fmt::format("{}.{}", child, i));
      return;
    }
    const bool known = std::any_of(sections_.begin(), sections_.end(), [&](const Section& s) {
      return s.path == child || s.path.starts_with(child + ".");
    });
    if (!known) return report(key.source(), unknownKey(path, key.str()));
    if (const toml::table* table = node.as_table())
      readTable(*table, child);
    else
      report(node.source(), fmt::format("'{0}' is a table; write [{0}]", tableName(child)));
  }

  void readValue(const Section& section, const Field& field, const toml::node& node) {
    const std::string wrong = assign(scene_, section, field, valueFor(field, node));
    if (!wrong.empty()) report(node.source(), fmt::format("{} {}", joined(tableName(section.path), field.name), wrong));
  }

  // What the node holds, or something that the field refuses.
  FieldValue valueFor(const Field& field, const toml::node& node) const {
    std::optional<FieldValue> value = valueOf(node);
    if (!value) value = field.kind == FieldKind::boolean ? FieldValue(std::string()) : FieldValue(false);
    if (field.kind == FieldKind::file)
      if (auto* text = std::get_if<std::string>(&*value); text && !text->empty()) *text = (folder_ / *text).string();
    return *value;
  }

  void readKeyframes(const toml::node& node) {
    const std::size_t count = listSize(node, "keyframe", kMaxKeyframes);
    Scene trial = scene_;  // takes every value once: what it then holds is the value
    const std::vector<Section> sections = sectionsOf(trial);
    std::set<std::pair<double, std::string>> set;
    for (std::size_t i = 0; i < count; ++i) {
      const toml::table& table = *(*node.as_array())[i].as_table();
      Keyframe& keyframe = scene_.keyframes.emplace_back();
      const toml::node* time = table.get("time");
      if (time)
        readTime(*time, keyframe);
      else
        report(table.source(), "a keyframe says when it is: time = 10");
      if (const toml::node* how = table.get("interpolation")) readInterpolation(*how, keyframe);
      for (auto&& [key, child] : table)
        if (key != "time" && key != "interpolation")
          readKey(trial, sections, std::string(key.str()), key, child, keyframe);
      std::sort(keyframe.values.begin(), keyframe.values.end(),
                [](const KeyValue& a, const KeyValue& b) { return a.path < b.path; });
      for (const KeyValue& v : keyframe.values)
        if (!set.emplace(keyframe.time, v.path).second)
          report(table.source(), fmt::format("{} has two values at {} s", v.path, keyframe.time));
    }
  }

  void readTime(const toml::node& node, Keyframe& keyframe) {
    const std::optional<double> time = node.is_number() ? node.value<double>() : std::nullopt;
    if (!time)
      report(node.source(), "keyframe.time must be a number");
    else if (!(*time >= 0.0 && *time <= kLatest))
      report(node.source(), fmt::format("keyframe.time is {:g}, outside 0 to {:g} s", *time, kLatest));
    else
      keyframe.time = *time;
  }

  void readInterpolation(const toml::node& node, Keyframe& keyframe) {
    const auto& names = ChoiceNames<Interpolation>::names;
    const auto* text = node.as_string();
    const auto* found = std::find(names.begin(), names.end(), text ? std::string_view(text->get()) : "");
    if (found == names.end())
      report(node.source(), fmt::format("keyframe.interpolation must be one of \"{}\"", fmt::join(names, "\", \"")));
    else
      keyframe.interpolation = static_cast<Interpolation>(found - names.begin());
  }

  // The parameters below a key of a keyframe; `path` is that of the key.
  void readKey(Scene& trial, std::span<const Section> sections, const std::string& path, const toml::key& key,
               const toml::node& node, Keyframe& keyframe) {
    if (const toml::table* table = node.as_table()) {
      for (auto&& [name, child] : *table) readKey(trial, sections, joined(path, name.str()), name, child, keyframe);
      return;
    }
    const std::string full = withListNumber(path);
    const Parameter p = findParameter(sections, full);
    if (!p.field) return report(key.source(), unknownParameter(trial, sections, full));
    const std::string wrong = assign(trial, *p.section, *p.field, valueFor(*p.field, node));
    if (!wrong.empty()) return report(node.source(), fmt::format("{} {}", full, wrong));
    keyframe.values.push_back({full, p.field->get(p.section->object)});
  }

  std::string unknownKey(const std::string& path, std::string_view key) const {
    std::vector<std::string> known;
    const std::string prefix = path.empty() ? "" : path + ".";
    for (const Section& s : sections_) {
      if (s.path == path) {
        for (const Field& f : s.fields) known.emplace_back(f.name);
      } else if (s.path.starts_with(prefix)) {
        const std::string rest = s.path.substr(prefix.size());
        known.push_back(rest.substr(0, rest.find('.')));
      }
    }
    if (path.empty()) known.insert(known.end(), {"format", "layer", "sheet", "grid", "classical", "hero", "keyframe"});
    const std::string near = nearestName(key, known);
    const std::string table = path.empty() ? "a sky" : tableName(path);
    return fmt::format("'{}' is not a parameter of {}; {}", key, table,
                       near.empty() ? "`welkin fields` lists them" : fmt::format("did you mean '{}'?", near));
  }

  Scene& scene_;
  const std::string& name_;
  std::filesystem::path folder_;
  std::vector<Section> sections_;
  std::optional<std::pair<Position, std::string>> problem_;
};

}  // namespace

Scene parseSky(std::string_view text, const std::string& name) {
  const toml::table root = parseToml(text, name);
  Scene scene;
  Reader(scene, name).read(root);
  return scene;
}

Scene loadSky(const std::string& path) { return parseSky(readFile(path, kMaxSkyBytes + 1), path); }

std::vector<Keyframe> loadKeyframes(const std::string& path, const Scene& scene) {
  const toml::table root = parseToml(readFile(path, kMaxSkyBytes + 1), path);
  Scene read = scene;
  Reader(read, path).readKeyframesOf(root);
  return read.keyframes;
}

std::string tomlVersion() { return fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH); }

namespace {

std::string writeKeyframes(Scene& scene) {
  const std::vector<Section> sections = sectionsOf(scene);
  std::string out;
  for (const Keyframe& keyframe : scene.keyframes) {
    out += fmt::format("\n[[keyframe]]\ntime = {}\n", keyframe.time);
    if (keyframe.interpolation != Interpolation::linear)
      out += fmt::format("interpolation = \"{}\"\n",
                         ChoiceNames<Interpolation>::names[static_cast<std::size_t>(keyframe.interpolation)]);
    for (const KeyValue& v : keyframe.values) {
      const Parameter p = findParameter(sections, v.path);
      if (!p.field) throw Error(ErrorKind::badInput, "keyframe", unknownParameter(scene, sections, v.path));
      out += fmt::format("{} = {}\n", v.path, formatValue(*p.field, v.value));
    }
  }
  return out;
}

}  // namespace

std::string writeSky(const Scene& original) {
  if (original.layers.size() > kMaxLayers || original.sheets.size() > kMaxSheets || original.grids.size() > kMaxGrids ||
      original.classical.size() > kMaxClassical || original.heroes.size() > kMaxHeroes)
    throw Error(ErrorKind::badInput, "",
                fmt::format("a sky has at most {} layers, {} sheets, {} grids, {} classical and {} hero clouds",
                            kMaxLayers, kMaxSheets, kMaxGrids, kMaxClassical, kMaxHeroes));
  Scene scene = original;
  const Scene defaults;
  Scene listsOnly;
  listsOnly.layers = scene.layers;
  const bool noLists = scene.sheets.empty() && scene.grids.empty() && scene.classical.empty() && scene.heroes.empty();
  const bool defaultLayers = noLists && sameScene(listsOnly, defaults);
  // What stands in the tables when nothing but presets has been read.
  Scene presets = scene;
  presets.quality = qualityPreset(scene.quality.preset);
  for (Hero& hero : presets.heroes) hero = heroPreset(hero.cloud.species);
  const std::vector<Section> unwritten = sectionsOf(presets);

  std::string out = fmt::format("format = {}\n", kFormat);
  std::size_t number = 0;
  for (const Section& section : sectionsOf(scene)) {
    const void* preset = unwritten[number++].object;
    if (defaultLayers && section.path.starts_with("layer.")) continue;
    std::string rows;
    for (const Field& f : section.fields) {
      const FieldValue value = f.get(section.object);
      const std::string_view name = f.name;
      const bool follows = (section.object == &scene.quality && name != "preset") ||
                           (section.path.starts_with("hero.") && name != "species");
      if (value != (follows ? f.get(preset) : f.defaultValue))
        rows += fmt::format("{} = {}\n", f.name, formatValue(f, value));
    }
    const bool element = std::count(section.path.begin(), section.path.end(), '.') == 1 &&
                         (section.path.starts_with("layer.") || section.path.starts_with("sheet.") ||
                          section.path.starts_with("grid.") || section.path.starts_with("classical.") ||
                          section.path.starts_with("hero."));
    if (section.path.empty())
      out += rows + (scene.layers.empty() && noLists ? "layer = []\n" : "");
    else if (element)
      out += fmt::format("\n[[{}]]\n{}", tableName(section.path), rows);
    else if (!rows.empty())
      out += fmt::format("\n[{}]\n{}", tableName(section.path), rows);
  }
  return out + writeKeyframes(scene);
}

void saveSky(const Scene& scene, const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal().parent_path();
  const auto nameFrom = [&](const Field& field, FieldValue value) {
    auto* file = std::get_if<std::string>(&value);
    if (field.kind == FieldKind::file && file && !file->empty())
      *file = std::filesystem::absolute(*file).lexically_normal().lexically_proximate(folder).generic_string();
    return value;
  };
  Scene named = scene;
  const std::vector<Section> sections = sectionsOf(named);
  for (const Section& section : sections)
    for (const Field& f : section.fields)
      if (f.kind == FieldKind::file) f.set(section.object, nameFrom(f, f.get(section.object)));
  for (Keyframe& keyframe : named.keyframes)
    for (KeyValue& v : keyframe.values)
      if (const Parameter p = findParameter(sections, v.path); p.field) v.value = nameFrom(*p.field, v.value);
  writeFileAtomically(path, writeSky(named));
}

}  // namespace welkin
