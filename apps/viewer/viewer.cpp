// The frame loop: events in, panels, sky, picture out.
#include "apps/viewer/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/viewer/model/command_line.hpp"
#include "apps/viewer/model/script.hpp"
#include "apps/viewer/panels/panels.hpp"
#include "apps/viewer/picture/screenshot.hpp"
#include "apps/viewer/platform/platform.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kScriptFrame = 1.0 / 60.0;  // s: scripts count frames
constexpr std::size_t kLongestScript = 1 << 20, kLongestSky = 1 << 20;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr const char* kSide = "##side";

struct TabInfo {
  Tab tab;
  Action action;
  const char* title;
  void (*draw)(Workbench& bench);
};
constexpr TabInfo kTabs[] = {{Tab::gallery, Action::gallery, "Gallery", drawGallery},
                             {Tab::parameters, Action::parameters, "Sky", drawParameters},
                             {Tab::sun, Action::sun, "Sun", drawSun},
                             {Tab::wind, Action::wind, "Wind", drawWind},
                             {Tab::camera, Action::camera, "Camera", drawCamera},
                             {Tab::film, Action::film, "Film", drawFilm},
                             {Tab::pace, Action::pace, "Pace", drawPace},
                             {Tab::reference, Action::reference, "Trace", drawReference}};

std::optional<Tab> tabOf(Action action) {
  for (const TabInfo& info : kTabs)
    if (info.action == action) return info.tab;
  return std::nullopt;
}

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
  void tendReference();
  void expose(double seconds);
  void command(const ScriptStep& step);
  void openSky(const std::string& path, const Origin& origin);
  void savePicture(const std::string& path);
  void leave();
  void entitle();
  void drawTabs();
  void saveSky(const std::string& path);
  void bookmark(int number, bool keep);
  bool atRest() const;
  int patience() const;
  Region region() const;

  const ViewerOptions& options_;
  std::unique_ptr<Platform> platform_;
  Interface interface_;
  SkyPicture picture_;
  gl::Api gl_;
  Thumbnails thumbnails_;
  Reference reference_;
  Workbench bench_;
  std::optional<ScriptPlayer> script_;
  bool running_ = true, swallowText_ = false;
  int revision_ = -1;
  int lively_ = 3;              // frames to draw before resting
  std::optional<Scene> drawn_;  // what the picture was made for, see lightOf()
  std::string texturesOf_, titled_;
  int titledRevision_ = -1;
  realtime::CustomTextures textures_;
  glm::vec2 pointer_{0.0f};
  std::optional<MouseButton> dragging_;
  double meteredEv_ = 0.0;
  bool metered_ = false, adapting_ = false;
  float panelWidth_ = 0.0f;
};

std::unique_ptr<Platform> openPlatform(const ViewerOptions& options) {
  const WindowOptions window{.width = options.width, .height = options.height};
  return options.headless ? openHeadless(window) : openWindow(window);
}

std::vector<std::string> filesOf(const std::vector<PresetFile>& presets) {
  std::vector<std::string> files;
  for (const PresetFile& p : presets) files.push_back(p.file);
  return files;
}

Viewer::Viewer(const ViewerOptions& options)
    : options_(options), platform_(openPlatform(options)), interface_(*platform_), picture_(platform_->loader()),
      gl_(gl::loadApi(platform_->loader())),
      thumbnails_(filesOf(options.presets), options.loadTextures), bench_{.options = options,
                                                                          .document =
                                                                              Document(options.scene,
                                                                                       {options.skyName, options.file}),
                                                                          .picture = picture_,
                                                                          .thumbnails = thumbnails_,
                                                                          .reference = reference_,
                                                                          .interface = interface_} {
  if (options.uiScale > 0.0) interface_.setScale(static_cast<float>(options.uiScale));
  if (!options.script.empty()) script_.emplace(parseScript(readFile(options.script, kLongestScript), options.script));
  bench_.perform = [this](Action action, const std::string& argument) { perform(action, argument); };
  bench_.openPreset = [this](const PresetFile& preset) { openSky(preset.file, {preset.name, ""}); };
  bench_.goTo = [this](int number) { bookmark(number, false); };
  bench_.keep = [this](int number) { bookmark(number, true); };
  bench_.leave = [this] { running_ = false; };
  bench_.pace.scale = static_cast<float>(options.scale > 0.0 ? options.scale : picture_.softwareDriver() ? 0.5 : 1.0);
  if (picture_.softwareDriver())
    bench_.say("No GPU was found: the processor draws, coarsely while something moves and in full at rest.");
}

