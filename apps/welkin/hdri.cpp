// welkin hdri: a sky as a picture of all directions.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "apps/welkin/command.hpp"
#include "apps/welkin/environment_file.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin::app {

namespace {

constexpr std::array<const char*, 5> kTargets{"none", "blender", "usd", "three", "unreal"};
constexpr double kLargestHalf = 65504.0, kLargestFloat = 1e38;

struct HdriArguments {
  SkyArguments sky;
  std::string output, format, faces, target = "none", sun = "full";
  Renderer renderer = Renderer::realtime;
  TraceOptions trace;
  std::optional<double> centerHeading;
  int size = 4096, frames = 0;
  bool noClouds = false, quiet = false;
};

// The name's ending says the format, or --format does, and they must agree.
void requireFormat(const HdriArguments& arguments) {
  const std::string& path = arguments.output;
  if (!path.ends_with(".exr") && !path.ends_with(".hdr"))
    throw UsageError(fmt::format("'{}': the picture's name ends in .exr or .hdr", path));
  if (!arguments.format.empty() && !path.ends_with("." + arguments.format))
    throw UsageError(fmt::format("--format {}: '{}' has another ending", arguments.format, path));
}

SunTreatment parseSun(const std::string& text, bool hdr) {
  const double most = hdr ? kLargestFloat : kLargestHalf;
  if (text == "full") return {.style = SunStyle::full, .most = kLargestFloat};
  if (text == "soft") return {.style = SunStyle::soft, .most = most};
  if (text == "none") return {.style = SunStyle::none, .most = most};
  constexpr std::string_view kClamp = "clamp=";
  double value = 0.0;
  if (text.starts_with(kClamp)) {
    const char* end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data() + kClamp.size(), end, value);
    if (error == std::errc() && after == end && std::isfinite(value) && value > 0.0)
      return {.style = SunStyle::clamp, .clamp = value, .most = most};
  }
  throw UsageError(fmt::format("--sun {}: write full, soft, none or clamp=V, with V in kcd/m^2", text));
}

void hdri(const HdriArguments& arguments) {
  requireFormat(arguments);
  requireUse(arguments.trace, arguments.renderer);
  Scene scene = arguments.sky.scene();
  if (arguments.noClouds) {
    scene.layers.clear();
    scene.sheets.clear();
    scene.grids.clear();
    scene.heroes.clear();
  }
  EnvironmentOptions options{.size = arguments.size, .frames = arguments.frames};
  options.sun = parseSun(arguments.sun, arguments.output.ends_with(".hdr"));
  if (arguments.faces == "cube") options.layout = EnvironmentLayout::cube;
  for (std::size_t i = 0; i < kTargets.size(); ++i)
    if (arguments.target == kTargets[i]) options.target = static_cast<EnvironmentTarget>(i);
  options.centerHeading =
      arguments.centerHeading ? *arguments.centerHeading * std::numbers::pi / 180.0 : centerHeadingOf(options.target);
  requireWritable(arguments.output);
  ProgressDisplay display("rendering", arguments.quiet ? ProgressStyle::quiet : ProgressStyle::automatic);
  options.progress = display.callback();
  saveEnvironment(arguments.output,
                  arguments.renderer == Renderer::path ? traceEnvironment(scene, options, arguments.trace)
                                                       : renderEnvironment(scene, options),
                  scene, options);
}

}  // namespace

void addHdri(CLI::App& app) {
  auto* command = app.add_subcommand("hdri", "a sky as a picture of all directions, for lighting other scenes");
  auto arguments = std::make_shared<HdriArguments>();
  HdriArguments& a = *arguments;
  a.sky.addTo(*command, SkyArguments::Need::optional);
  command
      ->add_option("-o,--output", a.output,
                   "the picture, .exr or .hdr, in kcd/m^2; FILE.json beside it holds the light that it has lost")
      ->type_name("FILE")
      ->required();
  command->add_option("--size", a.size, "width; the height is half of it, a face of a cube a quarter")
      ->type_name("N")
      ->check([](const std::string& text) {
        int size = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
        const bool right = error == std::errc() && end == text.data() + text.size() && size >= 16 && size <= 16384;
        return right && size % 4 == 0 ? std::string() : std::string("must be a multiple of 4 from 16 to 16384");
      })
      ->capture_default_str();
  command->add_option("--format", a.format, "exr or hdr; the file's name says it as well")
      ->check(CLI::IsMember({"exr", "hdr"}));
  command
      ->add_option("--faces", a.faces, "cube: six squares from top to bottom, +X -X +Y -Y +Z -Z, as OpenEXR has them")
      ->check(CLI::IsMember({"cube"}));
  command
      ->add_option("--target", a.target,
                   "the program that it is for: blender, usd, three or unreal; sets the heading "
                   "of the centre")
      ->check(CLI::IsMember(kTargets));
  command->add_option("--center-heading", a.centerHeading, "compass heading of the picture's centre, 0 north, 90 east")
      ->type_name("DEG")
      ->check(CLI::Range(-360.0, 360.0));
  command
      ->add_option("--sun", a.sun,
                   "full: as it is (.exr in 32 bits). soft: wider, of the same energy, fits 16 bits. "
                   "clamp=V: nothing brighter than V kcd/m^2. none: without it")
      ->type_name("STYLE")
      ->capture_default_str();
  command->add_flag("--no-clouds", a.noClouds, "the clear sky alone");
  addRendererOptions(*command, a.renderer, a.trace);
  command->add_option("--quality", a.sky.quality, "low, medium, high or ultra")->type_name("NAME");
  command->add_option("--frames", a.frames, "marches a pixel; 0 takes four")
      ->type_name("N")
      ->check(CLI::Range(0, 10000));
  command->add_flag("-q,--quiet", a.quiet, "no progress");
  command->callback([arguments] { hdri(*arguments); });
}

}  // namespace welkin::app
