#pragma once
// The uniform block "Frame" (shaders/frame.glsl): rays, sizes, reprojection.
#include <glm/glm.hpp>

#include "welkin/realtime/renderer.hpp"

namespace welkin::realtime {

struct FrameParams {
  glm::vec4 ray, rayX, rayY, size, marchSize, offset, timing, depthInfo;
  glm::vec4 previous0, previous1, previous3, wind, options, target;
  glm::mat4 clipFromWorld;  // of positions relative to the eye, east-north-up; the shaders' block ends before it
};

// `frames`: number of this frame since the view's history began.
FrameParams frameParams(const Frame& frame, int historyWidth, int historyHeight, int interleave, const Quality& quality,
                        int frames);

// Fills in what leads back to the last frame. `moved`: how the eye moved; `drifted`: how the air moved; `share` of the
// new sample in the history.
void setHistory(FrameParams& params, const FrameParams* last, const glm::dvec3& moved, const glm::dvec2& drifted,
                bool valid, float share);

// Whether two frames look the same way (position and time apart).
bool sameView(const FrameParams& a, const FrameParams& b);

// A perspective camera's frame: view and projection of the scene's camera for a picture of this size.
Frame frameOf(const Camera& camera, int width, int height);

}  // namespace welkin::realtime
