#pragma once
// `welkin view`, a window on a sky, and `welkin fly`, an aircraft in it. The command hands in what it knows and the
// viewer does not: presets, files.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/flight/flight.hpp"
#include "apps/viewer/model/map_picture.hpp"
#include "welkin/base/image.hpp"
#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

struct PresetFile {
  std::string name, genus, sentence, file;
};

// An aircraft in place of the free camera.
struct FlyOptions {
  FlightStart start = FlightStart::runway;
  std::string record;  // a script of what was flown, written at the end; empty for none
  std::string frames;  // a folder for the frames of a script as PNG; empty for none
  int every = 1;       // frame of a script that is drawn
};

struct ViewerOptions {
  Scene scene;
  std::string file;     // of the scene; empty for none
  std::string skyName;  // how the command line names the sky: a preset, a file, or empty for the default
  int width = 1280, height = 720;
  double uiScale = 0.0;        // 0: by the screen
  double scale = 0.0;          // of the resolution while something moves; 0: chosen by itself
  std::optional<double> rate;  // frames a second to hold by quality, 0: none; chosen by itself if not given
  bool headless = false;
  std::string script;      // a file of input; empty for none
  std::string screenshot;  // a PNG of the window at the script's end, or of the first picture at rest; empty for none
  std::optional<FlyOptions> fly{};
  bool showMap = false;             // from above at first
  std::optional<MapPicture> map{};  // none: a map of our own land
  // The map in a file. Throws Error.
  std::function<MapPicture(const std::string& path)> loadMap;
  std::vector<PresetFile> presets;
  // Pictures and volumes that a scene names. Throws Error (badInput).
  std::function<realtime::CustomTextures(const Scene&)> loadTextures;
  // Writes light as .png or .exr.
  std::function<void(const std::string& path, const Image& light, const Film& film)> savePicture;
};

// Shows the window until it is closed or the script ends. Throws Error.
void runViewer(const ViewerOptions& options);

}  // namespace welkin::viewer
