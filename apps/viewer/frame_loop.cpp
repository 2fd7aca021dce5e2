#include "apps/viewer/frame_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"
#include "apps/viewer/picture/screenshot.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kScriptFrame = 1.0 / 60.0;  // s: scripts count frames
constexpr std::size_t kLongestScript = 1 << 20;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::unique_ptr<Platform> openPlatform(const ViewerOptions& options) {
  const WindowOptions window{.width = options.width, .height = options.height};
  return options.headless ? openHeadless(window) : openWindow(window);
}

std::vector<std::string> filesOf(const std::vector<PresetFile>& presets) {
  std::vector<std::string> files;
  files.reserve(presets.size());
  for (const PresetFile& p : presets) files.push_back(p.file);
  return files;
}

}  // namespace

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
                                                                          .interface = interface_,
                                                                          .textures = textures_,
                                                                          .weather = WeatherDesk(gl_),
                                                                          .noise = NoiseDesk(gl_),
                                                                          .slice = SliceDesk(gl_)} {
  if (options.uiScale > 0.0) interface_.setScale(static_cast<float>(options.uiScale));
  if (!options.script.empty()) script_.emplace(parseScript(readFile(options.script, kLongestScript), options.script));
  bench_.perform = [this](Action action, const std::string& argument) { perform(action, argument); };
  bench_.openPreset = [this](const PresetFile& preset) { openSky(preset.file, {preset.name, ""}); };
  bench_.goTo = [this](int number) { bookmark(number, false); };
  bench_.keep = [this](int number) { bookmark(number, true); };
  bench_.leave = [this] { running_ = false; };
  bench_.wantedTab = Tab::parameters;
  bench_.pace.scale = static_cast<float>(options.scale);
  // Scripts count frames, not seconds, and must not depend on the machine's pace.
  const double rate = script_ ? 0.0 : picture_.softwareDriver() ? 25.0 : 60.0;
  bench_.pace.wantedRate = static_cast<float>(options.rate.value_or(rate));
  if (picture_.softwareDriver())
    bench_.say("No GPU was found: the processor draws, coarsely while something moves and in full at rest.");
  if (options.fly) beginFlight();
  if (options.map) useMap(*options.map);
  if (options.showMap) showMap(true);
}

// Whether nothing on screen changes by itself but thumbnails.
bool Viewer::atRest() const {
  return !bench_.playing && !bench_.navigation.travelling() && picture_.settled() && !adapting_;
}

// How long the loop may wait for events, ms. A script does not run away from work in the background.
int Viewer::patience() const {
  if (!atRest() || (lively_ > 0 && !script_)) return 0;
  const bool traces = reference_.running() && !reference_.state().complete;
  if (traces || !thumbnails_.complete() || !bench_.slice.slice.complete()) return 50;
  return script_ ? 0 : 200;
}

