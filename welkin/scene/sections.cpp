#include "welkin/scene/sections.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/error.hpp"

namespace welkin {

namespace {

std::span<const Field> topLevelFields() {
  static const std::vector<Field> kTable{
      field<&Scene::title>("title", "what the sky is called"),
      field<&Scene::time, kSeconds>("time", {0, 1e7}, {0, 3600}, "how long wind and growth have been at work"),
      field<&Scene::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another sky")};
  return kTable;
}

template <class T>
Section section(std::string path, const char* help, T& object) {
  return {std::move(path), help, fieldsOf<T>(), &object};
}

template <class T>
SceneList list(const char* name, std::vector<T>& items, std::size_t most) {
  return {name, items.size(), most, [&items] { items.emplace_back(); },
          [&items](std::size_t i) { items.erase(items.begin() + static_cast<std::ptrdiff_t>(i)); }};
}

}  // namespace

std::vector<Section> sectionsOf(Scene& scene) {
  std::vector<Section> all{{"", "the sky as a whole", topLevelFields(), &scene}};
  all.push_back(section("sun", "where the sun stands", scene.sun));
  all.push_back(section("moon", "where the moon stands", scene.moon));
  all.push_back(section("night", "stars and the air's own light", scene.night));
  all.push_back(section("atmosphere", "the air and what is behind it", scene.atmosphere));
  all.push_back(section("wind", "the wind that moves the layers", scene.wind));
  all.push_back(section("precipitation", "rain and snow", scene.precipitation));
  all.push_back(section("lightning", "flashes inside thunderclouds, in real time", scene.lightning));
  all.push_back(section("ground", "the land below", scene.ground));
  all.push_back(section("lighting", "how clouds are lit in real time", scene.lighting));
  all.push_back(section("camera", "where the picture is taken from", scene.camera));
  all.push_back(section("film", "from light to a picture", scene.film));
  all.push_back(section("quality", "how much work the real-time renderer does", scene.quality));
  all.push_back(section("noise.profile", "noise of shape \"profile\"", scene.noise.profile));
  all.push_back(section("noise.base_shape", "base shape of \"nubis\"", scene.noise.baseShape));
  all.push_back(section("noise.detail", "detail of \"nubis\"", scene.noise.detail));
  all.push_back(section("noise.curl", "flow that bends the detail of \"nubis\"", scene.noise.curl));
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    Layer& layer = scene.layers[i];
    const std::string path = fmt::format("layer.{}", i);
    all.push_back(section(path, "a layer of volumetric clouds", layer.cloud));
    all.push_back(section(path + ".weather", "where the clouds of the layer stand", layer.weather));
    all.push_back(section(path + ".profile", "details of shape \"profile\"", layer.profile));
    all.push_back(section(path + ".nubis", "details of shape \"nubis\"", layer.nubis));
  }
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    all.push_back(section(fmt::format("sheet.{}", i), "a thin high cloud", scene.sheets[i]));
  for (std::size_t i = 0; i < scene.grids.size(); ++i)
    all.push_back(section(fmt::format("grid.{}", i), "a cloud from an OpenVDB file", scene.grids[i]));
  for (std::size_t i = 0; i < scene.classical.size(); ++i) {
    Classical& cloud = scene.classical[i];
    const std::string path = fmt::format("classical.{}", i);
    all.push_back(section(path, "a cloud of one of the classical models", cloud.cloud));
    all.push_back(section(path + ".height_map", "a map of heights, for kind height_map", cloud.heightMap));
    all.push_back(section(path + ".perlin", "a filtered array of noise, for kind perlin", cloud.perlin));
    all.push_back(section(path + ".metaballs", "balls whose fields add up, for kind metaballs", cloud.metaballs));
    all.push_back(section(path + ".ellipsoids", "ellipsoids with a texture, for kind ellipsoids", cloud.ellipsoids));
    all.push_back(section(path + ".particles", "soft balls, for kind particles", cloud.particles));
    all.push_back(
        section(path + ".automaton", "cells of humidity, cloud and activation, for kind automaton", cloud.automaton));
  }
  for (std::size_t i = 0; i < scene.heroes.size(); ++i) {
    Hero& hero = scene.heroes[i];
    const std::string path = fmt::format("hero.{}", i);
    all.push_back(section(path, "a single cloud, modelled by itself", hero.cloud));
    all.push_back(section(path + ".form", "its smooth shape", hero.form));
    all.push_back(section(path + ".surface", "billows and edge", hero.surface));
    all.push_back(section(path + ".classic", "the formula of shape \"classic\"", hero.classic));
    all.push_back(section(path + ".scatter", "copies of it over the land", hero.scatter));
  }
  return all;
}

std::string tableName(std::string_view path) {
  std::string name;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string_view part = path.substr(begin, end - begin);
    if (part.find_first_not_of("0123456789") != std::string_view::npos) {
      if (!name.empty()) name += '.';
      name += part;
    }
    begin = end + 1;
  }
  return name;
}

std::vector<SceneList> listsOf(Scene& scene) {
  return {list("layer", scene.layers, kMaxLayers), list("sheet", scene.sheets, kMaxSheets),
          list("grid", scene.grids, kMaxGrids), list("classical", scene.classical, kMaxClassical),
          list("hero", scene.heroes, kMaxHeroes)};
}

const Field* findField(const Section& section, std::string_view name) {
  for (const Field& f : section.fields)
    if (f.name == name) return &f;
  return nullptr;
}

namespace {

// What is wrong with a date or time of the sun, each judged beside a right one.
std::string checkSunText(std::string_view name, const std::string& text) {
  try {
    if (name == "date") daysFromDateTime(text, "12:00");
    if (name == "time") daysFromDateTime("2000-01-01", text);
  } catch (const Error& e) {
    // "sun: date is ..." without the names, which the caller knows.
    std::string what = e.what();
    for (const std::string& lead : {e.where() + ": ", std::string(name) + " "})
      if (what.starts_with(lead)) what.erase(0, lead.size());
    return what;
  }
  return "";
}

}  // namespace

std::string assign(Scene& scene, const Section& section, const Field& field, FieldValue value) {
  if (std::string wrong = checkField(field, value); !wrong.empty()) return wrong;
  if (field.kind == FieldKind::file) {
    const std::string& path = std::get<std::string>(value);
    std::error_code ignored;
    if (!path.empty() && !std::filesystem::is_regular_file(path, ignored))
      return fmt::format("names the file '{}', which does not exist", path);
  }
  if (section.object == &scene.sun && field.kind == FieldKind::text)
    if (std::string wrong = checkSunText(field.name, std::get<std::string>(value)); !wrong.empty()) return wrong;
  field.set(section.object, value);
  if (section.object == &scene.quality && field.name == std::string_view("preset"))
    scene.quality = qualityPreset(scene.quality.preset);
  for (Hero& hero : scene.heroes)
    if (section.object == &hero.cloud && field.name == std::string_view("species"))
      setSpecies(hero, hero.cloud.species);
  return "";
}

bool sameScene(const Scene& a, const Scene& b) {
  Scene x = a, y = b;
  const std::vector<Section> left = sectionsOf(x), right = sectionsOf(y);
  if (left.size() != right.size()) return false;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].path != right[i].path) return false;
    for (const Field& f : left[i].fields)
      if (f.get(left[i].object) != f.get(right[i].object)) return false;
  }
  return a.keyframes == b.keyframes;
}

}  // namespace welkin
