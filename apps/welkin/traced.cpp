#include "apps/welkin/traced.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "apps/welkin/interrupt.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/scene/features.hpp"
#include "welkin/scene/sections.hpp"
#include "welkin/trace/denoise.hpp"

namespace welkin::app {

namespace {

constexpr int kSamples = 64, kMostSamples = 4096;

// All that a picture depends on, as text.
std::string identityOf(const Scene& source, std::span<const Volume> maps, const trace::TraceSettings& settings) {
  Scene scene = source;
  std::string text = fmt::format("{} {} {}x{} {} {} {} {} {}", WELKIN_VERSION, trace::laneCount(), settings.width,
                                 settings.height, settings.samples, settings.noise, static_cast<int>(settings.air),
                                 static_cast<int>(settings.sunDisc), settings.scatterings);
  for (const Section& section : sectionsOf(scene))
    for (const Field& field : section.fields)
      text += fmt::format("\n{}.{}={}", section.path, field.name, formatValue(field, field.get(section.object)));
  for (const Volume& map : maps)
    text.append(reinterpret_cast<const char*>(map.texels.data()), map.texels.size() * sizeof(float));
  return text;
}

// FNV-1a.
std::uint64_t hashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

// The file that holds what has been traced so far: a hash of all that the picture depends on, then the tracer's state.
class Checkpoint {
 public:
  Checkpoint(std::string path, const Scene& scene, std::span<const Volume> maps, const trace::TraceSettings& settings)
      : path_(std::move(path)) {
    if (path_.empty()) return;
    requireWritable(path_);
    hash_ = hashOf(identityOf(scene, maps, settings));
  }

  void restore(trace::PathTracer& tracer) const {
    if (path_.empty() || !std::filesystem::exists(path_)) return;
    const std::string bytes = readFile(path_, std::size_t{1} << 34);
    std::uint64_t hash = 0;
    if (bytes.size() >= sizeof hash) std::memcpy(&hash, bytes.data(), sizeof hash);
    if (bytes.size() < sizeof hash || hash != hash_)
      throw Error(ErrorKind::badInput, path_,
                  "this checkpoint belongs to another sky, size or setting; delete it or name another file");
    try {
      tracer.restore(std::as_bytes(std::span(bytes).subspan(sizeof hash)));
    } catch (const Error& e) {
      throw Error(ErrorKind::badInput, path_, e.what());
    }
  }

  void save(const trace::PathTracer& tracer) const {
    if (path_.empty()) return;
    const std::vector<std::byte> state = tracer.state();
    std::string bytes(reinterpret_cast<const char*>(&hash_), sizeof hash_);
    bytes.append(reinterpret_cast<const char*>(state.data()), state.size());
    writeFileAtomically(path_, bytes);
  }

  void remove() const {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }

