// welkin render: a picture of a sky.
#include <fmt/format.h>

#include "apps/welkin/command.hpp"
#include "apps/welkin/picture.hpp"
#include "apps/welkin/traced.hpp"

namespace welkin::app {

namespace {

struct RenderArguments {
  SkyArguments sky;
  std::string output, size = "1280x720";
  int frames = 0;
  bool quiet = false;
  Renderer renderer = Renderer::realtime;
  TraceOptions trace;
};

void render(const RenderArguments& arguments) {
  const Size size = parseSize(arguments.size);
  requireUse(arguments.trace, arguments.renderer);
  if (arguments.renderer == Renderer::path && arguments.frames > 0)
    throw UsageError("--frames is for the real-time renderer: leave it out, or --renderer path");
  const Scene scene = arguments.sky.scene();
  requirePictureFile(arguments.output);
  ProgressDisplay display("rendering", arguments.quiet ? ProgressStyle::quiet : ProgressStyle::automatic);
  if (arguments.renderer == Renderer::path) {
    TraceOptions options = arguments.trace;
    options.width = size.width;
    options.height = size.height;
    options.progress = display.callback();
    return traceToFile(scene, options, arguments.output);
  }
  const Image light = renderSky(
      scene, {.width = size.width, .height = size.height, .frames = arguments.frames, .progress = display.callback()});
  savePicture(arguments.output, light, scene.film);
}

}  // namespace

void addRender(CLI::App& app) {
  auto* command = app.add_subcommand("render", "a picture of a sky, in real time or path-traced");
  auto arguments = std::make_shared<RenderArguments>();
  arguments->sky.addTo(*command, SkyArguments::Need::optional);
  command
      ->add_option("-o,--output", arguments->output, "the picture: .png (8 bit, tone-mapped) or .exr (linear kcd/m^2)")
      ->type_name("FILE")
      ->required();
  command->add_option("--size", arguments->size, "width and height in pixels")->type_name("WxH")->capture_default_str();
  command
      ->add_option("--frames", arguments->frames, "temporal frames that make the picture; 0 takes four marches a pixel")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
  arguments->sky.addPictureOptionsTo(*command);
  addRendererOptions(*command, arguments->renderer, arguments->trace);
  addTimeLimit(*command, arguments->trace);
  addStillOptions(*command, arguments->trace);
  command->add_flag("-q,--quiet", arguments->quiet, "no progress");
  command->callback([arguments] { render(*arguments); });
}

}  // namespace welkin::app
