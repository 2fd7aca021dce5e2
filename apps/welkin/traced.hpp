#pragma once
// Path-traced pictures: options of the command line, checkpoints, Ctrl-C.
#include <string>

#include "apps/welkin/command.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::app {

enum class Renderer { realtime, path };

struct TraceOptions {
  int width = 1280, height = 720;
  int samples = 0;  // 0: 64, or 4096 at most where noise or seconds decide
  double noise = 0.0, seconds = 0.0;
  std::string air = "medium", layers, checkpoint;
  Progress progress;
};

// --renderer, and what the path tracer can be told.
void addRendererOptions(CLI::App& command, Renderer& renderer, TraceOptions& options);

// Traces the sky and writes the picture. Ctrl-C ends it early with the picture so far.
void traceToFile(const Scene& scene, const TraceOptions& options, const std::string& output);

}  // namespace welkin::app