// Whether nothing on screen changes by itself but thumbnails.
bool Viewer::atRest() const {
  return !bench_.playing && !bench_.navigation.travelling() && picture_.settled() && !adapting_;
}

// How long the loop may wait for events, ms.
int Viewer::patience() const {
  if (lively_ > 0 || script_ || !atRest()) return 0;
  const bool traces = reference_.running() && !reference_.state().complete;
  return thumbnails_.complete() && !traces ? 200 : 50;
}

void Viewer::run() {
  Clock::time_point last = Clock::now();
  while (running_) {
    std::vector<Event> events = platform_->poll(patience());
    std::optional<ScriptStep> step;
    bool finished = false;
    if (script_) {
      ScriptPlayer::Frame frame = script_->next([&](const std::string& name) { return interface_.items.find(name); },
                                                atRest() && thumbnails_.complete());
      // The user's hands stay out of a script.
      std::erase_if(events, [](const Event& e) { return e.kind != EventKind::quit && e.kind != EventKind::resize; });
      events.insert(events.end(), frame.events.begin(), frame.events.end());
      step = frame.command;
      finished = frame.finished;
    }
    swallowText_ = false;
    for (const Event& event : events) handle(event);
    lively_ = events.empty() ? lively_ - 1 : 3;

    const double seconds = script_ ? kScriptFrame : std::min(secondsSince(last), 0.25);
    last = Clock::now();
    if (thumbnails_.collect(gl_)) lively_ = 3;
    entitle();
    interface_.begin(seconds);
    drawPanels();
    move(seconds);
    draw(seconds);
    if (step) command(*step);
    if (finished) {
      if (!options_.screenshot.empty())
        savePngOf(gl_, platform_->framebuffer(), platform_->width(), platform_->height(), options_.screenshot);
      running_ = false;
    }
    platform_->present();
  }
}

void Viewer::handle(const Event& event) {
  if (event.kind == EventKind::text && swallowText_) return;
  interface_.feed(event);
  switch (event.kind) {
    case EventKind::quit:
      leave();
      break;
    case EventKind::mouseMove: {
      const glm::vec2 now(event.x, event.y);
      if (dragging_) dragView(now - pointer_);
      pointer_ = now;
      break;
    }
    case EventKind::mouseButton:
      if (!event.down)
        dragging_.reset();
      else if (!interface_.wantsMouse())
        dragging_ = event.button;
      break;
    case EventKind::wheel:
      if (interface_.wantsMouse()) break;
      {
        Camera camera = bench_.document.scene().camera;
        bench_.navigation.stop();
        if (interface_.modifiers().ctrl)
          bench_.navigation.zoom(camera, event.y);
        else
          bench_.navigation.dolly(camera, event.y);
        bench_.document.moveCamera(camera);
      }
      break;
    case EventKind::key:
      if (event.down) pressed(event.key);
      break;
    case EventKind::drop:
      openSky(event.text, {event.text, event.text});
      break;
    case EventKind::resize:
      // A script's wish; the window answers with a resize event of its own.
      if (static_cast<int>(event.x) != platform_->width() || static_cast<int>(event.y) != platform_->height())
        platform_->resize(static_cast<int>(event.x), static_cast<int>(event.y));
      break;
    case EventKind::text:
      break;
  }
}