void Viewer::run() {
  Clock::time_point last = Clock::now();
  while (running_) {
    std::vector<Event> events = platform_->poll(patience());
    std::optional<ScriptStep> step;
    bool finished = false;
    if (script_) {
      const bool complete = atRest() && thumbnails_.complete() && bench_.slice.slice.complete();
      ScriptPlayer::Frame frame = script_->next([&](const std::string& name) { return interface_.items.find(name); },
                                                bench_.playing ? Rest::runs
                                                : complete     ? Rest::there
                                                               : Rest::comes);
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
    if (step && step->verb == "fly") steer(*step);
    // A flight may leave out frames of its script while it flies, and ends with the last one.
    const bool counts = flight_ && script_ && !finished;
    const bool kept = counts && scriptFrames_++ % options_.fly->every == 0;
    if (counts && !kept && bench_.playing && (!step || step->verb == "fly")) {
      move(seconds);
      continue;
    }
    if (thumbnails_.collect(gl_)) lively_ = 3;
    collectSlice();
    entitle();
    interface_.begin(seconds);
    drawPanels();
    if (!(flight_ && finished)) move(seconds);
    if (flight_) drawFlight();
    draw(seconds);
    if (step) command(*step);
    if (kept) keepFrame();
    if (finished) {
      if (!options_.screenshot.empty())
        savePngOf(gl_, platform_->framebuffer(), platform_->width(), platform_->height(), options_.screenshot);
      running_ = false;
    }
    platform_->present();
  }
  endFlight();
}

void Viewer::collectSlice() {
  SliceDesk& desk = bench_.slice;
  if (!desk.slice.collect()) return;
  const SlicePicture& picture = desk.slice.picture();
  if (!picture.rgba.empty()) desk.image.set(picture.width, picture.height, picture.rgba);
  lively_ = 3;
}

// What the panels leave free.
Region Viewer::region() const {
  const int width = platform_->width(), height = platform_->height();
  if (!bench_.panels) return {0, 0, width, height};
  const int bar = static_cast<int>(ImGui::GetFrameHeight()), left = static_cast<int>(panelWidth_);
  return {left, bar, std::max(width - left, 1), std::max(height - 2 * bar, 1)};
}

// The share of the window's resolution that a moving picture has: all of it on a GPU, that of 640x360 without.
float Viewer::scaleFor(const Region& part) const {
  if (bench_.pace.scale > 0.0f) return bench_.pace.scale;
  if (!picture_.softwareDriver()) return 1.0f;
  return std::min(1.0f, std::sqrt(640.0f * 360.0f / static_cast<float>(part.width) / static_cast<float>(part.height)));
}

void Viewer::draw(double seconds) {
  takeScene();
  const Region part = region();
  const Clock::time_point start = Clock::now();
  const Scene& scene = bench_.document.scene();
  Pace& pace = bench_.pace;
  if (pace.wantedRate != governed_) {
    governed_ = pace.wantedRate;
    picture_.govern(governed_ > 0.0f ? 1.0 / static_cast<double>(governed_) : 0.0);
    picture_.waitForLight(governed_ <= 0.0f);
  }
  const bool drawn = picture_.draw(scene.camera, scene.time, part.width, part.height, scaleFor(part));
  if (drawn && bench_.panels && bench_.tab == Tab::pace) pace.cost = picture_.cost();
  expose(seconds);
  tendReference();
  gl_.BindFramebuffer(GL_FRAMEBUFFER, platform_->framebuffer());
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  picture_.show(platform_->framebuffer(), part, bench_.film,
                {&reference_.texture(), bench_.comparison, bench_.wipe,
                 bench_.countSamples && bench_.showSamples ? bench_.mostSamples : 0.0f});
  gl_.BindFramebuffer(GL_FRAMEBUFFER, platform_->framebuffer());
  interface_.draw();
  gl_.check("drawing the window");
  if (!drawn) return;
  gl_.Finish();
  const double took = secondsSince(start);
  picture_.took(took);
  pace.frameMs = pace.frameMs > 0.0 ? 0.8 * pace.frameMs + 0.2 * 1000.0 * took : 1000.0 * took;
  pace.times[pace.next++ % Pace::kKept] = static_cast<float>(1000.0 * took);
}

void Viewer::command(const ScriptStep& step) {
  if (step.verb == "fly") return;
  if (step.verb == "screenshot") {
    savePngOf(gl_, platform_->framebuffer(), platform_->width(), platform_->height(), step.words[0]);
  } else if (step.verb == "picture") {
    options_.savePicture(step.words[0], picture_.read(), bench_.film);
  } else if (step.verb == "rate") {
    bench_.pace.wantedRate = std::stof(step.words[0]);
  } else {
    const std::optional<Action> action = actionNamed(step.words[0]);
    if (!action) script_->fail(step, fmt::format("'{}' is not an action", step.words[0]));
    perform(*action, step.words.size() > 1 ? step.words[1] : "");
  }
}

void runViewer(const ViewerOptions& options) { Viewer(options).run(); }

}  // namespace welkin::viewer
