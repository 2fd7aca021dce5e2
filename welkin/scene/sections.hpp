#pragma once
// The one generic view of a Scene: the sky file, --set, `welkin fields`, the docs and the random-scene tests read it.
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/scene/scene.hpp"

namespace welkin {

// A table of parameters inside a scene, which it must not outlive; nor may the scene's lists grow meanwhile.
struct Section {
  std::string path;  // "layer.0.weather"; empty for the top level
  const char* help;
  std::span<const Field> fields;
  void* object;
};

// Every section of the scene, in the order in which a sky file writes them.
std::vector<Section> sectionsOf(Scene& scene);

// "layer.weather" for "layer.0.weather": the name of a table whichever element of a list it is.
std::string tableName(std::string_view path);

// The field called `name`, or null.
const Field* findField(const Section& section, std::string_view name);

// A parameter by its whole path, in sections of which it is part; both null when there is none.
struct Parameter {
  const Section* section = nullptr;
  const Field* field = nullptr;
};
Parameter findParameter(std::span<const Section> sections, std::string_view path);

// "layer.0.weather.coverage" for "layer.weather.coverage": a list without a number means its first element.
std::string withListNumber(std::string_view path);

// What to say of a path that names no parameter: the nearest one, or how long the list is.
std::string unknownParameter(const Scene& scene, std::span<const Section> sections, std::string_view path);

// A list of a scene, by the name that its tables have in files.
struct SceneList {
  std::string name;
  std::size_t size, most;
  std::function<void()> append;             // an element of defaults
  std::function<void(std::size_t)> remove;  // one that there is
};
std::vector<SceneList> listsOf(Scene& scene);

// Sets one parameter after checking it, and what hangs on it: quality.preset sets the whole table, a
// hero's species all of its tables. Returns what is
// wrong with the value, without the field's name, or an empty text.
std::string assign(Scene& scene, const Section& section, const Field& field, FieldValue value);

// Sets one parameter from text such as "layer.0.weather.coverage=0.5" or "camera.position=0,0,1500"; a list without a
// number means its first element. Returns the parameter's path. Throws Error (badInput).
std::string setField(Scene& scene, std::string_view assignment);

// A value as --set and the sky file write it, shortest text that gives the same bits; texts stand in quotes.
std::string formatValue(const Field& field, const FieldValue& value);

// True when the two have the same layers, sheets, grids, classical and hero clouds and keyframes and every parameter is
// the same.
bool sameScene(const Scene& a, const Scene& b);

}  // namespace welkin