void Viewer::pressed(Key key) {
  const Modifiers modifiers = interface_.modifiers();
  // In a text field letters are letters; on widgets space and tab belong to them.
  if (interface_.wantsText() && !modifiers.ctrl && (key < Key::f1 || key > Key::f12)) return;
  if (interface_.wantsText() && modifiers.ctrl && (key == Key::z || key == Key::c || key == Key::a)) return;
  if (interface_.wantsKeys() && key == Key::space) return;
  // Away from the panels, unless there is something to close first.
  if (key == Key::escape && !ImGui::IsAnyItemActive() &&
      !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
    if (bench_.helpShown)
      bench_.helpShown = false;
    else
      ImGui::SetWindowFocus(nullptr);
    return;
  }
  if (key >= Key::digit1 && key <= Key::digit9 && !modifiers.alt && !modifiers.shift) {
    bookmark(static_cast<int>(key) - static_cast<int>(Key::digit1), modifiers.ctrl);
    swallowText_ = true;
    return;
  }
  const std::optional<Action> action = actionOf({key, modifiers});
  if (!action) return;
  swallowText_ = true;
  perform(*action, "");
}

void Viewer::bookmark(int number, bool keep) {
  std::optional<Camera>& place = bench_.bookmarks[static_cast<std::size_t>(number)];
  const Camera& here = bench_.document.scene().camera;
  if (keep) {
    place = here;
    bench_.say(fmt::format("Bookmark {} kept.", number + 1));
  } else if (place) {
    bench_.navigation.travel(here, *place);
  } else {
    bench_.say(fmt::format("There is no bookmark {0}; ctrl+{0} keeps one.", number + 1));
  }
}

void Viewer::perform(Action action, const std::string& argument) {
  Document& document = bench_.document;
  switch (action) {
    case Action::open:
    case Action::saveAs:
    case Action::savePicture:
      if (argument.empty())
        askForFile(bench_, action);
      else if (action == Action::open)
        openSky(argument, {argument, argument});
      else if (action == Action::saveAs)
        saveSky(argument);
      else
        savePicture(argument);
      break;
    case Action::save:
      if (document.origin().file.empty())
        askForFile(bench_, Action::saveAs);
      else
        saveSky(document.origin().file);
      break;
    case Action::copyCommand:
      platform_->setClipboard(commandLine(document.scene(), document.savedScene(), document.origin().name));
      bench_.say("The command that renders this picture is on the clipboard.");
      break;
    case Action::quit:
      leave();
      break;
    case Action::undo:
      if (document.canUndo()) {
        bench_.say("Undone: " + document.undoName());
        document.undo();
      }
      break;
    case Action::redo:
      if (document.canRedo()) {
        bench_.say("Done again: " + document.redoName());
        document.redo();
      }
      break;
    case Action::play:
      bench_.playing = !bench_.playing;
      break;
    case Action::trace:
      bench_.referenceWanted = !bench_.referenceWanted;
      if (bench_.referenceWanted) bench_.say("The path tracer begins when the picture has come to rest.");
      break;
    case Action::resetTime:
      document.moveTime(0.0f);
      break;
    case Action::navigation: {
      NavigationMode& mode = bench_.navigation.mode;
      mode = mode == NavigationMode::look ? NavigationMode::orbit : NavigationMode::look;
      bench_.say(mode == NavigationMode::look ? "Dragging looks round." : "Dragging orbits.");
      break;
    }
    case Action::below:
    case Action::inside:
    case Action::above: {
      const Vantage vantage = action == Action::below    ? Vantage::below
                              : action == Action::inside ? Vantage::inside
                                                         : Vantage::above;
      bench_.navigation.travel(document.scene().camera, cameraAt(document.scene(), vantage));
      break;
    }
    case Action::homeView:
      bench_.navigation.travel(document.scene().camera, document.savedScene().camera);
      break;
    case Action::panels:
      bench_.panels = !bench_.panels;
      break;
    case Action::focusPanel:
      bench_.panels = true;
      ImGui::SetWindowFocus(interface_.wantsKeys() ? nullptr : kSide);
      break;
    case Action::search:
      bench_.panels = bench_.focusSearch = true;
      bench_.wantedTab = Tab::parameters;
      break;
    case Action::gallery:
    case Action::parameters:
    case Action::sun:
    case Action::wind:
    case Action::camera:
    case Action::film:
    case Action::pace:
    case Action::reference:
      bench_.panels = true;
      bench_.wantedTab = tabOf(action);
      break;
    case Action::help:
      bench_.helpShown = !bench_.helpShown;
      break;
    case Action::biggerInterface:
      interface_.setScale(std::min(interface_.scale() * 1.125f, 4.0f));
      break;
    case Action::smallerInterface:
      interface_.setScale(std::max(interface_.scale() / 1.125f, 0.6f));
      break;
  }
}

