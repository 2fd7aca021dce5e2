// welkin view: a window on a sky.
#include "apps/welkin/map_file.hpp"
#include "apps/welkin/window.hpp"

namespace welkin::app {

namespace {

struct ViewArguments {
  WindowArguments window;
  std::string map, corners;
};

#ifdef WELKIN_HAS_VIEWER
void view(const ViewArguments& arguments) {
  if (arguments.map.empty() && !arguments.corners.empty()) throw UsageError("--map-corners are those of a --map");
  viewer::ViewerOptions options = arguments.window.options();
  options.showMap = !arguments.map.empty();
  if (options.showMap && arguments.map != "land") options.map = loadMap(arguments.map, arguments.corners);
  options.loadMap = [](const std::string& path) { return loadMap(path, ""); };
  viewer::runViewer(options);
}
#else
void view(const ViewArguments& /*arguments*/) { refuseWithoutWindow(); }
#endif

}  // namespace

void addView(CLI::App& app) {
  auto* command = app.add_subcommand("view", "a window on a sky: change it, fly through it, save it");
  auto arguments = std::make_shared<ViewArguments>();
  arguments->window.addTo(*command);
  command
      ->add_option("--map", arguments->map,
                   "seen from above over a picture of land: a GeoTIFF, a PNG with --map-corners, or land, the land of "
                   "welkin fly")
      ->type_name("PICTURE");
  command->add_option("--map-corners", arguments->corners, "where the picture's land lies, m from the sky's origin")
      ->type_name("W,S,E,N");
  command->callback([arguments] { view(*arguments); });
}

}  // namespace welkin::app
