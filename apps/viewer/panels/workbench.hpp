#pragma once
// What the panels share.
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "apps/viewer/model/actions.hpp"
#include "apps/viewer/model/document.hpp"
#include "apps/viewer/model/navigation.hpp"
#include "apps/viewer/model/weather_view.hpp"
#include "apps/viewer/picture/density_slice.hpp"
#include "apps/viewer/picture/panel_image.hpp"
#include "apps/viewer/picture/reference.hpp"
#include "apps/viewer/picture/sky_picture.hpp"
#include "apps/viewer/picture/thumbnails.hpp"
#include "apps/viewer/ui/interface.hpp"
#include "apps/viewer/viewer.hpp"

namespace welkin::viewer {

// How the frame loop is doing.
struct Pace {
  static constexpr std::size_t kKept = 120;
  double frameMs = 0.0;              // smoothed, of frames that drew the sky
  std::array<float, kKept> times{};  // of the last ones, ms; the oldest at `next`
  std::size_t next = 0;
  // While something moves: share of the window's resolution, 0 to choose it; frames a second to be held, 0 for none.
  float scale = 0.0f, wantedRate = 0.0f;
  realtime::FrameCost cost{};  // of the last frame, while its panel is shown
};

// Panels beside the picture, one at a time.
enum class Tab { gallery, parameters, sun, wind, weather, camera, film, pace, inspect, reference };

// The weather map and the brush over it.
struct WeatherDesk {
  explicit WeatherDesk(const gl::Api& gl) : image(gl) {}
  std::size_t layer = 0;
  WeatherView view{};
  Brush brush{};
  std::optional<Stroke> stroke{};  // while the brush is down
  PanelImage image;
  std::string imageOf{};  // what it was made for
};

// A slice of a noise texture.
struct NoiseDesk {
  explicit NoiseDesk(const gl::Api& api) : gl(api), image(api) {}
  const gl::Api& gl;
  int texture = 0, channel = 0;
  float depth = 0.0f;  // share of the volume
  Volume volume{};     // of texture `made`, by `madeWith`
  int made = -1, shown = -1;
  NoiseSettings madeWith{};
  PanelImage image;
};

// A cut through the clouds.
struct SliceDesk {
  explicit SliceDesk(const gl::Api& gl) : image(gl) {}
  SlicePlane plane{};
  DensitySlice slice{};
  PanelImage image;
  std::string askedFor{};
};

struct FileDialog {
  std::optional<Action> wanted{};  // to be opened
  std::filesystem::path folder{};
  std::string name{};
};

struct Workbench {
  const ViewerOptions& options;
  Document document;
  Navigation navigation{};
  Bookmarks bookmarks{};
  SkyPicture& picture;
  Thumbnails& thumbnails;
  Reference& reference;
  Interface& interface;
  const realtime::CustomTextures& textures;  // of the sky as it is drawn
  int texturesNumber = 0;                    // grows when they change
  WeatherDesk weather;
  NoiseDesk noise;
  SliceDesk slice;
  Pace pace{};

  // Time.
  bool playing = false;
  float timeRate = 1.0f;  // seconds of the sky to a second
  bool cameraByKeyframes = true;

  // The reference.
  bool referenceWanted = false;
  Comparison comparison = Comparison::wipe;
  float wipe = 0.5f;  // share of the picture, from the left, that is the real-time one

  bool mapShown = false;

  // Window.
  bool panels = true, simple = true, keepCamera = false, countSamples = false, showSamples = false;
  float mostSamples = 128.0f;      // red in the picture of samples
  std::optional<Tab> wantedTab{};  // to be shown from the next frame on
  Tab tab = Tab::parameters;
  FileDialog files{};
  bool askBeforeLeaving = false;
  Film film{};  // of the scene, with the exposure that the meter has chosen
  std::string search{};
  bool focusSearch = false, helpShown = false;
  std::string message{};  // in the status bar
  bool messageIsError = false;
  std::map<std::string, std::string> refusals{};  // by parameter: why its last value was not taken

  std::function<void(Action, const std::string& argument)> perform{};
  std::function<void(const PresetFile& preset)> openPreset{};
  std::function<void(int bookmark)> goTo{}, keep{};
  std::function<void()> leave{};

  void say(const std::string& text) {
    message = text;
    messageIsError = false;
  }
  void complain(const std::string& text) {
    message = text;
    messageIsError = true;
  }
};

}  // namespace welkin::viewer
