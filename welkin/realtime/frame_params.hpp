#pragma once
// The uniform block "Frame" (shaders/frame.glsl): rays, sizes, reprojection.
#include <glm/glm.hpp>

#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/law.hpp"

namespace welkin::realtime {

struct FrameParams {
  law::CameraParams camera;
  glm::vec4 size, marchSize, offset, timing, depthInfo;
  glm::vec4 previous0, previous1, previous3, wind, options, target, lock;
  // Of positions relative to the eye, east-north-up; for a panorama to its own axes. The shaders' block ends before it.
  glm::mat4 clipFromWorld;
};

// `frames`: number of this frame since the view's history began.
FrameParams frameParams(const Frame& frame, int historyWidth, int historyHeight, int interleave, const Quality& quality,
                        int frames);

// What a view's history holds: nothing; a picture to be reprojected, of a sky or a light that was another one or of
// this; one of a view that stands still; or, while such a view fills its blocks for the first time, marched pixels
// among others that are to be filled in.
enum class History { none, changed, moved, still, begun };

// Fills in what leads back to the last frame. `moved`: how the eye moved; `drifted`: how the air moved; `share` of the
// new sample in the history.
void setHistory(FrameParams& params, const FrameParams* last, const glm::dvec3& moved, const glm::dvec2& drifted,
                History history, float share);

// How far the picture has moved over the history's grid, in its pixels, since the view began: by turns of the camera
// only, in the middle of the picture.
glm::dvec2 travelled(const FrameParams& params, const FrameParams& last);

// Puts the history's grid where the picture has moved to, whole pixels aside: turning then takes texels to texels,
// which blurs nothing, and each is marched again after interleave^2 frames wherever it is by then.
void lockGrid(FrameParams& params, const glm::dvec2& travel);

// Whether something round a direction (to `radius` rad) may be in the picture.
bool mayShow(const FrameParams& params, const glm::vec3& direction, float radius);

// Whether two frames look the same way (position and time apart).
bool sameView(const FrameParams& a, const FrameParams& b);

// The frame of the scene's camera for a picture of this size.
Frame frameOf(const Camera& camera, int width, int height);

// The part of a frame whose lower left pixel is (x, y): a picture too large for one target is drawn in such parts.
Frame tileOf(const Frame& whole, int x, int y, int width, int height);

}  // namespace welkin::realtime
