// welkin fields: every parameter with unit, default, range and help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

const char* kindName(FieldKind kind) {
  static constexpr const char* kNames[] = {"real", "integer", "boolean", "choice", "text", "file", "vector"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string pathOf(const Section& section, const Field& field) {
  const std::string table = tableName(section.path);
  return table.empty() ? field.name : table + "." + field.name;
}

Json jsonOf(const Field& f, const Range& range) {
  const auto bound = [&](double v) {
    if (!std::isfinite(v)) return Json(nullptr);
    return f.kind == FieldKind::integer ? Json(static_cast<std::int64_t>(v)) : Json(v);
  };
  return {bound(range.low), bound(range.high)};
}

bool hasRange(const Field& f) {
  return f.kind == FieldKind::real || f.kind == FieldKind::integer || f.kind == FieldKind::vector;
}

void printJson(const std::vector<Section>& sections) {
  Json all = Json::array();
  for (const Section& section : sections)
    for (const Field& f : section.fields) {
      Json row{{"path", pathOf(section, f)}, {"kind", kindName(f.kind)}, {"unit", f.unit.symbol}};
      // Defaults such as 0.1f are shown as files write them.
      const Json text = Json::parse(formatValue(f, f.defaultValue), nullptr, false);
      row["default"] = text;
      if (hasRange(f)) {
        row["range"] = jsonOf(f, f.hard);
        row["slider"] = jsonOf(f, f.soft);
      }
      if (f.kind == FieldKind::choice) row["choices"] = f.choices;
      if (!f.allowed.empty()) row["choices"] = f.allowed;
      row["help"] = f.help;
      all.push_back(std::move(row));
    }
  fmt::print("{}\n", all.dump(2));
}

std::string limits(const Field& f) {
  if (!f.allowed.empty()) return fmt::format("{}", fmt::join(f.allowed, " | "));
  if (f.kind == FieldKind::choice) return fmt::format("{}", fmt::join(f.choices, " | "));
  if (hasRange(f)) return fmt::format("{:g} .. {:g}", f.hard.low, f.hard.high);
  return kindName(f.kind);
}

void printText(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    const std::string table = tableName(section.path);
    const bool list = table == "layer" || table == "sheet" || table == "grid" || table == "hero";
    fmt::print("{}  {}\n",
               table.empty() ? "(top level)"
               : list        ? fmt::format("[[{}]]", table)
                             : fmt::format("[{}]", table),
               section.help);
    for (const Field& f : section.fields) {
      const std::string unit = *f.unit.symbol ? fmt::format(" {}", f.unit.symbol) : "";
      fmt::print("  {:<18} {} ({}{})  {}\n", f.name, formatValue(f, f.defaultValue), limits(f), unit, f.help);
    }
    fmt::print("\n");
  }
}

// A bar would end a cell of a Markdown table.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : std::string(1, c);
  return out;
}

// What docs/fields.md holds.
void printMarkdown(const std::vector<Section>& sections) {
  fmt::print("# Parameters of a sky\n\nMade by `scripts/write_fields`; do not edit.\n");
  for (const Section& section : sections) {
    const std::string table = tableName(section.path);
    fmt::print("\n## {}\n\n{}\n\n", table.empty() ? "top level" : "`" + table + "`", section.help);
    fmt::print("| name | default | range | unit | meaning |\n|---|---|---|---|---|\n");
    for (const Field& f : section.fields) {
      const std::string range = hasRange(f) && f.allowed.empty() ? fmt::format("{:g} to {:g}", f.hard.low, f.hard.high)
                                : f.kind == FieldKind::choice || !f.allowed.empty() ? escaped(limits(f))
                                                                                    : kindName(f.kind);
      fmt::print("| `{}` | `{}` | {} | {} | {} |\n", f.name, formatValue(f, f.defaultValue), range, f.unit.symbol,
                 escaped(f.help));
    }
  }
}

}  // namespace

void addFields(CLI::App& app) {
  auto* command = app.add_subcommand("fields", "every parameter of a sky with unit, default, range and help");
  const auto json = addJsonFlag(*command);
  const auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "print tables for a page of documentation");
  command->callback([json, markdown] {
    Scene scene;
    scene.sheets.emplace_back();
    scene.grids.emplace_back();
    scene.heroes.emplace_back();
    const std::vector<Section> sections = sectionsOf(scene);
    if (*json)
      printJson(sections);
    else if (*markdown)
      printMarkdown(sections);
    else
      printText(sections);
  });
}

}  // namespace welkin::app
