// welkin vdb: the clouds of a sky as volumes for other renderers.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "apps/welkin/statistics.hpp"
#include "apps/welkin/volume_file.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/usd_volume.hpp"
#include "welkin/scene/animation.hpp"

namespace welkin::app {

namespace {

constexpr double kMostMemory = 4.0 * 1024 * 1024 * 1024;  // bytes for one file; beyond, --tiles
constexpr double kBytesPerBrick = 4500.0;  // of memory: here and in OpenVDB's tree, 512 floats and a mask each
// Of files, measured on the presets. Half floats shrink by a fifth in Blosc, floats by a sixth.
constexpr double kVdbHalf = 1.6, kVdbFull = 3.3, kVdbBase = 2e4;  // bytes for each active voxel, and at least
constexpr double kNanoVdbBrick = 2300.0, kNanoVdbBase = 3e5;      // bytes for each brick, and at least
constexpr int kMostFiles = 100000;

struct VdbArguments {
  SkyArguments sky;
  std::vector<std::string> outputs;
  std::string region, target, up, unit, density, frames, tiles = "1x1";
  double voxel = 10.0, fps = 24.0;
  bool half = false, full = false, quiet = false;
  std::shared_ptr<bool> json;
};

struct Frames {
  bool sequence = false;
  int first = 0, last = 0;
};

struct Job {
  Scene animated, scene;  // with keyframes; at the time that the sky says
  std::string sky;        // what it is called
  std::optional<VolumeTarget> target;
  VolumeConvention convention;
  Region region;
  std::vector<Region> tiles;
  glm::ivec2 across{1};
  Frames frames;
  double voxel = 10.0, fps = 24.0;
  VolumePrecision precision = VolumePrecision::half;
  std::vector<std::string> outputs;
};

bool readInt(const char*& at, const char* end, int& value) {
  const auto [rest, error] = std::from_chars(at, end, value);
  at = rest;
  return error == std::errc();
}

Frames framesOf(const std::string& text) {
  if (text.empty()) return {};
  Frames frames{.sequence = true};
  const char *at = text.data(), *end = at + text.size();
  bool right = readInt(at, end, frames.first);
  frames.last = frames.first;
  if (right && at != end) right = *at++ == '-' && readInt(at, end, frames.last) && at == end;
  if (!right || frames.first < 0 || frames.last < frames.first || frames.last - frames.first >= kMostFiles)
    throw UsageError(fmt::format("--frames {}: write FIRST-LAST, for example 0-119", text));
  return frames;
}

glm::ivec2 tilesAcross(const std::string& text) {
  glm::ivec2 across{0};
  const char *at = text.data(), *end = at + text.size();
  const bool right = readInt(at, end, across.x) && at != end && *at++ == 'x' && readInt(at, end, across.y) && at == end;
  if (!right || across.x < 1 || across.y < 1 || across.x > 1000 || across.y > 1000)
    throw UsageError(
        fmt::format("--tiles {}: write how many from west to east and south to north, for example 2x2", text));
  return across;
}

// "cloud.vdb" -> "cloud_1_0.0012.vdb"
std::string nameOf(const std::string& output, const Job& job, std::size_t tile, int frame) {
  const std::filesystem::path path(output);
  std::string stem = path.stem().string();
  if (job.tiles.size() > 1)
    stem += fmt::format("_{}_{}", tile % job.across.x, tile / static_cast<std::size_t>(job.across.x));
  if (job.frames.sequence) stem += fmt::format(".{:04}", frame);
  return (path.parent_path() / (stem + path.extension().string())).string();
}

template <class T, std::size_t N>
void choose(T& value, const std::string& text, const std::pair<const char*, T> (&names)[N]) {
  for (const auto& [name, meaning] : names)
    if (text == name) value = meaning;
}

Job jobOf(const VdbArguments& a) {
  Job job;
  job.animated = a.sky.animated();
  job.scene = sceneAt(job.animated, static_cast<double>(job.animated.time));
  job.sky = a.sky.sky.empty() ? "default" : std::filesystem::path(a.sky.sky).filename().string();
  job.target = volumeTargetNamed(a.target);
  if (job.target) job.convention = conventionFor(*job.target);
  choose<VolumeUp>(job.convention.up, a.up, {{"z", VolumeUp::z}, {"y", VolumeUp::y}});
  choose<VolumeUnit>(job.convention.unit, a.unit, {{"m", VolumeUnit::m}, {"cm", VolumeUnit::cm}});
  choose<VolumeDensity>(job.convention.density, a.density,
                        {{"normalized", VolumeDensity::normalized},
                         {"extinction", VolumeDensity::extinction},
                         {"lwc", VolumeDensity::lwc}});
  if (a.half && a.full) throw UsageError("--half or --float, not both");
  job.precision = a.full ? VolumePrecision::full : VolumePrecision::half;
  job.voxel = a.voxel, job.fps = a.fps;
  job.frames = framesOf(a.frames);
  job.across = tilesAcross(a.tiles);
  extinctionAtOne(job.scene, job.convention.density);  // refuses a sky without clouds first
  job.region = regionOf(a.region, job.scene, a.voxel);
  job.tiles = tilesOf(job.region, job.across, a.voxel);
  job.outputs = a.outputs;
  bool read = !job.target;
  for (const std::string& output : job.outputs) {
    requireVolumeFile(output);
    read = read || std::filesystem::path(output).extension() == suffixFor(*job.target);
  }
  if (!read)
    throw UsageError(fmt::format("--target {} reads {} files: name one with -o", a.target, suffixFor(*job.target)));
  return job;
}

std::string sizeText(double bytes) {
  return bytes < 1e6   ? fmt::format("{:.0f} kB", bytes / 1e3)
         : bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                       : fmt::format("{:.1f} GB", bytes / 1e9);
}

// Size and time before anything is done, unless programs read what is printed. Throws when a file would not fit.
void announce(const Job& job, const VolumeEstimate& estimate, bool json) {
  const glm::dvec3 size = (job.region.high - job.region.low) / job.voxel;
  const int frames = job.frames.last - job.frames.first + 1;
  const double files = static_cast<double>(job.tiles.size());
  const double perVoxel = job.precision == VolumePrecision::half ? kVdbHalf : kVdbFull;
  double bytes = 0.0;
  for (const std::string& output : job.outputs)
    bytes += output.ends_with(".vol")    ? 4.0 * estimate.voxels
             : output.ends_with(".nvdb") ? kNanoVdbBase * files + kNanoVdbBrick * estimate.activeBricks
                                         : kVdbBase * files + perVoxel * estimate.activeVoxels;
  const double all = files * frames * static_cast<double>(job.outputs.size());
  std::string text = fmt::format(
      "{:.0f} x {:.0f} x {:.0f} voxels of {:g} m, {:g} m east to {:g} m, {:g} m north to {:g} m, {:g} to {:g} m high\n",
      size.x, size.y, size.z, job.voxel, job.region.low.x, job.region.high.x, job.region.low.y, job.region.high.y,
      job.region.low.z, job.region.high.z);
  text += fmt::format("about {:.2g} million active voxels ({:.0f} %){}, {} in {} file{}, {:.0f} s\n",
                      estimate.activeVoxels / 1e6, 100.0 * estimate.activeVoxels / estimate.voxels,
                      frames > 1 ? " a frame" : "", sizeText(bytes * frames), all, all > 1 ? "s" : "",
                      std::ceil(estimate.seconds * frames));
  if (!job.scene.sheets.empty())
    text += fmt::format("note: {} thin high sheet{} left out; a sheet has no thickness\n", job.scene.sheets.size(),
                        job.scene.sheets.size() == 1 ? " is" : "s are");
  if (!json) fmt::print("{}", text);
  std::fflush(stdout);
  if (all > kMostFiles) throw UsageError(fmt::format("that makes more than {} files", kMostFiles));
  const double memory = kBytesPerBrick * estimate.activeBricks / files;
  if (memory > kMostMemory) {
    const int more = static_cast<int>(std::ceil(std::sqrt(memory / kMostMemory)));
    throw Error(ErrorKind::badInput, "",
                fmt::format("one file would take {} of memory; write several with --tiles {}x{}, or larger voxels",
                            sizeText(memory), more * job.across.x, more * job.across.y));
  }
}

void writeStage(const Job& job, const std::string& output) {
  const double units = unitsPerMetre(job.convention.unit);
  std::vector<UsdVolume> volumes;
  for (std::size_t tile = 0; tile < job.tiles.size(); ++tile) {
    const VoxelBox box = boxOf(job.tiles[tile], job.voxel, job.convention);
    UsdVolume volume{{}, box.origin, box.origin + glm::dvec3(box.dims) * box.voxel};
    for (int frame = job.frames.first; frame <= job.frames.last; ++frame)
      volume.files.push_back(std::filesystem::path(nameOf(output, job, tile, frame)).filename().string());
    volumes.push_back(std::move(volume));
  }
  const UsdStage stage{.title = job.scene.title.empty() ? job.sky : job.scene.title,
                       .metresPerUnit = 1.0 / units,
                       .upAxis = job.convention.up == VolumeUp::z ? 'Z' : 'Y',
                       .firstFrame = job.frames.first,
                       .framesPerSecond = job.fps};
  writeFileAtomically(std::filesystem::path(output).replace_extension(".usda").string(), usdStage(stage, volumes));
}

// What was written and which numbers to enter in the other program.
nlohmann::ordered_json summary(const Job& job, const std::vector<std::string>& files, double empty) {
  const VolumeMedium medium = mediumOf(job.scene, job.convention.density);
  const VoxelBox box = boxOf(job.region, job.voxel, job.convention);
  const glm::dvec3 high = box.origin + glm::dvec3(box.dims) * box.voxel;
  return {{"files", files},
          {"density", medium.extinction / unitsPerMetre(job.convention.unit)},
          {"albedo", medium.albedo},
          {"asymmetry", medium.asymmetry},
          {"low", {box.origin.x, box.origin.y, box.origin.z}},
          {"high", {high.x, high.y, high.z}},
          {"voxel", box.voxel.x},
          {"empty", empty},
          {"sheets_left_out", job.scene.sheets.size()}};
}

// The noise textures, where no keyframe changes them.
DensityTextures lastingNoise(const Job& job) {
  if (hasKeyframes(job.animated, "noise.") || hasKeyframes(job.animated, "layer.0.profile.billow_mix")) return {};
  return bakeDensityTextures({.layers = job.scene.layers, .noise = job.scene.noise, .heroes = job.scene.heroes}, {});
}

void write(const VdbArguments& arguments) {
  const Job job = jobOf(arguments);
  DensityField field = densityField(job.scene);
  announce(job, estimateOf(field, job.region, job.voxel), *arguments.json);
  const VoxelBaking baking = bakingOf(job.convention, extinctionAtOne(job.scene, job.convention.density));
  ProgressDisplay display("baking", arguments.quiet ? ProgressStyle::quiet : ProgressStyle::automatic);
  const Progress progress = display.callback();
  const double steps = static_cast<double>(job.tiles.size()) * (job.frames.last - job.frames.first + 1);
  const bool keyed = job.frames.sequence && !job.animated.keyframes.empty();
  const DensityTextures noise = keyed ? lastingNoise(job) : DensityTextures{};
  double done = 0.0, written = 0.0, empty = 0.0;
  std::vector<std::string> files;
  for (int frame = job.frames.first; frame <= job.frames.last; ++frame) {
    const double time = job.scene.time + (job.frames.sequence ? frame / job.fps : 0.0);
    // Values stay in the unit of the sky at its own time: what thins out gets smaller.
    if (keyed)
      field = densityField(sceneAt(job.animated, time), noise);
    else
      field.setDrift({job.scene.wind.speed, job.scene.wind.from, time});
    for (std::size_t tile = 0; tile < job.tiles.size(); ++tile, done += 1.0) {
      const VoxelGrid grid = bakeVoxels(field, boxOf(job.tiles[tile], job.voxel, job.convention), baking,
                                        stageOf(progress, done / steps, (done + 0.9) / steps));
      empty += grid.maximum() == 0.0f;
      for (const std::string& output : job.outputs) {
        const std::string path = nameOf(output, job, tile, frame);
        saveVolume(path, grid, volumeNotes(job.scene, job.sky, job.convention, time), job.precision);
        written += static_cast<double>(std::filesystem::file_size(path));
        files.push_back(path);
      }
      report(progress, (done + 1.0) / steps);
    }
  }
  for (const std::string& output : job.outputs)
    if (output.ends_with(".vdb")) writeStage(job, output);
  if (*arguments.json) {
    fmt::print("{}\n", summary(job, files, empty).dump(2));
    return;
  }
  fmt::print("wrote {}\n", sizeText(written));
  if (empty > 0.0) fmt::print("note: there is no cloud in {} of {} boxes; --region chooses others\n", empty, steps);
  const auto shown = std::find_if(job.outputs.begin(), job.outputs.end(), [&](const std::string& o) {
    return !job.target || o.ends_with(suffixFor(*job.target));
  });
  fmt::print("{}",
             instructionsFor(job.target, mediumOf(job.scene, job.convention.density), job.convention,
                             boxOf(job.region, job.voxel, job.convention), nameOf(*shown, job, 0, job.frames.first)));
}

}  // namespace

void addVdb(CLI::App& app) {
  auto* command = app.add_subcommand("vdb", "the clouds as a volume (OpenVDB, NanoVDB, Mitsuba) for other renderers");
  auto a = std::make_shared<VdbArguments>();
  a->sky.addTo(*command, SkyArguments::Need::optional);
  command
      ->add_option("-o,--output", a->outputs,
                   "the file, or several of one bake: .vdb (a .usda is written beside it), .nvdb or .vol")
      ->type_name("FILE")
      ->expected(1)
      ->take_all()
      ->required();
  command
      ->add_option(
          "--region", a->region,
          "metres: west,south,east,north[,bottom,top], rounded to bricks of 8 voxels; if not given 6 km round the "
          "camera and the height of the clouds, or in a sky without layers the box of its hero clouds")
      ->type_name("BOX");
  command->add_option("--voxel", a->voxel, "edge of a voxel in metres")
      ->type_name("M")
      ->check(CLI::Range(0.05, 10000.0))
      ->capture_default_str();
  command->add_flag("--half", a->half, "half floats (the default)");
  command->add_flag("--float", a->full, "full floats");
  command->add_option("--up", a->up, "which axis points up: z or y (x stays east)")->check(CLI::IsMember({"z", "y"}));
  command->add_option("--unit", a->unit, "unit of the file's lengths: m or cm")->check(CLI::IsMember({"m", "cm"}));
  command
      ->add_option(
          "--density", a->density,
          "what a value is: normalized (1 is the densest layer's extinction), extinction in 1/m, or lwc, liquid "
          "water in g/m^3")
      ->check(CLI::IsMember({"normalized", "extinction", "lwc"}));
  command
      ->add_option(
          "--target", a->target,
          "sets axes, unit and meaning as blender, houdini, unreal, mitsuba or pbrt expect them, and says what "
          "to type there")
      ->check(CLI::IsMember({"blender", "houdini", "unreal", "mitsuba", "pbrt"}));
  command->add_option("--frames", a->frames, "a sequence, FILE.0000.vdb and on")->type_name("FIRST-LAST");
  command->add_option("--fps", a->fps, "frames in a second of wind and growth")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command->add_option("--tiles", a->tiles, "many files where one would not fit: from west to east x south to north")
      ->type_name("NxM")
      ->capture_default_str();
  a->json = addJsonFlag(*command);
  command->add_flag("-q,--quiet", a->quiet, "no progress");
  command->callback([a] { write(*a); });
}

}  // namespace welkin::app
