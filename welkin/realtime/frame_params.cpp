#include "welkin/realtime/frame_params.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/scene/camera.hpp"

namespace welkin::realtime {

namespace {

// The order in which the pixels of a 2x2 and of a 4x4 block are marched: Bayer's, so that neighbours come far apart.
constexpr int kOrder2[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
constexpr int kOrder4[16][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 1}, {3, 3}, {3, 1}, {1, 3},
                                {1, 0}, {3, 2}, {3, 0}, {1, 2}, {0, 1}, {2, 3}, {2, 1}, {0, 3}};

// Host axes to east, north, up.
glm::mat3 worldAxes(UpAxis up) {
  return up == UpAxis::z ? glm::mat3(1.0f) : glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, -1, 0));
}

// What is behind the clouds: 0 the host's picture; 1 the sky, which is in the history; 2 the sky, which the composite
// pass adds up to the edges of the host's geometry; 3 asks for the transmittance instead.
float behindClouds(const Frame& frame) {
  if (frame.output == Output::transmittance) return 3.0f;
  if (frame.background == Background::host) return 0.0f;
  return frame.depthTexture != 0 ? 2.0f : 1.0f;
}

constexpr float kMovingShift = 0.4f;  // of the shift inside the pixel, where the picture moves

double fraction(double x) { return x - std::floor(x); }

}  // namespace

FrameParams frameParams(const Frame& frame, int width, int height, int interleave, const Quality& quality, int frames) {
  FrameParams p{};
  const glm::mat4& projection = frame.projection;
  const glm::mat3 worldFromEye = worldAxes(frame.up) * glm::transpose(glm::mat3(frame.view));
  float pixelAngle = 0.0f;
  if (frame.mapping == Projection::equirectangular) {
    p.camera.forward = glm::vec4(-worldFromEye[2], 1.0f);
    p.camera.right = glm::vec4(worldFromEye[0], 0.0f);
    p.camera.above = glm::vec4(worldFromEye[1], 0.0f);
    p.camera.angles = panoramaAngles(frame.panorama.x, frame.panorama.y, frame.panorama.z, frame.panorama.w);
    p.clipFromWorld =
        glm::transpose(glm::mat4(p.camera.right, p.camera.above, glm::vec4(0.0f), glm::vec4(-worldFromEye[2], 0.0f)));
    pixelAngle = 2.0f * p.camera.angles.z / static_cast<float>(frame.width);
  } else {
    // An eye ray is ((x + P20) / P00, (y + P21) / P11, -1), whatever the depth convention.
    const float x = 1.0f / projection[0][0], y = 1.0f / projection[1][1];
    p.camera.forward = glm::vec4(worldFromEye * glm::vec3(projection[2][0] * x, projection[2][1] * y, -1.0f), 0.0f);
    p.camera.right = glm::vec4(worldFromEye * glm::vec3(x, 0.0f, 0.0f), 0.0f);
    p.camera.above = glm::vec4(worldFromEye * glm::vec3(0.0f, y, 0.0f), 0.0f);
    p.clipFromWorld = projection * glm::mat4(glm::transpose(worldFromEye));
    pixelAngle = 2.0f * glm::length(glm::vec3(p.camera.right)) / static_cast<float>(frame.width);
  }
  const auto size = [](int w, int h) {
    return glm::vec4(w, h, 1.0f / static_cast<float>(w), 1.0f / static_cast<float>(h));
  };
  p.size = size(width, height);
  p.target = size(frame.width, frame.height);
  p.marchSize = size((width + interleave - 1) / interleave, (height + interleave - 1) / interleave);
  const int turn = frames % (interleave * interleave), round = frames / (interleave * interleave);
  const int* at = interleave == 4 ? kOrder4[turn] : (interleave == 2 ? kOrder2[turn] : kOrder2[0]);
  // The R2 sequence (Roberts 2018) moves the sample inside its pixel from round to round.
  const double shiftX = quality.jitter ? fraction(0.5 + 0.7548776662 * round) - 0.5 : 0.0;
  const double shiftY = quality.jitter ? fraction(0.5 + 0.5698402910 * round) - 0.5 : 0.0;
  p.offset = glm::vec4(at[0], at[1], shiftX, shiftY);
  p.timing = glm::vec4(static_cast<float>(frames % 4096), 1.0f, 0.0f, interleave);
  p.depthInfo = glm::vec4(frame.depthTexture ? 1.0f : 0.0f, projection[2][2], projection[3][2],
                          frame.depthRange == DepthRange::zeroToOne ? 1.0f : 0.0f);
  p.wind.w = frame.preExposure;
  p.options = glm::vec4(1.0f, quality.jitter ? 1.0f : 0.0f, behindClouds(frame), pixelAngle);
  return p;
}

glm::dvec2 travelled(const FrameParams& params, const FrameParams& last) {
  if (params.camera.forward.w > 0.5f || last.camera.forward.w > 0.5f) return glm::dvec2(0.0);
  const auto onGrid = [&](const FrameParams& of) {
    const glm::vec4 clip = of.clipFromWorld * glm::vec4(glm::vec3(params.camera.forward), 0.0f);
    return clip.w > 0.0f ? glm::dvec2(clip) / static_cast<double>(clip.w) + 2.0 * glm::dvec2(of.lock) : glm::dvec2(1e9);
  };
  const glm::dvec2 way = 0.5 * (onGrid(params) - onGrid(last)) * glm::dvec2(params.size);
  return glm::length(way) < static_cast<double>(params.size.x) ? way : glm::dvec2(0.0);
}

