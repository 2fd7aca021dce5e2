// The sky of the document: from and to files, into the picture, and beside its reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/viewer/frame_loop.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/animation.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::viewer {

namespace {

// The scene without what changes nothing in the light of its picture.
Scene lightOf(Scene scene) {
  scene.title.clear();
  scene.film = Film{};
  scene.camera = Camera{};
  scene.time = 0.0f;
  return scene;
}

// What the volumes depend on that a scene names.
std::string gridsOf(const Scene& scene) {
  std::string files;
  for (const GridCloud& grid : scene.grids)
    for (const Field& f : fieldsOf<GridCloud>()) files += formatValue(f, f.get(&grid)) + "|";
  return files;
}

// Where the weather that was painted for a layer of a sky goes: beside the sky's file, under the first number that
// nobody else's picture has.
std::string weatherFileOf(const std::string& sky, const Document& document, std::size_t layer) {
  const std::filesystem::path path(sky);
  std::string stem = path.filename().string();
  for (const std::string_view ending : {".toml", ".sky"})
    if (stem.ends_with(ending)) stem.resize(stem.size() - ending.size());
  const std::vector<Layer>& layers = document.scene().layers;
  for (std::size_t number = layer;; ++number) {
    std::string file = (path.parent_path() / fmt::format("{}.weather{}.png", stem, number)).string();
    const bool shown = std::any_of(layers.begin(), layers.end(), [&](const Layer& l) {
      return l.weather.map == file && !document.unsavedWeather(static_cast<std::size_t>(&l - layers.data()));
    });
    std::error_code none;
    if (!shown && (document.knowsFile(file) || !std::filesystem::exists(file, none))) return file;
  }
}

}  // namespace

void Viewer::openSky(const std::string& path, const Origin& origin) {
  try {
    Scene scene = loadSky(path);
    options_.loadTextures(scene);  // before anything is given up for it
    if (bench_.keepCamera || bench_.mapShown) scene.camera = bench_.document.scene().camera;
    bench_.document.open(std::move(scene), origin);
    takeScene();
    picture_.cut();
    bench_.navigation.stop();
    bench_.refusals.clear();
    bench_.say("Opened " + path);
  } catch (const Error& e) {
    bench_.complain(e.what());
  }
}

void Viewer::saveSky(const std::string& path) {
  if (path.empty()) return bench_.complain("This sky has no file yet: save it under a name.");
  try {
    Document& document = bench_.document;
    for (std::size_t i = 0; i < document.scene().layers.size(); ++i) {
      if (!document.unsavedWeather(i)) continue;
      const std::string file = weatherFileOf(path, document, i);
      const WeatherPicture& picture = *document.weatherPicture(i);
      savePng16(file, picture.width(), picture.height(), WeatherPicture::kChannels, picture.samples());
      document.wroteWeather(i, file);
    }
    welkin::saveSky(document.scene(), path);
    document.saved(path);
    bench_.say("Saved " + path);
  } catch (const Error& e) {
    bench_.complain(e.what());
  }
}

void Viewer::savePicture(const std::string& path) {
  try {
    options_.savePicture(path, picture_.read(), bench_.film);
    bench_.say("Saved " + path);
  } catch (const std::exception& e) {
    bench_.complain(e.what());
  }
}

// Unsaved changes are asked about, but not by a script.
void Viewer::leave() {
  if (script_ && script_->playsRandomly()) return;
  if (script_ || !bench_.document.modified())
    running_ = false;
  else
    bench_.panels = bench_.askBeforeLeaving = true;
}

void Viewer::entitle() {
  if (titledRevision_ == bench_.document.revision() && titled_ == bench_.document.origin().name) return;
  titledRevision_ = bench_.document.revision();
  titled_ = bench_.document.origin().name;
  const std::string name = titled_.empty() ? "default" : std::filesystem::path(titled_).filename().string();
  platform_->setTitle(fmt::format("{}{} – Welkin", bench_.document.modified() ? "*" : "", name));
}

