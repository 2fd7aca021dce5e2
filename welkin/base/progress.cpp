#include "welkin/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>

namespace welkin {

void report(const Progress& progress, double done) {
  if (progress && !progress(std::clamp(done, 0.0, 1.0))) throw Cancelled();
}

Progress stageOf(const Progress& whole, double begin, double end) {
  if (!whole) return {};
  return [whole, begin, end](double done) { return whole(begin + (end - begin) * done); };
}

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kRedrawSeconds = 0.1, kLineSeconds = 10.0, kLines = 10.0;
constexpr int kBarWidth = 24;

std::string duration(double seconds) {
  if (seconds < 99.95) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progressLine(const std::string& task, double done, double elapsedSeconds) {
  std::string line = fmt::format("{} {:3.0f} %  {}", task, std::floor(done * 100.0), duration(elapsedSeconds));
  if (done > 0.0 && done < 1.0)
    line += fmt::format(", {:.1f} %/s, {} left", done * 100.0 / std::max(elapsedSeconds, 1e-9),
                        duration(elapsedSeconds * (1.0 - done) / done));
  return line;
}

struct ProgressDisplay::State {
  std::string task;
  ProgressStyle style;
  std::mutex mutex;
  Clock::time_point start = Clock::now();
  double shownAt = -1e9, shownDone = 0;

  void show(double done) {
    if (style == ProgressStyle::quiet) return;
    const std::scoped_lock lock(mutex);
    const double now = std::chrono::duration<double>(Clock::now() - start).count();
    if (style == ProgressStyle::bar) {
      if (now - shownAt < kRedrawSeconds && done < 1.0) return;
      const int full = static_cast<int>(done * kBarWidth);
      fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}\x1b[K", "", full, "", kBarWidth - full, progressLine(task, done, now));
      std::fflush(stderr);
    } else {
      if (shownAt < 0) shownAt = 0;
      if (now - shownAt < kLineSeconds && std::floor(done * kLines) <= std::floor(shownDone * kLines)) return;
      fmt::print(stderr, "{}\n", progressLine(task, done, now));
    }
    shownAt = now;
    shownDone = done;
  }
};

ProgressDisplay::ProgressDisplay(std::string task, ProgressStyle style) : state_(std::make_shared<State>()) {
  state_->task = std::move(task);
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  state_->style = style != ProgressStyle::automatic ? style : terminal ? ProgressStyle::bar : ProgressStyle::lines;
}

ProgressDisplay::~ProgressDisplay() {
  if (state_->style == ProgressStyle::bar && state_->shownAt >= 0) fmt::print(stderr, "\r\x1b[K");
}

Progress ProgressDisplay::callback() {
  return [state = state_](double done) {
    state->show(done);
    return true;
  };
}

}  // namespace welkin
