#include "apps/welkin/window.hpp"

#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"

namespace welkin::app {

void WindowArguments::addTo(CLI::App& command) {
  sky.addTo(command, SkyArguments::Need::optional);
  sky.addPictureOptionsTo(command);
  command.add_option("--size", size, "width and height of the window in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command.add_option("--ui-scale", uiScale, "size of the interface; by the screen if not given")
      ->type_name("X")
      ->check(CLI::Range(0.5, 4.0));
  command
      .add_option("--scale", scale,
                  "resolution while something moves, as a share of the window's; chosen by itself if not given")
      ->type_name("X")
      ->check(CLI::Range(0.1, 1.0));
  command
      .add_option("--rate", rate,
                  "frames a second to hold by quality while something moves; 0: quality stays, and the first picture "
                  "waits for all of its light; if not given 60, without a GPU 25, and 0 for scripts")
      ->type_name("FPS")
      ->check(CLI::Range(0.0, 1000.0));
  command.add_option("--script", script, "plays a file of input, then ends; docs/viewer.md")->type_name("FILE");
  command.add_option("--screenshot", screenshot, "a PNG of the window when the script has ended")->type_name("FILE");
  command.add_flag("--headless", headless, "without window and display, for scripts");
}

#ifdef WELKIN_HAS_VIEWER
viewer::ViewerOptions WindowArguments::options() const {
  if (headless && script.empty()) throw UsageError("--headless has no window to work with: give it a --script");
  if (!screenshot.empty() && script.empty()) throw UsageError("--screenshot shows the end of a --script");
  const Size pixels = parseSize(this->size);
  viewer::ViewerOptions options;
  options.scene = sky.animated();
  options.skyName = sky.sky;
  if (sky.sky.find(".toml") != std::string::npos) options.file = sky.sky;
  options.width = pixels.width;
  options.height = pixels.height;
  options.uiScale = uiScale;
  options.scale = scale;
  if (rate >= 0.0) options.rate = rate;
  options.headless = headless;
  options.script = script;
  options.screenshot = screenshot;
  for (const Preset& p : findPresets()) options.presets.push_back({p.name, p.genus, p.sentence, p.file});
  options.loadTextures = texturesOf;
  options.savePicture = [](const std::string& path, const Image& light, const Film& film) {
    requirePictureFile(path);
    savePicture(path, light, film);
  };
  return options;
}
#endif

void refuseWithoutWindow() {
  throw Error(ErrorKind::failed, "",
              "this welkin was built without a window: install SDL2 and Dear ImGui (Debian: apt-get install "
              "libsdl2-dev libimgui-dev), configure with -DWELKIN_VIEWER=ON and build again");
}

}  // namespace welkin::app