 private:
  std::string path_;
  std::uint64_t hash_ = 0;
};

void saveLayers(const std::string& output, const trace::TraceLayers& layers) {
  const std::string stem = output.substr(0, output.rfind('.'));
  const std::pair<const char*, const Image*> all[] = {
      {"direct", &layers.direct}, {"multiple", &layers.multiple}, {"transmittance", &layers.transmittance},
      {"depth", &layers.depth},   {"samples", &layers.samples},   {"variance", &layers.variance}};
  for (const auto& [name, image] : all) saveExr(fmt::format("{}.{}.exr", stem, name), *image, ExrPrecision::full);
}

}  // namespace

void addRendererOptions(CLI::App& command, Renderer& renderer, TraceOptions& options) {
  command
      .add_option_function<std::string>(
          "--renderer",
          [&renderer](const std::string& name) { renderer = name == "path" ? Renderer::path : Renderer::realtime; },
          "realtime (OpenGL) or path (path-traced, the reference)")
      ->check(CLI::IsMember({"realtime", "path"}))
      ->type_name("NAME");
  const CLI::Option* flags[] = {
      command.add_option("--samples", options.samples, "path: paths of a pixel; 64 unless something else decides")
          ->type_name("N")
          ->check(CLI::Range(1, 1 << 20)),
      command
          .add_option("--noise", options.noise,
                      "path: go on until the noise is this share of the way from black to white, e.g. 0.02")
          ->type_name("SHARE")
          ->check(CLI::Range(1e-4, 1.0)),
      command
          .add_option("--air", options.air,
                      "path: medium traces light through the air too; tables takes sky and aerial perspective from the "
                      "real-time tables: faster, biased")
          ->check(CLI::IsMember({"medium", "tables"}))
          ->type_name("NAME"),
      command
          .add_option("--scatterings", options.scatterings,
                      "path: end paths after so many scatterings by cloud, air and ground: biased, too dark")
          ->check(CLI::Range(1, 1000000))
          ->type_name("N"),
      command.add_flag("--denoise", options.denoise,
                       "path: smooth the finished picture where its variance explains the noise: for the eye, biased")};
  options.flags.insert(options.flags.end(), std::begin(flags), std::end(flags));
}

void addTimeLimit(CLI::App& command, TraceOptions& options) {
  options.flags.push_back(command.add_option("--seconds", options.seconds, "path: stop after this time")
                              ->type_name("S")
                              ->check(CLI::Range(0.1, 1e7)));
}

void addStillOptions(CLI::App& command, TraceOptions& options) {
  const CLI::Option* flags[] = {
      command
          .add_option("--checkpoint", options.checkpoint,
                      "path: keep the state in this file and go on from it when it is there")
          ->type_name("FILE"),
      command.add_option("--checkpoint-every", options.checkpointSeconds, "path: seconds between two checkpoints")
          ->type_name("S")
          ->check(CLI::Range(0.0, 1e6))
          ->capture_default_str(),
      command.add_flag("--layers", options.layers,
                       "path: direct, multiple, transmittance, depth, samples and variance beside the picture, as "
                       ".exr")};
  options.flags.insert(options.flags.end(), std::begin(flags), std::end(flags));
}

void requireUse(const TraceOptions& options, Renderer renderer) {
  if (renderer == Renderer::path) return;
  for (const CLI::Option* flag : options.flags)
    if (flag->count() > 0)
      throw UsageError(fmt::format("{} is for the path tracer: add --renderer path", flag->get_name()));
}

trace::TraceSettings traceSettings(const TraceOptions& options) {
  const bool open = options.noise > 0.0 || options.seconds > 0.0;
  return {.width = options.width,
          .height = options.height,
          .samples = options.samples > 0 ? options.samples : (open ? kMostSamples : kSamples),
          .noise = options.noise,
          .seconds = options.seconds,
          .air = options.air == "tables" ? trace::AirModel::tables : trace::AirModel::medium,
          .scatterings = options.scatterings,
          .checkpointSeconds = options.checkpointSeconds};
}

void traceToFile(const Scene& scene, const TraceOptions& options, const std::string& output) {
  const trace::TraceSettings settings = traceSettings(options);
  const InterruptGuard guard;
  const std::vector<Volume> maps = weatherMaps(scene);
  const std::vector<PlacedGrid> grids = loadGrids(scene);
  trace::PathTracer tracer(scene, {.weatherMaps = maps, .grids = grids}, settings);
  Checkpoint checkpoint(options.checkpoint, scene, maps, settings);
  checkpoint.restore(tracer);
  const bool complete =
      tracer.run([&](double done) { return !guard.asked() && (!options.progress || options.progress(done)); },
                 [&] { checkpoint.save(tracer); });
  if (!complete) checkpoint.save(tracer);
  const trace::TraceLayers layers = tracer.layers();
  Image picture = options.denoise ? trace::denoise(layers) : layers.radiance;
  picture.features = tracedFeaturesOf(scene);
  savePicture(output, picture, scene.film);
  if (options.layers) saveLayers(output, layers);
  if (complete) checkpoint.remove();
  const trace::KernelStatistics& s = tracer.statistics();
  if (s.overBound + s.notFinite > 0)
    fmt::print(stderr,
               "{} of {} samples exceeded their bound and {} of {} paths were not finite; please report this sky\n",
               s.overBound, s.lookups, s.notFinite, s.paths);
  if (!complete) fmt::print(stderr, "interrupted: the picture so far was written to {}\n", output);
}

}  // namespace welkin::app
