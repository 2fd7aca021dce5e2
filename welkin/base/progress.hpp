#pragma once
// Progress of long work, for whoever watches, and the way to stop it.
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace welkin {

// Called now and then with the share of the work that is done, in [0, 1]; returning false asks the work to stop, which
// it does by throwing Cancelled. An empty callback watches nothing.
using Progress = std::function<bool(double done)>;

struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

// Tells a callback, if there is one. Throws Cancelled when it answers false.
void report(const Progress& progress, double done);

// One stage of longer work: maps [0, 1] of the stage onto [begin, end] of the whole.
Progress stageOf(const Progress& whole, double begin, double end);

// Shows progress on stderr: one line with bar, percent, elapsed and remaining time that redraws itself on a terminal,
// else a line at every tenth of the work and at least every ten seconds; `quiet` shows nothing.
enum class ProgressStyle { automatic, bar, lines, quiet };
class ProgressDisplay {
 public:
  explicit ProgressDisplay(std::string task, ProgressStyle style = ProgressStyle::automatic);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  Progress callback();

 private:
  struct State;
  std::shared_ptr<State> state_;
};

// The text of one update: "rendering  42%  3.1 s, 4.3 s left".
std::string progressLine(const std::string& task, double done, double elapsedSeconds);

}  // namespace welkin
