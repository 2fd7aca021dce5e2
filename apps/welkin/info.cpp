// welkin info: cover, base, top and optical depth of every layer, sheet and hero cloud.
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

// To `digits` significant digits: more are noise of the sampling.
double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

void addDepths(Json& row, const CloudStatistics& s) {
  row["mean_optical_depth"] = rounded(s.meanOpticalDepth, 4);
  row["cloudy_optical_depth"] = rounded(s.cloudyOpticalDepth, 4);
  row["median_optical_depth"] = rounded(s.medianOpticalDepth, 4);
}

Json describe(const Scene& scene, const SkyStatistics& sky) {
  Json layers = Json::array(), sheets = Json::array();
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const CloudLayer& cloud = scene.layers[i].cloud;
    const CloudStatistics& s = sky.layers[i];
    Json row{{"genus", nameOf(cloud.genus)},  {"shape", nameOf(cloud.shape)},
             {"configured_base", cloud.base}, {"configured_top", cloud.base + cloud.thickness},
             {"cover", rounded(s.cover, 4)},  {"base", std::round(s.base)},
             {"top", std::round(s.top)}};
    addDepths(row, s);
    layers.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const Sheet& sheet = scene.sheets[i];
    Json row{
        {"genus", nameOf(sheet.kind)}, {"configured_height", sheet.height}, {"cover", rounded(sky.sheets[i].cover, 4)}};
    addDepths(row, sky.sheets[i]);
    sheets.push_back(std::move(row));
  }
  Json heroes = Json::array();
  for (std::size_t i = 0; i < scene.heroes.size(); ++i) {
    const CloudColumn& middle = sky.heroes[i];
    heroes.push_back({{"species", nameOf(scene.heroes[i].cloud.species)},
                      {"base", std::round(middle.base)},
                      {"top", std::round(middle.top)},
                      {"optical_depth", rounded(middle.opticalDepth, 4)}});
  }
  return {{"title", scene.title},
          {"layers", layers},
          {"sheets", sheets},
          {"heroes", heroes},
          {"cloudy_above", {{"layer", kCloudyLayer}, {"sheet", kCloudySheet}}}};
}

void printRow(const std::string& name, const std::string& genus, const CloudStatistics& s) {
  fmt::print("{:<8} {:<14} {:>5.1f} {:>7.0f} {:>7.0f} {:>9.3g} {:>9.3g} {:>9.3g}\n", name, genus, 100.0 * s.cover,
             s.base, s.top, s.meanOpticalDepth, s.cloudyOpticalDepth, s.medianOpticalDepth);
}

void printTable(const Scene& scene, const SkyStatistics& sky) {
  if (!scene.title.empty()) fmt::print("{}\n\n", scene.title);
  fmt::print("{:<23} {:>5} {:>7} {:>7} {:>29}\n", "", "cover", "base", "top", "vertical optical depth");
  fmt::print("{:<23} {:>5} {:>7} {:>7} {:>9} {:>9} {:>9}\n", "", "%", "m", "m", "area", "in cloud", "median");
  for (std::size_t i = 0; i < sky.layers.size(); ++i)
    printRow(fmt::format("layer {}", i), nameOf(scene.layers[i].cloud.genus), sky.layers[i]);
  for (std::size_t i = 0; i < sky.sheets.size(); ++i)
    printRow(fmt::format("sheet {}", i), nameOf(scene.sheets[i].kind), sky.sheets[i]);
  for (std::size_t i = 0; i < sky.heroes.size(); ++i)
    fmt::print("{:<8} {:<20} {:>7.0f} {:>7.0f} {:>9.3g} over its middle\n", fmt::format("hero {}", i),
               nameOf(scene.heroes[i].cloud.species), sky.heroes[i].base, sky.heroes[i].top,
               sky.heroes[i].opticalDepth);
  fmt::print(
      "\nCloudy columns are those with a vertical optical depth over {} (layers) or {} (sheets). 2 % of them begin\n"
      "below the base, 2 % end above the top. Area: mean over all columns; in cloud, median: over cloudy ones.\n",
      kCloudyLayer, kCloudySheet);
}

}  // namespace

void addInfo(CLI::App& app) {
  auto* command = app.add_subcommand("info", "cover, base, top and optical depth of every layer, sheet and hero cloud");
  auto arguments = std::make_shared<SkyArguments>();
  arguments->addTo(*command, SkyArguments::Need::optional);
  const auto json = addJsonFlag(*command);
  command->callback([arguments, json] {
    const Scene scene = arguments->scene();
    const SkyStatistics sky = measureSky(scene);
    if (*json)
      fmt::print("{}\n", describe(scene, sky).dump(2));
    else
      printTable(scene, sky);
  });
}

}  // namespace welkin::app
