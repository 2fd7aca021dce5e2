// welkin cloud: the species of hero clouds, one of them as tables of a sky file, and how it looks.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "apps/welkin/interrupt.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/density/hero_grid.hpp"
#include "welkin/io/png.hpp"
#include "welkin/scene/camera.hpp"
#include "welkin/scene/sections.hpp"
#include "welkin/trace/denoise.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::app {

namespace {

struct CloudArguments {
  std::string species, preview, size = "640x480";
  std::vector<std::string> assignments;
  bool volume = false;
  int samples = 32;
  std::shared_ptr<bool> json;
};

std::string speciesName(HeroSpecies species) {
  return std::string(ChoiceNames<HeroSpecies>::names[static_cast<std::size_t>(species)]);
}

void listSpecies(bool json) {
  auto all = nlohmann::ordered_json::array();
  if (!json)
    fmt::print("{:<24} {:<10} {:>9} {:>9} {:>15}\n", "species", "shape", "width, m", "height, m", "extinction, 1/m");
  for (std::size_t i = 0; i < ChoiceNames<HeroSpecies>::names.size(); ++i) {
    const auto species = static_cast<HeroSpecies>(i);
    const Hero hero = heroPreset(species);
    const std::string_view shape = ChoiceNames<HeroShape>::names[static_cast<std::size_t>(hero.form.shape)];
    if (json)
      all.push_back({{"species", speciesName(species)},
                     {"shape", shape},
                     {"width", hero.form.width},
                     {"height", hero.form.height},
                     {"extinction", hero.cloud.extinction}});
    else
      fmt::print("{:<24} {:<10} {:>9.0f} {:>9.0f} {:>15g}\n", speciesName(species), shape, hero.form.width,
                 hero.form.height, hero.cloud.extinction);
  }
  if (json) fmt::print("{}\n", all.dump(2));
}

// A sky that holds nothing but the cloud.
Scene sceneOfCloud(const CloudArguments& a) {
  Scene scene;
  scene.layers.clear();
  scene.heroes.resize(1);
  const auto set = [&](const std::string& assignment) {
    try {
      setField(scene, "hero." + assignment);
    } catch (const Error& e) {
      throw UsageError(e.what());
    }
  };
  set("species=" + a.species);
  for (const std::string& assignment : a.assignments) set(assignment);
  return scene;
}

// Every parameter of the cloud with its meaning, but those of a shape that it has not.
void printTables(Scene& scene) {
  fmt::print("# A hero cloud for a sky file; `welkin vdb` with that file bakes it.\n");
  for (const Section& section : sectionsOf(scene)) {
    const std::string table = tableName(section.path);
    if (table.substr(0, 4) != "hero") continue;
    if (table == "hero.classic" && scene.heroes.front().form.shape != HeroShape::classic) continue;
    fmt::print("{}\n", table == "hero" ? "[[hero]]" : fmt::format("\n[{}]", table));
    for (const Field& f : section.fields) {
      const std::string unit = *f.unit.symbol ? fmt::format("{}: ", f.unit.symbol) : "";
      fmt::print("{} = {}  # {}{}\n", f.name, formatValue(f, f.get(section.object)), unit, f.help);
    }
  }
}

// The cloud as its preview shows it: at the world's origin, its length across the picture.
Hero standingStill(const Scene& scene) {
  Hero hero = alone(scene.heroes.front());
  hero.cloud.position.x = hero.cloud.position.y = 0.0;
  hero.cloud.heading = HeroCloud{}.heading;
  return hero;
}

// 003 ch. 4.4: the cloud in two dimensions. A section through the middle of its base, along its length, as bright as a
// slice of a twentieth of its size is opaque, over the grey outline of all of it seen from the side.
void drawSection(const Scene& scene, const Size& size, const std::string& path) {
  constexpr int kSlices = 48;
  constexpr double kSlice = 0.05, kMargin = 1.06, kOutline = 0.3;
  const Hero hero = standingStill(scene);
  const DensityField field({.seed = scene.seed, .heroes = std::span(&hero, 1)});
  const HeroBody& body = field.heroes().front();
  const glm::dvec3 low = body.lowest(), high = body.highest(), extent = high - low, middle = 0.5 * (low + high);
  const double pixel = kMargin * std::max(extent.x / size.width, extent.z / size.height);
  const double thick = kSlice * std::sqrt(extent.x * extent.z);
  std::vector<std::uint8_t> grey;
  std::vector<glm::dvec3> points(static_cast<std::size_t>(size.width) * (kSlices + 1));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double east = middle.x + pixel * (x + 0.5 - 0.5 * size.width);
      const double up = middle.z - pixel * (y + 0.5 - 0.5 * size.height);
      points[static_cast<std::size_t>(x)] = {east, 0.0, up};
      for (int k = 0; k < kSlices; ++k)
        points[static_cast<std::size_t>(size.width) * (k + 1) + x] = {east, low.y + (k + 0.5) / kSlices * extent.y, up};
    }
    const std::vector<float> sigma = field.extinction(points, static_cast<float>(pixel));
    for (int x = 0; x < size.width; ++x) {
      double depth = 0.0;
      for (int k = 1; k <= kSlices; ++k) depth += sigma[static_cast<std::size_t>(size.width) * k + x];
      const double all = 1.0 - std::exp(-depth * extent.y / kSlices);
      const double slice = 1.0 - std::exp(-static_cast<double>(sigma[static_cast<std::size_t>(x)]) * thick);
      grey.push_back(static_cast<std::uint8_t>(std::lround(255.0 * (kOutline * all + (1.0 - kOutline) * slice))));
    }
  }
  savePng(path, size.width, size.height, 1, grey);
}

