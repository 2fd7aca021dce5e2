#pragma once
// The sky that is being looked at, the file that it came from, and the way back.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/viewer/model/weather_picture.hpp"
#include "welkin/scene/scene.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::viewer {

// Where a sky comes from: what the command line calls it, and the file that saving writes; empty for none.
struct Origin {
  std::string name, file;
};

// Every change of the sky is a step that can be undone. The camera that flies and the time that runs are no steps:
// undoing a colour must not throw the user across the sky.
class Document {
 public:
  explicit Document(Scene scene, Origin origin = {});

  const Scene& scene() const { return scene_; }
  // Sections of the scene, for reading by their fields' `get`. Valid until a list of the scene changes: not by set().
  std::vector<Section> sections() { return sectionsOf(scene_); }

  // Changes one parameter, "layer.0.weather" and "coverage". Returns what is wrong with the value, or
  // an empty text.
  std::string set(const std::string& section, std::string_view field, const FieldValue& value);

  // All changes in between are one step: a drag, a stroke of the brush.
  void beginGesture();
  void endGesture();

  // One step made of any change; `what` names it in the menu. A change of the camera is part of it.
  void edit(const std::string& what, const std::function<void(Scene&)>& change);
  // Puts the section's fields back to their defaults; a quality keeps its preset's values.
  void resetSection(const std::string& section);

  // The picture that a layer's weather.map names: as painted, or as its file was when it was read for this sky. Null
  // where the layer names none, or the file has not been kept.
  using WeatherPicturePointer = std::shared_ptr<const WeatherPicture>;
  WeatherPicturePointer weatherPicture(std::size_t layer) const;
  WeatherPicturePointer weatherPicture(const std::string& map) const;
  // What the file of a map holds; no step.
  void keepWeather(const std::string& map, WeatherPicturePointer picture);
  // Gives a layer another picture; part of a gesture or a step. Files stay as they are: the picture has a name of its
  // own until the sky is saved.
  void paintWeather(std::size_t layer, WeatherPicturePointer picture);
  // Whether the layer's picture is other than what the file of its name holds, if there is one.
  bool unsavedWeather(std::size_t layer) const;
  // Whether the map's file was read or written here.
  bool knowsFile(const std::string& map) const { return inFiles_.contains(map); }
  // A layer's picture has been written to a file, whose name the layers that show it take on; no step.
  void wroteWeather(std::size_t layer, const std::string& file);

  // No steps.
  void moveCamera(const Camera& camera) { scene_.camera = camera; }
  void moveTime(float seconds) { scene_.time = seconds; }

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  const std::string& undoName() const { return undo_.back().what; }
  const std::string& redoName() const { return redo_.back().what; }
  bool undo();
  bool redo();

  // Grows with every change but of camera and time, and when the sky is saved.
  int revision() const { return revision_; }

  // Another sky; one step.
  void open(Scene scene, Origin origin);
  const Origin& origin() const { return origin_; }
  void saved(const std::string& file);
  // What was opened or saved last.
  const Scene& savedScene() const { return saved_; }
  // Whether the sky differs from what was opened or saved last, camera and time apart.
  bool modified() const;

 private:
  using Pictures = std::map<std::string, WeatherPicturePointer>;  // by what weather.map says
  struct Step {
    std::string what;
    Scene before;
    Pictures pictures;
    Origin origin;
    bool camera = false;           // whether the step is about the camera too
    std::optional<Scene> saved{};  // of a step that opened another sky
  };
  void push(Step step);
  void exchange(Step& step);

  Scene scene_, saved_;
  Pictures pictures_, inFiles_;  // inFiles_: as they were read or written last
  int painted_ = 0;              // names given to unsaved pictures
  Origin origin_;
  std::vector<Step> undo_, redo_;
  bool gesture_ = false, inGesture_ = false;  // inGesture_: the last step belongs to the gesture
  int revision_ = 0;
};

}  // namespace welkin::viewer
