#include "apps/viewer/model/document.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace welkin::viewer {

namespace {

constexpr std::size_t kMostSteps = 500;

}  // namespace

Document::Document(Scene scene, Origin origin) : scene_(std::move(scene)), saved_(scene_), origin_(std::move(origin)) {}

void Document::push(Step step) {
  ++revision_;
  redo_.clear();
  if (inGesture_) {
    undo_.back().camera |= step.camera;
    return;
  }
  if (undo_.size() >= kMostSteps) undo_.erase(undo_.begin());
  undo_.push_back(std::move(step));
  inGesture_ = gesture_;
}

void Document::beginGesture() {
  gesture_ = true;
  inGesture_ = false;
}

void Document::endGesture() { gesture_ = inGesture_ = false; }

std::string Document::set(const std::string& section, std::string_view field, const FieldValue& value) {
  for (const Section& s : sections()) {
    if (s.path != section) continue;
    const Field* f = findField(s, field);
    if (!f) break;
    Scene before = scene_;
    if (std::string wrong = assign(scene_, s, *f, value); !wrong.empty()) return wrong;
    if (sameScene(before, scene_)) return "";
    std::string name = section;
    if (!name.empty()) name += '.';
    push({name.append(field), std::move(before), pictures_, origin_, section == "camera"});
    return "";
  }
  return "is not a parameter of this sky";
}

void Document::edit(const std::string& what, const std::function<void(Scene&)>& change) {
  Scene before = scene_;
  change(scene_);
  if (sameScene(before, scene_)) return;
  const bool camera = !sameFields(before.camera, scene_.camera);
  push({what, std::move(before), pictures_, origin_, camera});
}

void Document::resetSection(const std::string& section) {
  edit("reset " + (section.empty() ? std::string("sky") : section), [&](Scene& scene) {
    if (section == "quality") {
      scene.quality = qualityPreset(scene.quality.preset);
      return;
    }
    for (const Section& s : sectionsOf(scene))
      if (s.path == section)
        for (const Field& f : s.fields) f.set(s.object, f.defaultValue);
  });
}

// The step's scene is put back; the present one takes its place in the step.
void Document::exchange(Step& step) {
  const Camera camera = scene_.camera;
  const float time = scene_.time;
  std::swap(scene_, step.before);
  std::swap(pictures_, step.pictures);
  std::swap(origin_, step.origin);
  if (step.saved) std::swap(saved_, *step.saved);
  if (!step.camera) {
    scene_.camera = camera;
    scene_.time = time;
  }
  inGesture_ = false;
  ++revision_;
}

bool Document::undo() {
  if (undo_.empty()) return false;
  redo_.push_back(std::move(undo_.back()));
  undo_.pop_back();
  exchange(redo_.back());
  return true;
}

bool Document::redo() {
  if (redo_.empty()) return false;
  undo_.push_back(std::move(redo_.back()));
  redo_.pop_back();
  exchange(undo_.back());
  return true;
}

void Document::open(Scene scene, Origin origin) {
  endGesture();
  const std::string name = !origin.name.empty() ? origin.name : scene.title;
  push({"open " + name, scene_, pictures_, origin_, true, saved_});
  pictures_.clear();
  scene_ = std::move(scene);
  saved_ = scene_;
  origin_ = std::move(origin);
}

void Document::saved(const std::string& file) {
  saved_ = scene_;
  origin_ = {file, file};
  ++revision_;
}

Document::WeatherPicturePointer Document::weatherPicture(std::size_t layer) const {
  return layer < scene_.layers.size() ? weatherPicture(scene_.layers[layer].weather.map) : nullptr;
}

Document::WeatherPicturePointer Document::weatherPicture(const std::string& map) const {
  const auto found = pictures_.find(map);
  return found == pictures_.end() ? nullptr : found->second;
}

void Document::keepWeather(const std::string& map, WeatherPicturePointer picture) {
  pictures_[map] = inFiles_[map] = std::move(picture);
}

void Document::paintWeather(std::size_t layer, WeatherPicturePointer picture) {
  std::string& map = scene_.layers[layer].weather.map;
  Step step{fmt::format("paint weather {}", layer), scene_, pictures_, origin_};
  if (map.empty() || knowsFile(map) || !pictures_.contains(map)) map = fmt::format("(painted {})", ++painted_);
  pictures_[map] = std::move(picture);
  push(std::move(step));
}

bool Document::unsavedWeather(std::size_t layer) const {
  const WeatherPicturePointer picture = weatherPicture(layer);
  if (!picture) return false;
  const auto file = inFiles_.find(scene_.layers[layer].weather.map);
  return file == inFiles_.end() || file->second != picture;
}

void Document::wroteWeather(std::size_t layer, const std::string& file) {
  const WeatherPicturePointer picture = weatherPicture(layer);
  const std::string map = scene_.layers[layer].weather.map;
  for (Layer& l : scene_.layers)
    if (l.weather.map == map) l.weather.map = file;
  keepWeather(file, picture);
  ++revision_;
}

bool Document::modified() const {
  for (std::size_t i = 0; i < scene_.layers.size(); ++i)
    if (unsavedWeather(i)) return true;
  Scene now = scene_;
  now.camera = saved_.camera;
  now.time = saved_.time;
  return !sameScene(now, saved_);
}

}  // namespace welkin::viewer
