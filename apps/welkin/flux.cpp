// welkin flux: reflected, transmitted and absorbed light of any grid of extinction.
#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/raw_grid.hpp"
#include "welkin/io/vdb.hpp"
#include "welkin/trace/flux.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFaceNames[] = {"x-", "x+", "y-", "y+", "bottom", "top"};
constexpr std::size_t kMostPhaseText = std::size_t(64) << 20;

struct FluxArguments {
  std::string grid, raw, dims, voxel, sides = "none", albedo = "1", phase = "hg:0.85", sun = "beam", photons = "1e6";
  std::vector<std::string> views;
  FluxSettings settings;
  bool json = false;
};

// `count` numbers with commas between them.
std::vector<double> numbersOf(const std::string& text, std::size_t count, const std::string& option) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = text.data() + text.size();
  while (at != end) {
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    const bool fits =
        error == std::errc() && std::isfinite(number) && (stop == end || (*stop == ',' && stop + 1 != end));
    if (!fits) break;
    numbers.push_back(number);
    at = stop == end ? end : stop + 1;
  }
  if (at != end || numbers.size() != count)
    throw UsageError(fmt::format("{} {}: expected {}", option, text,
                                 count == 1 ? "a number" : fmt::format("{} numbers with commas between them", count)));
  return numbers;
}

double numberOf(const std::string& text, const std::string& option, double low, double high) {
  const double number = numbersOf(text, 1, option).front();
  if (number < low || number > high)
    throw UsageError(fmt::format("{} {}: expected a number from {:.15g} to {:.15g}", option, text, low, high));
  return number;
}

PhaseTable phaseOf(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon), value = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "hg") return PhaseTable::henyeyGreenstein(numberOf(value, "--phase hg:", -0.999, 0.999));
  if (kind == "draine") return PhaseTable::mie(computeMiePhase(numberOf(value, "--phase draine:", 5.0, 50.0)));
  if (kind == "table" && !value.empty()) return PhaseTable::parse(readFile(value, kMostPhaseText), value);
  throw UsageError(fmt::format("--phase {}: expected hg:G, draine:D or table:FILE", text));
}

RawGridLayout layoutOf(const FluxArguments& a) {
  RawGridLayout layout;
  if (!a.dims.empty()) {
    const std::vector<double> n = numbersOf(a.dims, 3, "--dims");
    for (const double d : n)
      if (d != std::floor(d) || d < 1.0 || d > 1 << 24)
        throw UsageError(fmt::format("--dims {}: expected whole numbers from 1 to 2^24", a.dims));
    layout.dims = glm::ivec3(n[0], n[1], n[2]);
  }
  if (!a.voxel.empty()) {
    const std::vector<double> size = numbersOf(a.voxel, 3, "--voxel");
    for (const double d : size)
      if (!(d >= 1e-6 && d <= 1e9)) throw UsageError(fmt::format("--voxel {}: expected sizes in m", a.voxel));
    layout.voxel = glm::dvec3(size[0], size[1], size[2]);
  }
  return layout;
}

// The extinction of an OpenVDB file: its values are in 1/m, unless it says what a value of 1 means.
VoxelGrid extinctionOf(const std::string& path) {
  VdbGrid file = loadVdb(path);
  const auto note = [&](const char* name) {
    const auto at = file.notes.find(name);
    return at == file.notes.end() ? std::string() : at->second;
  };
  if (file.placement != glm::dmat4(1.0) || note("up_axis") == "y")
    throw Error(ErrorKind::badInput, path, "its grid does not stand on x, y and z upward: export it with z up");
  if (note("units") == "cm") throw Error(ErrorKind::badInput, path, "its lengths are in cm: export it in m");
  const std::string at1 = note("extinction_per_metre_at_1");
  if (at1.empty()) return std::move(file.voxels);
  const double scale = std::strtod(at1.c_str(), nullptr);
  if (!(scale > 0.0 && scale < 1e6))
    throw Error(ErrorKind::badInput, path, "its extinction_per_metre_at_1 is not a positive number: " + at1);
  VoxelGrid scaled(file.voxels.dims(), file.voxels.origin(), file.voxels.voxel());
  const glm::ivec3 n = scaled.dims();
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; ++x)
        scaled.set({x, y, z}, static_cast<float>(scale * double(file.voxels.at({x, y, z}))));
  return scaled;
}