// Reads the files that the scene names anew, and takes over what has been painted. Returns whether anything has
// changed.
bool Viewer::takeTextures(const Scene& scene) {
  Document& document = bench_.document;
  const std::size_t layers = scene.layers.size();
  std::vector<std::string> maps(layers);
  std::vector<Document::WeatherPicturePointer> pictures(layers);
  Scene files = scene;  // what has to be read
  for (std::size_t i = 0; i < layers; ++i) {
    maps[i] = scene.layers[i].weather.map;
    pictures[i] = document.weatherPicture(maps[i]);
    if (pictures[i]) files.layers[i].weather.map.clear();
  }
  std::string grids = gridsOf(scene);
  const bool sameGrids = grids == gridsOf_;
  if (sameGrids && maps == mapsOf_ && pictures == picturesOf_) return false;
  if (sameGrids) files.grids.clear();
  realtime::CustomTextures textures = options_.loadTextures(files);
  if (sameGrids) textures.grids = std::move(textures_.grids);
  const bool any = std::any_of(maps.begin(), maps.end(), [](const std::string& map) { return !map.empty(); });
  textures.weatherMaps.resize(any ? layers : 0);
  for (std::size_t i = 0; any && i < layers; ++i) {
    Volume& map = textures.weatherMaps[i];
    if (pictures[i])
      map = pictures[i]->volume();
    else if (!map.texels.empty() && std::max(map.width, map.height) <= WeatherPicture::kLargest)
      document.keepWeather(maps[i], pictures[i] = std::make_shared<WeatherPicture>(map));
  }
  textures_ = std::move(textures);
  gridsOf_ = std::move(grids);
  mapsOf_ = std::move(maps);
  picturesOf_ = std::move(pictures);
  ++bench_.texturesNumber;
  return true;
}

// The sky of the moment: what keyframes set has its value. Camera, film and time of the document count.
const Scene& Viewer::shown() const { return keyed_ ? *keyed_ : bench_.document.scene(); }

// An aircraft flies in the sky as it stands.
void Viewer::playKeyframes() {
  Document& document = bench_.document;
  const Scene& scene = document.scene();
  if (scene.keyframes.empty() || flight_) {
    keyed_.reset();
    return;
  }
  keyed_ = sceneAt(scene, static_cast<double>(scene.time));
  const bool moved = takenTime_ != scene.time;
  takenTime_ = scene.time;
  if (moved && !bench_.mapShown && bench_.cameraByKeyframes && hasKeyframes(scene, "camera."))
    document.moveCamera(keyed_->camera);
}

void Viewer::takeScene() {
  const Scene& own = bench_.document.scene();
  if (bench_.document.revision() == revision_ && (own.keyframes.empty() || own.time == takenTime_)) return;
  revision_ = bench_.document.revision();
  try {
    playKeyframes();
  } catch (const Error& e) {
    bench_.complain(e.what());
  }
  const Scene& scene = shown();
  Scene light = lightOf(scene);
  try {
    if (!takeTextures(scene) && drawn_ && sameScene(light, *drawn_)) return;
    picture_.setScene(scene, textures_);
    if (flight_) {
      flight_->setScene(scene, textures_.weatherMaps, textures_.grids);
      scenery_->setScene(scene);
    }
    if (ground_) ground_->setSurroundings(scene.ground.albedo);
    drawn_ = std::move(light);
  } catch (const Error& e) {
    bench_.complain(e.what());
    // There must be something to draw from the first frame on.
    if (!drawn_) {
      picture_.setScene(Scene{}, {});
      drawn_ = lightOf(Scene{});
    }
  }
}

// Starts the path tracer when the picture rests, and stops it when it no longer shows the same.
void Viewer::tendReference() {
  const bool rests = atRest();
  if (reference_.running() && (!rests || !bench_.referenceWanted)) reference_.stop();
  if (!reference_.running() && rests && bench_.referenceWanted) {
    Scene scene = shown();
    scene.camera = bench_.document.scene().camera;
    scene.film = bench_.film;
    scene.film.exposure = ExposureMode::manual;
    reference_.start(scene, textures_, picture_.read());
  }
  if (reference_.collect(gl_)) lively_ = 3;
}

// Automatic exposure follows the picture as an eye does, within a second.
void Viewer::expose(double seconds) {
  bench_.film = shown().film;
  if (bench_.film.exposure != ExposureMode::automatic) {
    metered_ = adapting_ = false;
    return;
  }
  const double now = automaticEv(picture_.meter());
  meteredEv_ = metered_ ? meteredEv_ + (now - meteredEv_) * (1.0 - std::exp(-4.0 * seconds)) : now;
  metered_ = true;
  adapting_ = std::abs(now - meteredEv_) > 0.01;
  bench_.film.ev = static_cast<float>(meteredEv_);
}

}  // namespace welkin::viewer
