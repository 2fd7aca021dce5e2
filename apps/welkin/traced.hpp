#pragma once
// Path-traced pictures: options of the command line, checkpoints, Ctrl-C.
#include <string>
#include <vector>

#include "apps/welkin/command.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::app {

enum class Renderer { realtime, path };

struct TraceOptions {
  int width = 1280, height = 720;
  int scatterings = 0;  // 0: no limit
  int samples = 0;      // 0: 64, or 4096 at most where noise or seconds decide
  double noise = 0.0, seconds = 0.0, checkpointSeconds = 5.0;
  std::string air = "medium", checkpoint;
  bool layers = false, denoise = false;
  Progress progress;
  std::vector<const CLI::Option*> flags;  // that set these
};

// The tracer's settings for these options.
trace::TraceSettings traceSettings(const TraceOptions& options);

// --renderer, and how long the path tracer works; addTimeLimit adds --seconds, addStillOptions what makes sense for a
// single picture.
void addTimeLimit(CLI::App& command, TraceOptions& options);
void addStillOptions(CLI::App& command, TraceOptions& options);
void addRendererOptions(CLI::App& command, Renderer& renderer, TraceOptions& options);
// Throws UsageError where one of them is given for a renderer that has no use for it.
void requireUse(const TraceOptions& options, Renderer renderer);

// Traces the sky and writes the picture. Ctrl-C ends it early with the picture so far; a checkpoint, if asked for, is
// taken up where it is found and removed once the picture is complete. Throws Error.
void traceToFile(const Scene& scene, const TraceOptions& options, const std::string& output);

}  // namespace welkin::app
