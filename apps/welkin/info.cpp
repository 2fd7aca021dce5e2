// welkin info: cover, base, top and optical depth of every layer and sheet.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "apps/welkin/statistics.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

template <class E>
std::string nameOf(E value) {
  return std::string(ChoiceNames<E>::names[static_cast<std::size_t>(value)]);
}

void addStatistics(Json& row, const std::optional<CloudStatistics>& s) {
  if (!s) return;
  row["cover"] = s->cover;
  row["base"] = s->base;
  row["top"] = s->top;
  row["mean_optical_depth"] = s->meanOpticalDepth;
  row["median_optical_depth"] = s->medianOpticalDepth;
}

Json describe(const Scene& scene) {
  Json layers = Json::array(), sheets = Json::array();
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const CloudLayer& cloud = scene.layers[i].cloud;
    Json row{{"genus", nameOf(cloud.genus)},
             {"shape", nameOf(cloud.shape)},
             {"configured_base", cloud.base},
             {"configured_top", cloud.base + cloud.thickness}};
    addStatistics(row, layerStatistics(scene, i));
    layers.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const Sheet& sheet = scene.sheets[i];
    Json row{{"genus", nameOf(sheet.kind)}, {"configured_height", sheet.height}};
    addStatistics(row, sheetStatistics(scene, i));
    sheets.push_back(std::move(row));
  }
  return {{"title", scene.title}, {"layers", layers}, {"sheets", sheets}};
}

void printRow(const char* list, std::size_t index, const Json& row) {
  fmt::print("{} {}  {}", list, index, row["genus"].get<std::string>());
  if (row.contains("configured_base"))
    fmt::print(", {}, {:.0f} to {:.0f} m", row["shape"].get<std::string>(), row["configured_base"].get<double>(),
               row["configured_top"].get<double>());
  else
    fmt::print(", at {:.0f} m", row["configured_height"].get<double>());
  if (row.contains("cover"))
    fmt::print(
        "; cover {:.0f} %, base {:.0f} m, top {:.0f} m, optical depth {:.3g} over the area, median {:.3g} in cloud",
        100 * row["cover"].get<double>(), row["base"].get<double>(), row["top"].get<double>(),
        row["mean_optical_depth"].get<double>(), row["median_optical_depth"].get<double>());
  fmt::print("\n");
}

}  // namespace

void addInfo(CLI::App& app) {
  auto* command = app.add_subcommand("info", "cover, base, top and optical depth of every layer");
  auto arguments = std::make_shared<SkyArguments>();
  arguments->addTo(*command, SkyArguments::Need::optional);
  const auto json = addJsonFlag(*command);
  command->callback([arguments, json] {
    const Json report = describe(arguments->scene());
    if (*json) {
      fmt::print("{}\n", report.dump(2));
      return;
    }
    for (const char* list : {"layer", "sheet"}) {
      const Json& rows = report[std::string(list) + "s"];
      for (std::size_t i = 0; i < rows.size(); ++i) printRow(list, i, rows[i]);
    }
  });
}

}  // namespace welkin::app
