// The sky of the document: from and to files, into the picture, and beside its reference.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "apps/viewer/frame_loop.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/sky_file.hpp"
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

// What the files depend on that a scene names.
std::string filesOf(const Scene& scene) {
  std::string files;
  for (const Layer& layer : scene.layers)
    files += fmt::format("{}|{}|{}|", layer.weather.map, layer.weather.precipitation, layer.weather.type);
  for (const GridCloud& grid : scene.grids)
    for (const Field& f : fieldsOf<GridCloud>()) files += formatValue(f, f.get(&grid)) + "|";
  return files;
}

}  // namespace

void Viewer::openSky(const std::string& path, const Origin& origin) {
  try {
    Scene scene = loadSky(path);
    realtime::CustomTextures textures = options_.loadTextures(scene);  // before anything is given up for it
    if (bench_.keepCamera) scene.camera = bench_.document.scene().camera;
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
    writeFileAtomically(path, writeSky(bench_.document.scene()));
    bench_.document.saved(path);
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

void Viewer::takeScene() {
  if (bench_.document.revision() == revision_) return;
  revision_ = bench_.document.revision();
  const Scene& scene = bench_.document.scene();
  Scene light = lightOf(scene);
  if (drawn_ && sameScene(light, *drawn_)) return;
  try {
    const std::string files = filesOf(scene);
    if (files != texturesOf_) textures_ = options_.loadTextures(scene);
    texturesOf_ = files;
    picture_.setScene(scene, textures_);
    if (flight_) {
      flight_->setScene(scene, textures_.weatherMaps, textures_.grids);
      scenery_->setScene(scene);
    }
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
    Scene scene = bench_.document.scene();
    scene.film = bench_.film;
    scene.film.exposure = ExposureMode::manual;
    reference_.start(scene, textures_, picture_.read());
  }
  if (reference_.collect(gl_)) lively_ = 3;
}

// Automatic exposure follows the picture as an eye does, within a second.
void Viewer::expose(double seconds) {
  bench_.film = bench_.document.scene().film;
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