// Voxels of the cloud as the scene's only grid, seen from beside and, where the ground allows, below it.
void traceVolume(Scene scene, const Size& size, const CloudArguments& a) {
  constexpr double kMargin = 1.1, kBelow = 0.1;
  constexpr float kField = 0.66f, kSunElevation = 0.6f, kSunSide = 0.9f;  // rad, by eye
  const Hero hero = standingStill(scene);
  const PlacedGrid voxels = heroGrid(hero, scene.time, scene.seed);
  const WorldBox box = boundsOf(voxels);
  const HeroCloud& cloud = hero.cloud;
  scene.heroes.clear();
  // The tracer is handed the voxels: no file of this name is read.
  scene.grids = {{.file = "voxels of the hero cloud",
                  .albedo = cloud.albedo,
                  .phase = cloud.phase,
                  .dropletDiameter = cloud.dropletDiameter,
                  .asymmetry = cloud.asymmetry}};
  const glm::dvec3 extent = box.high - box.low, middle = 0.5 * (box.low + box.high);
  const double across = std::tan(0.5 * kField), up = across * size.height / size.width;
  const double away = 0.5 * kMargin * std::max(extent.x / across, extent.z / up) + 0.5 * extent.y;
  Camera& camera = scene.camera;
  camera = {.position = {middle.x, middle.y - away, std::max(box.low.z - kBelow * away, 2.0)}, .fov = kField};
  camera.heading = 0.0f;
  camera.pitch = static_cast<float>(std::atan2(middle.z - camera.position.z, away));
  scene.sun.elevation = kSunElevation;
  scene.sun.azimuth = static_cast<float>(3.14159265 - kSunSide);  // behind the camera, to its right
  const InterruptGuard guard;
  trace::PathTracer tracer(scene, {.grids = std::span(&voxels, 1)},
                           {.width = size.width, .height = size.height, .samples = a.samples});
  ProgressDisplay display("tracing", ProgressStyle::automatic);
  const Progress progress = display.callback();
  if (!tracer.run([&](double done) { return !guard.asked() && progress(done); }))
    fmt::print(stderr, "interrupted: the picture so far was written to {}\n", a.preview);
  savePicture(a.preview, trace::denoise(tracer.layers(), trace::Outliers::dimmed), scene.film);
}

void show(const CloudArguments& a) {
  const bool drawing = !a.preview.empty();
  if (a.species.empty()) {
    if (drawing || !a.assignments.empty())
      throw UsageError("cloud: name a species first; `welkin cloud` alone lists them");
    return listSpecies(*a.json);
  }
  if (*a.json)
    throw UsageError("cloud: --json is for the list of species; `welkin fields --json` describes parameters");
  if (a.volume && !drawing) throw UsageError("--volume draws a preview: name its file with --preview");
  const Size size = parseSize(a.size);
  Scene scene = sceneOfCloud(a);
  if (drawing) {
    if (!a.volume && !isDisplayPicture(a.preview))
      throw UsageError(fmt::format("'{}': the section is a picture for the eye: name it .png", a.preview));
    requirePictureFile(a.preview);
    a.volume ? traceVolume(scene, size, a) : drawSection(scene, size, a.preview);
  }
  printTables(scene);
}

}  // namespace

void addCloud(CLI::App& app) {
  auto* command =
      app.add_subcommand("cloud", "hero clouds: their species, one of them as tables of a sky file, previews");
  auto a = std::make_shared<CloudArguments>();
  command->add_option("species", a->species, "the kind of cloud; none lists them")->type_name("SPECIES");
  command->add_option("--set", a->assignments, "a parameter of the cloud, e.g. seed=4 or form.anvil=9000")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--preview", a->preview,
                   "a picture (.png): a section through its middle over the outline of all of it")
      ->type_name("FILE");
  command->add_flag("--volume", a->volume, "the preview is path-traced, as a volume under a sky: .png or .exr");
  command->add_option("--samples", a->samples, "paths of a pixel, with --volume")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command->add_option("--size", a->size, "of the preview")->type_name("WxH")->capture_default_str();
  a->json = addJsonFlag(*command);
  command->callback([a] { show(*a); });
}

}  // namespace welkin::app
