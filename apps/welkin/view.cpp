// welkin view: a window on a sky.
#include "apps/welkin/command.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#ifdef WELKIN_HAS_VIEWER
#include "apps/viewer/viewer.hpp"
#endif

namespace welkin::app {

namespace {

struct ViewArguments {
  SkyArguments sky;
  std::string size = "1280x720", script, screenshot;
  double uiScale = 0.0, scale = 0.0;
  bool headless = false;
};

#ifdef WELKIN_HAS_VIEWER
void view(const ViewArguments& arguments) {
  if (arguments.headless && arguments.script.empty())
    throw UsageError("--headless has no window to work with: give it a --script");
  if (!arguments.screenshot.empty() && arguments.script.empty())
    throw UsageError("--screenshot shows the end of a --script");
  const Size size = parseSize(arguments.size);
  viewer::ViewerOptions options;
  options.scene = arguments.sky.animated();
  options.skyName = arguments.sky.sky;
  if (arguments.sky.sky.find(".toml") != std::string::npos) options.file = arguments.sky.sky;
  options.width = size.width;
  options.height = size.height;
  options.uiScale = arguments.uiScale;
  options.scale = arguments.scale;
  options.headless = arguments.headless;
  options.script = arguments.script;
  options.screenshot = arguments.screenshot;
  for (const Preset& p : findPresets()) options.presets.push_back({p.name, p.genus, p.sentence, p.file});
  options.loadTextures = texturesOf;
  options.savePicture = [](const std::string& path, const Image& light, const Film& film) {
    requirePictureFile(path);
    savePicture(path, light, film);
  };
  viewer::runViewer(options);
}
#else
void view(const ViewArguments& /*arguments*/) {
  throw Error(ErrorKind::failed, "",
              "this welkin was built without a window: install SDL2 and Dear ImGui (Debian: apt-get install "
              "libsdl2-dev libimgui-dev), configure with -DWELKIN_VIEWER=ON and build again");
}
#endif

}  // namespace

void addView(CLI::App& app) {
  auto* command = app.add_subcommand("view", "a window on a sky: change it, fly through it, save it");
  auto arguments = std::make_shared<ViewArguments>();
  arguments->sky.addTo(*command, SkyArguments::Need::optional);
  arguments->sky.addPictureOptionsTo(*command);
  command->add_option("--size", arguments->size, "width and height of the window in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command->add_option("--ui-scale", arguments->uiScale, "size of the interface; by the screen if not given")
      ->type_name("X")
      ->check(CLI::Range(0.5, 4.0));
  command
      ->add_option("--scale", arguments->scale,
                   "resolution while something moves, as a share of the window's; chosen by itself if not given")
      ->type_name("X")
      ->check(CLI::Range(0.1, 1.0));
  command->add_option("--script", arguments->script, "plays a file of input, then ends; docs/viewer.md")
      ->type_name("FILE");
  command->add_option("--screenshot", arguments->screenshot, "a PNG of the window when the script has ended")
      ->type_name("FILE");
  command->add_flag("--headless", arguments->headless, "without window and display, for scripts");
  command->callback([arguments] { view(*arguments); });
}

}  // namespace welkin::app
