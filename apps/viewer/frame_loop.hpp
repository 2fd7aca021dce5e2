#pragma once
// The viewer as a whole: events in, panels, sky, picture out.
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "apps/viewer/flight_view/scenery.hpp"
#include "apps/viewer/map_view/ground.hpp"
#include "apps/viewer/model/script.hpp"
#include "apps/viewer/panels/workbench.hpp"
#include "apps/viewer/platform/platform.hpp"
#include "apps/viewer/viewer.hpp"
#include "welkin/gl/api.hpp"

namespace welkin::viewer {

// Name of the window that holds the panels.
inline constexpr const char* kSide = "##side";

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options);
  void run();

 private:
  void handle(const Event& event);
  void pressed(Key key);
  void perform(Action action, const std::string& argument);
  void move(double seconds);
  void dragView(const glm::vec2& by);
  void draw(double seconds);
  void drawPanels();
  void takeScene();
  void playKeyframes();
  const Scene& shown() const;
  bool takeTextures(const Scene& scene);
  void tendReference();
  void collectSlice();
  void expose(double seconds);
  void command(const ScriptStep& step);
  void openSky(const std::string& path, const Origin& origin);
  void savePicture(const std::string& path);
  void leave();
  void entitle();
  void drawTabs();
  void saveSky(const std::string& path);
  void bookmark(int number, bool keep);
  // Of a flight: flying.cpp.
  void beginFlight();
  bool flightKey(Key key);
  Hands hands() const;
  void fly(double seconds);
  void steer(const ScriptStep& step);
  void drawFlight();
  void keepFrame();
  void endFlight();
  // Of the map view: mapping.cpp.
  void useMap(MapPicture map);
  void showMap(bool shown);
  void openMap(const std::string& path);
  void dragMap(const glm::vec2& drag);
  void steerMap(Camera& camera, const Thrust& thrust, double seconds) const;
  bool atRest() const;
  int patience() const;
  Region region() const;
  float scaleFor(const Region& part) const;

  const ViewerOptions& options_;
  std::unique_ptr<Platform> platform_;
  Interface interface_;
  SkyPicture picture_;
  gl::Api gl_;
  Thumbnails thumbnails_;
  Reference reference_;
  realtime::CustomTextures textures_;
  Workbench bench_;
  std::optional<ScriptPlayer> script_;
  bool running_ = true, swallowText_ = false;
  int revision_ = -1;
  int lively_ = 3;              // frames to draw before resting
  std::optional<Scene> keyed_;  // the sky of the moment, where there are keyframes
  float takenTime_ = -1.0f;
  std::optional<Scene> drawn_;  // what the picture was made for, see lightOf()
  std::string gridsOf_, titled_;
  std::vector<std::string> mapsOf_;
  std::vector<Document::WeatherPicturePointer> picturesOf_;
  int titledRevision_ = -1;
  glm::vec2 pointer_{0.0f};
  std::optional<MouseButton> dragging_;
  double meteredEv_ = 0.0;
  bool metered_ = false, adapting_ = false;
  float panelWidth_ = 0.0f, governed_ = 0.0f;
  std::optional<Flight> flight_;
  std::unique_ptr<Scenery> scenery_;
  std::unique_ptr<MapGround> ground_;
  std::optional<Camera> beforeMap_;
  Gaze gaze_;
  std::array<float, kPadAxes> pad_{};
  double skyTime_ = 0.0, unflown_ = 0.0;  // s; frames of flight
  int kept_ = 0, scriptFrames_ = 0;       // frames written; of the script
};

}  // namespace welkin::viewer