// The number of --albedo, or the grid of its file; sizes are those of the extinction.
std::optional<VoxelGrid> albedoOf(const std::string& text, const VoxelGrid& extinction, FluxSettings& settings) {
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && stop == text.data() + text.size()) {
    settings.albedo = numberOf(text, "--albedo", 0.0, 1.0);
    return std::nullopt;
  }
  VoxelGrid grid = loadRawGrid(text, {extinction.dims(), extinction.voxel()});
  if (grid.maximum() > 1.0f) throw Error(ErrorKind::badInput, text, "an albedo is at most 1");
  return grid;
}

FluxSettings settingsOf(const FluxArguments& a) {
  FluxSettings s = a.settings;
  s.sides = a.sides == "xy" ? FluxSides::periodic : FluxSides::open;
  s.light = a.sun == "beam" ? FluxLight::beam : a.sun == "diffuse" ? FluxLight::diffuse : FluxLight::isotropic;
  const double photons = numberOf(a.photons, "--photons", 2.0, 1e15);
  if (photons != std::floor(photons)) throw UsageError(fmt::format("--photons {}: expected a whole number", a.photons));
  s.photons = static_cast<std::uint64_t>(photons);
  for (const std::string& view : a.views) {
    const std::vector<double> v = numbersOf(view, 2, "--view");
    if (v[0] < 0.0 || v[0] > 180.0 || (v[0] > 89.9 && v[0] < 90.1))
      throw UsageError(
          fmt::format("--view {}: expected a zenith angle from 0 to 89.9, or from 90.1 to 180 from below", view));
    s.views.push_back({v[0], v[1]});
  }
  return s;
}

Json describe(const FluxEstimate& e) { return {{"mean", e.mean}, {"se", e.se}}; }
Json describe(const FluxField& f) {
  return {{"mean", f.mean}, {"se", f.se}, {"columns", f.columns}, {"columns_se", f.columnsSe}};
}

Json describe(const VoxelGrid& grid, const FluxSettings& s, const FluxResult& r) {
  const glm::ivec3 n = grid.dims();
  const glm::dvec3 v = grid.voxel();
  Json all{{"dims", {n.x, n.y, n.z}},
           {"voxel", {v.x, v.y, v.z}},
           {"photons", s.photons},
           {"R", describe(r.reflected)},
           {"T", describe(r.transmitted)},
           {"A", describe(r.absorbed)},
           {"unscattered", describe(r.unscattered)},
           {"scatterings", describe(r.scatterings)},
           {"path", describe(r.path)}};
  if (s.sides == FluxSides::open)
    for (std::size_t f = 0; f < 6; ++f) {
      all["faces"][kFaceNames[f]] = describe(r.faces[f]);
      all["incident"][kFaceNames[f]] = r.incident[f];
    }
  for (std::size_t i = 0; i < s.views.size(); ++i)
    all["radiance"].push_back({{"zenith", s.views[i].zenith},
                               {"azimuth", s.views[i].azimuth},
                               {"mean", r.radiance[i].mean},
                               {"se", r.radiance[i].se}});
  return all;
}

void printRow(const std::string& name, const FluxEstimate& e, const char* meaning) {
  fmt::print("{:<20} {:>10.6f} {:>10.6f}  {}\n", name, e.mean, e.se, meaning);
}

void printTable(const VoxelGrid& grid, const FluxSettings& s, const FluxResult& r) {
  fmt::print("{} x {} x {} voxels, {} photons\n\n", grid.dims().x, grid.dims().y, grid.dims().z, s.photons);
  fmt::print("{:<20} {:>10} {:>10}\n", "", "mean", "+-");
  printRow("R", r.reflected, "leaves through the top");
  printRow("T", r.transmitted, "comes down to the surface");
  printRow("A", r.absorbed, "is absorbed in the medium");
  printRow("unscattered", r.unscattered, "leaves without any event");
  if (s.sides == FluxSides::open)
    for (std::size_t f = 0; f < 4; ++f) printRow(fmt::format("face {}", kFaceNames[f]), r.faces[f], "leaves there");
  for (std::size_t i = 0; i < s.views.size(); ++i)
    printRow(fmt::format("view {:g},{:g}", s.views[i].zenith, s.views[i].azimuth), r.radiance[i],
             s.light == FluxLight::beam ? "pi I / (mu0 F)" : "I / I0");
  fmt::print("\n{:.4g} scatterings and a path of {:.4g} m a photon.\n", r.scatterings.mean, r.path.mean);
  if (s.sides == FluxSides::open && s.light == FluxLight::beam && r.incident[5] < 1.0)
    fmt::print("Fractions of all the light that enters: {:.1f} % of it does through the top, the rest through sides.\n",
               100.0 * r.incident[5]);
}

