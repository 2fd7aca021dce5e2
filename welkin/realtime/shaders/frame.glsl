// What all passes of a view know: rays, sizes, the host's depth. Includers have the law's vocabulary before it.
#include "welkin/scene/camera.glsl"

layout(std140) uniform Frame {
  CameraParams uCamera;
  vec4 uSize;         // history width, height, 1 / width, 1 / height
  vec4 uMarchSize;    // march target width, height, 1 / width, 1 / height
  vec4 uOffset;       // xy: pixel of the block that this frame marches, zw: shift inside the pixel
  vec4 uTiming;       // x: frame number, y: share of the new sample, z: enum History, w: interleave
  vec4 uDepthInfo;    // x: 1 when the host gives depth, y: P22, z: P32, w: 1 when ndc z = depth
  vec4 uPrevious0;    // rows of the last frame's clip transform of positions relative to this camera; of a panorama, its
                      // right, above and forward
  vec4 uPrevious1;
  vec4 uPrevious3;
  vec4 uWind;         // xyz: way of the wind since the last frame, w: factor on the light of the history
  vec4 uOptions;      // x: from that factor to the host's pre-exposure, y: jitter, z: what is behind (frame_params.cpp),
                      // w: rad of a target pixel
  vec4 uTarget;       // target width, height, 1 / width, 1 / height
  vec4 uLock;         // xy: from picture coordinates of the history to those of the target
};

vec3 rayAt(vec2 ndc) { return cameraRay(ndc, uCamera); }

// Distance along the view of the host's depth at uv, m, or far away.
float hostAlongView(sampler2D depth, vec2 uv) {
  float z = textureLod(depth, uv, 0.0).x;
  float along = (uDepthInfo.w > 0.5 ? z : z * 2.0 - 1.0) + uDepthInfo.y;
  float view = uDepthInfo.z / (abs(along) < 1e-9 ? 1e-9 : along);
  return view <= 0.0 || view > 1e7 ? 1e8 : view;
}

// The same along a ray.
float hostDistance(sampler2D depth, vec2 uv, vec3 ray) {
  float view = uDepthInfo.x < 0.5 ? 1e8 : hostAlongView(depth, uv);
  return view < 1e8 ? view * length(ray) : 1e8;
}

// Whether a ray as far as the host's distance `there` tells what clouds stand before `here`: these are about the same, or
// what it saw, which lets `left` of the light through, stands before both, at a distance of `clouds`.
bool tellsOf(float here, float there, float left, float clouds) {
  float near = min(here, there);
  return max(here, there) < 2.0 * near || (left < 0.25 && clouds < near);
}
