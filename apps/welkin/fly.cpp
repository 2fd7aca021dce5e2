// welkin fly: an aircraft in a sky.
#include <algorithm>
#include <iterator>

#include "apps/welkin/window.hpp"

namespace welkin::app {

namespace {

struct FlyArguments {
  WindowArguments window;
  std::string start = "runway", record, frames;
  int every = 1;
};

#ifdef WELKIN_HAS_VIEWER
void fly(const FlyArguments& arguments) {
  if (!arguments.frames.empty() && arguments.window.script.empty())
    throw UsageError("--out takes the frames of a --script");
  viewer::ViewerOptions options = arguments.window.options();
  const auto* const start =
      std::find(std::begin(viewer::kFlightStarts), std::end(viewer::kFlightStarts), arguments.start);
  options.fly = viewer::FlyOptions{.start = static_cast<viewer::FlightStart>(start - std::begin(viewer::kFlightStarts)),
                                   .record = arguments.record,
                                   .frames = arguments.frames,
                                   .every = arguments.every};
  viewer::runViewer(options);
}
#else
void fly(const FlyArguments& /*arguments*/) { refuseWithoutWindow(); }
#endif

}  // namespace

void addFly(CLI::App& app) {
  auto* command = app.add_subcommand("fly", "an aircraft in a sky: take off, climb through the clouds, land");
  auto arguments = std::make_shared<FlyArguments>();
  arguments->window.addTo(*command);
  command->add_option("--start", arguments->start, "runway, final (the approach to it), or below, inside, above clouds")
      ->check(CLI::IsMember({"runway", "final", "below", "inside", "above"}))
      ->capture_default_str();
  command->add_option("--record", arguments->record, "a file for what was flown, to be played by --script")
      ->type_name("FILE");
  command->add_option("-o,--out", arguments->frames, "a folder for the frames of the script, as PNG")
      ->type_name("FOLDER");
  command->add_option("--every", arguments->every, "draws each so many of the script's 60 frames a second: 2 gives 30")
      ->check(CLI::Range(1, 600))
      ->capture_default_str();
  command->callback([arguments] { fly(*arguments); });
}

}  // namespace welkin::app