void Viewer::openSky(const std::string& path, const Origin& origin) {
  try {
    Scene scene = loadSky(path);
    realtime::CustomTextures textures = options_.loadTextures(scene);  // before anything is given up for it
    if (bench_.keepCamera) scene.camera = bench_.document.scene().camera;
    bench_.document.open(std::move(scene), origin);
    bench_.navigation.stop();
    bench_.refusals.clear();
    bench_.say("Opened " + path);
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

void Viewer::entitle() {
  if (titledRevision_ == bench_.document.revision() && titled_ == bench_.document.origin().name) return;
  titledRevision_ = bench_.document.revision();
  titled_ = bench_.document.origin().name;
  const std::string name = titled_.empty() ? "default" : std::filesystem::path(titled_).filename().string();
  platform_->setTitle(fmt::format("{}{} – Welkin", bench_.document.modified() ? "*" : "", name));
}

// Unsaved changes are asked about, but not by a script.
void Viewer::leave() {
  if (script_ || !bench_.document.modified())
    running_ = false;
  else
    bench_.panels = bench_.askBeforeLeaving = true;
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

// What held keys do, and time.
void Viewer::move(double seconds) {
  Camera camera = bench_.document.scene().camera;
  Thrust thrust;
  const Modifiers modifiers = interface_.modifiers();
  if (!interface_.wantsText() && !modifiers.ctrl) {
    const auto axis = [&](Key plus, Key minus) {
      return (interface_.isDown(plus) ? 1.0f : 0.0f) - (interface_.isDown(minus) ? 1.0f : 0.0f);
    };
    const float pace = modifiers.shift ? 6.0f : modifiers.alt ? 0.15f : 1.0f;
    thrust.forward = pace * axis(Key::w, Key::s);
    thrust.right = pace * axis(Key::d, Key::a);
    thrust.up = pace * axis(Key::e, Key::q);
    if (!interface_.wantsKeys()) {
      thrust.yaw = axis(Key::right, Key::left);
      thrust.pitch = axis(Key::up, Key::down);
    }
  }
  if (thrust.any()) {
    bench_.navigation.stop();
    bench_.navigation.fly(camera, thrust, seconds);
    lively_ = 3;
  }
  bench_.navigation.advance(camera, seconds);
  bench_.document.moveCamera(camera);
  if (bench_.playing)
    bench_.document.moveTime(bench_.document.scene().time + bench_.timeRate * static_cast<float>(seconds));
}

void Viewer::dragView(const glm::vec2& by) {
  Camera camera = bench_.document.scene().camera;
  const glm::vec2 drag = by / static_cast<float>(std::max(region().width, 1));
  bench_.navigation.stop();
  switch (*dragging_) {
    case MouseButton::left:
      bench_.navigation.turn(camera, drag);
      break;
    case MouseButton::right:
      bench_.navigation.orbit(camera, drag);
      break;
    case MouseButton::middle:
      bench_.navigation.pan(camera, drag);
      break;
  }
  bench_.document.moveCamera(camera);
}

// What the panels leave free.
Region Viewer::region() const {
  const int width = platform_->width(), height = platform_->height();
  if (!bench_.panels) return {0, 0, width, height};
  const int bar = static_cast<int>(ImGui::GetFrameHeight()), left = static_cast<int>(panelWidth_);
  return {left, bar, std::max(width - left, 1), std::max(height - 2 * bar, 1)};
}

void Viewer::drawPanels() {
  if (!bench_.panels) return;
  drawMenu(bench_);
  drawStatus(bench_);
  const float bar = ImGui::GetFrameHeight();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (panelWidth_ == 0.0f) panelWidth_ = std::min(ImGui::GetFontSize() * 28.0f, 0.5f * screen.x);
  ImGui::SetNextWindowPos({0.0f, bar});
  ImGui::SetNextWindowSizeConstraints({1.0f, 1.0f}, {screen.x * 0.8f, screen.y});
  ImGui::SetNextWindowSize({panelWidth_, std::max(screen.y - 2.0f * bar, 1.0f)});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin(kSide, nullptr, kFlags)) drawTabs();
  panelWidth_ = ImGui::GetWindowWidth();
  ImGui::End();
  drawFiles(bench_);
  if (!reference_.texture() || bench_.comparison != Comparison::wipe) return;
  const Region part = region();
  const float x = static_cast<float>(part.x) + bench_.wipe * static_cast<float>(part.width);
  const float top = screen.y - static_cast<float>(part.y + part.height), bottom = screen.y - static_cast<float>(part.y);
  ImGui::GetBackgroundDrawList()->AddLine({x, top}, {x, bottom}, IM_COL32(255, 255, 255, 200), 1.5f);
}

void Viewer::drawTabs() {
  if (!ImGui::BeginTabBar("##tabs", ImGuiTabBarFlags_FittingPolicyScroll)) return;
  for (const TabInfo& info : kTabs) {
    const bool wanted = bench_.wantedTab == info.tab;
    const bool shown =
        ImGui::BeginTabItem(info.title, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None);
    interface_.items.mark(std::string("tab ") + info.title);
    if (!shown) continue;
    bench_.tab = info.tab;
    info.draw(bench_);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
  bench_.wantedTab.reset();
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
// Automatic exposure follows the picture as an eye does, within a second.
void Viewer::expose(double seconds) {
  bench_.film = bench_.document.scene().film;
  if (bench_.film.exposure != ExposureMode::automatic) {
    metered_ = false;
    return;
  }
  const double now = automaticEv(picture_.meter());
  meteredEv_ = metered_ ? meteredEv_ + (now - meteredEv_) * (1.0 - std::exp(-4.0 * seconds)) : now;
  metered_ = true;
  adapting_ = std::abs(now - meteredEv_) > 0.01;
  bench_.film.ev = static_cast<float>(meteredEv_);
}

void Viewer::draw(double seconds) {
  takeScene();
  const Region part = region();
  const Clock::time_point start = Clock::now();
  const Scene& scene = bench_.document.scene();
  if (picture_.draw(scene.camera, scene.time, part.width, part.height, bench_.pace.scale)) {
    gl_.Finish();
    Pace& pace = bench_.pace;
    const double ms = 1000.0 * secondsSince(start);
    pace.frameMs = pace.frameMs > 0.0 ? 0.8 * pace.frameMs + 0.2 * ms : ms;
    pace.times[pace.next++ % Pace::kKept] = static_cast<float>(ms);
    if (bench_.panels && bench_.tab == Tab::pace) pace.cost = picture_.cost();
  }
  expose(seconds);
  tendReference();
  gl_.BindFramebuffer(GL_FRAMEBUFFER, platform_->framebuffer());
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  picture_.show(platform_->framebuffer(), part, bench_.film, {&reference_.texture(), bench_.comparison, bench_.wipe});
  gl_.BindFramebuffer(GL_FRAMEBUFFER, platform_->framebuffer());
  interface_.draw();
}

void Viewer::command(const ScriptStep& step) {
  if (step.verb == "screenshot") {
    savePngOf(gl_, platform_->framebuffer(), platform_->width(), platform_->height(), step.words[0]);
  } else if (step.verb == "picture") {
    options_.savePicture(step.words[0], picture_.read(), bench_.film);
  } else {
    const std::optional<Action> action = actionNamed(step.words[0]);
    if (!action) script_->fail(step, fmt::format("'{}' is not an action", step.words[0]));
    perform(*action, step.words.size() > 1 ? step.words[1] : "");
  }
}

}  // namespace

void runViewer(const ViewerOptions& options) { Viewer(options).run(); }

}  // namespace welkin::viewer
