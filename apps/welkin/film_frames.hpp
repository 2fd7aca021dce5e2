#pragma once
// The pictures of a film, drawn in real time or traced, into its folder.
#include "apps/welkin/frame_folder.hpp"
#include "apps/welkin/shot.hpp"
#include "apps/welkin/traced.hpp"
#include "welkin/base/progress.hpp"

namespace welkin::app {

enum class SampleDepth { bits8, bits16 };

struct FrameOptions {
  int width = 1280, height = 720;
  int draws = 0;  // of the real-time renderer for one frame; 0: until every pixel is new
  SampleDepth depth = SampleDepth::bits8;
  Progress progress{};  // over what is missing
};

// How often a frame is drawn.
int drawsOf(const Shot& shot, const FrameOptions& options);

// Draws the frames that the folder lacks. Each stretch of frames begins anew, drawn in over the frames before it, so
// that a film that was interrupted anywhere goes on to the same pictures. Throws Error, and Cancelled by `progress`.
void drawFrames(const Shot& shot, const FrameOptions& options, FrameFolder& folder);

// The same, path-traced. Every frame stands for itself and has noise of its own.
void traceFrames(const Shot& shot, const FrameOptions& options, const TraceOptions& trace, FrameFolder& folder);

}  // namespace welkin::app