void lockGrid(FrameParams& params, const glm::dvec2& travel) {
  const glm::dvec2 whole = glm::round(travel);
  const glm::vec2 lock = glm::vec2(travel - whole) * glm::vec2(params.size.z, params.size.w);
  params.lock = glm::vec4(lock, 0.0f, 0.0f);
  params.camera.forward += 2.0f * (lock.x * params.camera.right + lock.y * params.camera.above);
  const glm::mat4 rows = glm::transpose(params.clipFromWorld);
  params.clipFromWorld =
      glm::transpose(glm::mat4(rows[0] - 2.0f * lock.x * rows[3], rows[1] - 2.0f * lock.y * rows[3], rows[2], rows[3]));
  const double block = params.timing.w;
  for (int axis = 0; axis < 2; ++axis) {
    const double at = params.offset[axis] + whole[axis];
    params.offset[axis] = static_cast<float>(at - block * std::floor(at / block));
  }
}

void setHistory(FrameParams& params, const FrameParams* last, const glm::dvec3& moved, const glm::dvec2& drifted,
                History history, float share) {
  params.timing.y = share;
  const bool sameKind =
      last && last->camera.forward.w == params.camera.forward.w && last->camera.angles == params.camera.angles;
  params.timing.z = sameKind ? static_cast<float>(history) : 0.0f;
  // A picture that moves holds samples of two rounds side by side, and the shift between them is a comb along the thin
  // level edges of far clouds.
  if (history == History::moved || history == History::changed)
    params.offset.z *= kMovingShift, params.offset.w *= kMovingShift;
  params.wind = glm::vec4(glm::vec3(glm::dvec3(drifted, 0.0)), params.wind.w);
  if (!last) return;
  // A position relative to this eye, made relative to the last one, then projected as it was then.
  glm::mat4 shift(1.0f);
  shift[3] = glm::vec4(glm::vec3(moved), 1.0f);
  const glm::mat4 rows = glm::transpose(last->clipFromWorld * shift);
  params.previous0 = rows[0];
  params.previous1 = rows[1];
  params.previous3 = rows[3];
}

bool sameView(const FrameParams& a, const FrameParams& b) {
  return a.clipFromWorld == b.clipFromWorld && a.camera.angles == b.camera.angles && a.size == b.size &&
         a.wind.w == b.wind.w;
}

bool mayShow(const FrameParams& params, const glm::vec3& direction, float radius) {
  if (params.camera.forward.w > 0.5f) return true;
  const glm::vec3 forward(params.camera.forward), right(params.camera.right), above(params.camera.above);
  const auto angleTo = [&](const glm::vec3& way) {
    return std::acos(std::clamp(glm::dot(glm::normalize(way), glm::normalize(forward)), -1.0f, 1.0f));
  };
  float corner = 0.0f;
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f}) corner = std::max(corner, angleTo(forward + x * right + y * above));
  return angleTo(direction) < corner + radius;
}

Frame frameOf(const Camera& camera, int width, int height) {
  const glm::dmat3 axes = cameraAxes(camera);
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.position = camera.position;
  frame.mapping = camera.projection;
  frame.view = glm::mat4(glm::transpose(glm::dmat3(axes[0], axes[1], -axes[2])));
  const float f = 1.0f / std::tan(0.5f * camera.fov);
  // Infinite far plane, depth reversed: the depth of a point is near / distance.
  frame.projection = glm::mat4(0.0f);
  frame.projection[0][0] = f;
  frame.projection[1][1] = f * static_cast<float>(width) / static_cast<float>(height);
  frame.projection[2][3] = -1.0f;
  frame.projection[3][2] = 0.1f;
  frame.depthRange = DepthRange::zeroToOne;
  return frame;
}

Frame tileOf(const Frame& whole, int x, int y, int width, int height) {
  Frame tile = whole;
  tile.width = width;
  tile.height = height;
  const glm::dvec2 share(static_cast<double>(width) / whole.width, static_cast<double>(height) / whole.height);
  const glm::dvec2 centre((x + 0.5 * width) / whole.width, (y + 0.5 * height) / whole.height);
  if (whole.mapping == Projection::equirectangular) {
    const glm::dvec4& p = whole.panorama;
    tile.panorama = {p.x + (centre.x - 0.5) * p.z, p.y + (centre.y - 0.5) * p.w, p.z * share.x, p.w * share.y};
    return tile;
  }
  // What was ndc `n` becomes (n - middle) / share.
  for (int axis = 0; axis < 2; ++axis) {
    const double middle = 2.0 * centre[axis] - 1.0;
    tile.projection[axis][axis] = static_cast<float>(whole.projection[axis][axis] / share[axis]);
    tile.projection[2][axis] = static_cast<float>((whole.projection[2][axis] + middle) / share[axis]);
  }
  return tile;
}

}  // namespace welkin::realtime
