// Every parameter of the sky, from the field tables.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "apps/viewer/model/simple_fields.hpp"
#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

bool contains(std::string_view text, const std::string& word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

// Every word stands in the name, the section or the help.
bool matches(const std::string& search, const Section& section, const Field& field) {
  const std::string name = section.path + "." + field.name;
  for (std::size_t begin = 0; begin < search.size();) {
    const std::size_t end = std::min(search.find(' ', begin), search.size());
    const std::string word = search.substr(begin, end - begin);
    begin = end + 1;
    if (!contains(name, word) && !contains(field.help, word)) return false;
  }
  return true;
}

std::string headingOf(const std::string& path) {
  if (path.empty()) return "sky";
  std::string heading = path;
  std::replace(heading.begin(), heading.end(), '.', ' ');
  std::replace(heading.begin(), heading.end(), '_', ' ');
  return heading;
}

bool resettable(const Section& section) {
  return std::any_of(section.fields.begin(), section.fields.end(),
                     [&](const Field& f) { return f.get(section.object) != f.defaultValue; });
}

// Lists grow and shrink at the heading of their first section.
void drawListButtons(Workbench& bench) {
  const Scene& scene = bench.document.scene();
  const auto add = [&](const char* label, const char* item, bool room, const std::function<void(Scene&)>& change) {
    ImGui::BeginDisabled(!room);
    if (ImGui::Button(label)) bench.document.edit(std::string("add ") + item, change);
    bench.interface.items.mark(std::string("add ") + item);
    ImGui::EndDisabled();
  };
  add("+ layer", "layer", scene.layers.size() < kMaxLayers, [](Scene& s) { s.layers.emplace_back(); });
  ImGui::SameLine();
  add("+ sheet", "sheet", scene.sheets.size() < kMaxSheets, [](Scene& s) { s.sheets.emplace_back(); });
  ImGui::SameLine();
  add("+ volume", "grid", scene.grids.size() < kMaxGrids, [](Scene& s) { s.grids.emplace_back(); });
  ImGui::SameLine();
  add("+ classical", "classical", scene.classical.size() < kMaxClassical, [](Scene& s) { s.classical.emplace_back(); });
  ImGui::SameLine();
  // Where it is seen at once: ahead of the camera.
  add("+ hero", "hero", scene.heroes.size() < kMaxHeroes, [](Scene& s) {
    Hero hero = heroPreset(HeroSpecies::congestus);
    const double away = 3.0 * static_cast<double>(hero.form.height), heading = static_cast<double>(s.camera.heading);
    hero.cloud.position +=
        glm::dvec3(glm::dvec2(s.camera.position) + away * glm::dvec2(std::sin(heading), std::cos(heading)), 0.0);
    s.heroes.push_back(hero);
  });
}

template <class T>
void erase(std::vector<T>& list, std::size_t index) {
  if (index < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
}

// "layer.1", "sheet.0", "grid.0", "classical.0", "hero.12" can be taken away. Returns whether one was.
bool drawRemove(Workbench& bench, const std::string& path) {
  const std::string table = tableName(path);
  if (table != "layer" && table != "sheet" && table != "grid" && table != "classical" && table != "hero") return false;
  const auto index = static_cast<std::size_t>(std::atoi(path.c_str() + table.size() + 1));
  const bool pressed = ImGui::SmallButton("remove");
  bench.interface.items.mark("remove " + path);
  if (pressed)
    bench.document.edit("remove " + headingOf(path), [&](Scene& s) {
      if (table == "layer") erase(s.layers, index);
      if (table == "sheet") erase(s.sheets, index);
      if (table == "grid") erase(s.grids, index);
      if (table == "classical") erase(s.classical, index);
      if (table == "hero") erase(s.heroes, index);
    });
  return pressed;
}

// Returns whether the sections are still those of the scene.
bool drawOne(Workbench& bench, const Section& section) {
  std::vector<const Field*> shown;
  const std::string table = tableName(section.path);
  for (const Field& f : section.fields)
    if (bench.search.empty() ? !bench.simple || isSimple(table, f.name) : matches(bench.search, section, f))
      shown.push_back(&f);
  if (shown.empty()) return true;
  // What is found is shown; otherwise sections open and close as one likes.
  if (!bench.search.empty()) ImGui::SetNextItemOpen(true);
  const bool first = section.path == "layer.0" || section.path == "layer.0.weather";
  const bool open = ImGui::CollapsingHeader((headingOf(section.path) + "##" + section.path).c_str(),
                                            first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  bench.interface.items.mark("section " + section.path);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", section.help);
  if (!open) return true;
  ImGui::PushID(section.path.c_str());
  ImGui::Indent(ImGui::GetFontSize() * 0.4f);
  for (const Field* f : shown) drawField(bench, section, *f);
  bool alive = true;
  if (bench.search.empty()) {
    if (resettable(section)) {
      if (ImGui::SmallButton("reset section")) bench.document.resetSection(section.path);
      bench.interface.items.mark("reset " + section.path);
      ImGui::SameLine();
    }
    alive = !drawRemove(bench, section.path);
    ImGui::NewLine();
  }
  ImGui::Unindent(ImGui::GetFontSize() * 0.4f);
  ImGui::PopID();
  return alive;
}

}  // namespace

void drawSection(Workbench& bench, const std::string& path) {
  for (const Section& section : bench.document.sections())
    if (section.path == path)
      for (const Field& f : section.fields) drawField(bench, section, f);
}

void drawParameters(Workbench& bench) {
  const float width = ImGui::GetContentRegionAvail().x;
  if (bench.focusSearch) ImGui::SetKeyboardFocusHere();
  bench.focusSearch = false;
  ImGui::SetNextItemWidth(width * 0.62f);
  ImGui::InputTextWithHint("##search", "search: coverage, haze, base …", &bench.search);
  bench.interface.items.mark("search");
  ImGui::SameLine();
  bool all = !bench.simple;
  if (ImGui::Checkbox("all", &all)) bench.simple = !all;
  bench.interface.items.mark("all parameters");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("every parameter, not only those that matter most");
  drawListButtons(bench);
  ImGui::Separator();
  ImGui::BeginChild("##parameters");
  // Clouds first: they are what one came for.
  for (const bool clouds : {true, false})
    for (const Section& section : bench.document.sections()) {
      const std::string_view table = std::string_view(section.path).substr(0, section.path.find('.'));
      const bool isCloud =
          table == "layer" || table == "sheet" || table == "grid" || table == "classical" || table == "hero";
      if (isCloud == clouds && !drawOne(bench, section)) {
        ImGui::EndChild();
        return;
      }
    }
  ImGui::EndChild();
}

}  // namespace welkin::viewer
