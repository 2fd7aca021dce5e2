#pragma once
// The command: parse, call, print. Each subcommand is one file that adds itself to the application.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/welkin/presets.hpp"
#include "apps/welkin/usage_error.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::app {

enum ExitCode { kOk = 0, kFailed = 1, kUsage = 2, kBadInput = 3, kNoOpenGl = 4 };

// The arguments by which every subcommand names and changes a sky.
struct SkyArguments {
  std::string sky;  // a file, the name of a preset, or empty for the default sky
  std::string quality, camera, tone;
  std::optional<double> time, ev;
  std::optional<long long> seed;
  std::vector<std::string> assignments;

  enum class Need { optional, required };
  void addTo(CLI::App& command, Need need);
  void addPictureOptionsTo(CLI::App& command);
  // The sky as it is at its time, and as its file has it, with its keyframes. What the command line sets has none.
  Scene scene() const;
  Scene animated() const;
};

// $WELKIN_PRESETS, or the folder beside the program in an installation or in the source tree; empty when there is none.
std::string presetFolder();

// The presets that came with Welkin.
std::vector<Preset> findPresets();

struct Size {
  int width, height;
};
// "1280x720". Throws UsageError for anything else, and for edges beyond 16384.
Size parseSize(const std::string& text);

// `--json`, for a subcommand that programs read.
std::shared_ptr<bool> addJsonFlag(CLI::App& command);

void addHdri(CLI::App& app);
void addRender(CLI::App& app);
void addView(CLI::App& app);
void addFly(CLI::App& app);
void addCompare(CLI::App& app);
void addPresets(CLI::App& app);
void addFields(CLI::App& app);
void addCheck(CLI::App& app);
void addInfo(CLI::App& app);
void addNoise(CLI::App& app);
void addWeather(CLI::App& app);
void addCloud(CLI::App& app);
void addVdb(CLI::App& app);
void addVideo(CLI::App& app);
void addFlux(CLI::App& app);
void addValidate(CLI::App& app);
void addDoctor(CLI::App& app);

}  // namespace welkin::app