void runFlux(const FluxArguments& a) {
  if (a.grid.empty() == a.raw.empty()) throw UsageError("one grid is needed: --grid FILE.vdb or --raw FILE.f32");
  FluxSettings settings = settingsOf(a);
  const RawGridLayout layout = layoutOf(a);
  if (!a.grid.empty() && (layout.dims || layout.voxel))
    throw UsageError("--dims and --voxel describe a raw grid: a .vdb file brings its own");
  const PhaseTable phase = phaseOf(a.phase);
  const VoxelGrid extinction = a.grid.empty() ? loadRawGrid(a.raw, layout) : extinctionOf(a.grid);
  const std::optional<VoxelGrid> albedo = albedoOf(a.albedo, extinction, settings);
  ProgressDisplay display("following photons", a.json ? ProgressStyle::quiet : ProgressStyle::automatic);
  const FluxResult result = traceFlux(extinction, albedo ? &*albedo : nullptr, phase, settings, display.callback());
  if (a.json)
    fmt::print("{}\n", describe(extinction, settings, result).dump(2));
  else
    printTable(extinction, settings, result);
}

}  // namespace

void addFlux(CLI::App& app) {
  auto* command = app.add_subcommand("flux", "reflected, transmitted and absorbed light of a grid of extinction");
  auto a = std::make_shared<FluxArguments>();
  command->add_option("--grid", a->grid, "an OpenVDB file; 1/m, or as its extinction_per_metre_at_1 says; z up, m")
      ->type_name("FILE");
  command
      ->add_option("--raw", a->raw,
                   "raw little-endian floats in 1/m, x fastest, z up; FILE.json may hold width, height, depth, voxel")
      ->type_name("FILE");
  command->add_option("--dims", a->dims, "voxels of the raw grid")->type_name("NX,NY,NZ");
  command->add_option("--voxel", a->voxel, "size of a voxel of the raw grid, in m")->type_name("DX,DY,DZ");
  command->add_option("--periodic", a->sides, "xy: the box repeats along x and y; none: its sides are open")
      ->check(CLI::IsMember({"xy", "none"}))
      ->capture_default_str();
  command->add_option("--albedo", a->albedo, "of single scattering, or a raw grid of it with the same voxels")
      ->type_name("W|FILE")
      ->capture_default_str();
  command
      ->add_option("--phase", a->phase,
                   "hg:G asymmetry; draine:D droplets of D um; table:FILE angle in degrees and value in each line")
      ->type_name("PHASE")
      ->capture_default_str();
  command->add_option("--sun-zenith", a->settings.sun.zenith, "angle of the sun from the zenith, in degrees")
      ->type_name("DEG")
      ->check(CLI::Range(0.0, 89.9))
      ->capture_default_str();
  command
      ->add_option("--sun-azimuth", a->settings.sun.azimuth,
                   "toward the sun, counter-clockwise from +x: at 0 the beam comes from +x")
      ->type_name("DEG")
      ->check(CLI::Range(-3600.0, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--sun", a->sun,
                   "beam: parallel light onto every face that it reaches; diffuse: isotropic through the top; "
                   "isotropic: through every open face")
      ->check(CLI::IsMember({"beam", "diffuse", "isotropic"}))
      ->capture_default_str();
  command->add_option("--surface-albedo", a->settings.surfaceAlbedo, "of the Lambertian surface under the box")
      ->type_name("A")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--photons", a->photons, "how many are followed")->type_name("N")->capture_default_str();
  command->add_option("--seed", a->settings.seed, "of the random numbers")->type_name("N")->capture_default_str();
  command
      ->add_option("--view", a->views,
                   "direction toward a viewer: pi I / (mu0 F), mean over the top (from below: the bottom); repeatable")
      ->type_name("ZENITH,AZIMUTH");
  command->add_flag("--json", a->json, "as JSON: R, T, A with mean, se, columns (x fastest), and the rest");
  command->callback([a] { runFlux(*a); });
}

}  // namespace welkin::app
