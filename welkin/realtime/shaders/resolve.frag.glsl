// Resolve pass: the new pixels of this frame and the reprojected old ones become the cloud history. Variants, since the
// software driver runs all of a shader: AVERAGE softens what is old, FIRST_ROUND fills the pixels that have not been
// marched since the view began.
#include "welkin/base/law.glsl"
#include "welkin/realtime/shaders/frame.glsl"

uniform sampler2D uMarched;
uniform sampler2D uMarchedDepth;
uniform sampler2D uHistory;
uniform sampler2D uHostDepth;

layout(location = 0) out vec4 oColour;

// By which old pixels may leave the range of the new ones round them, in shares of it, for detail between these: by the
// first, and by the second over what moves against the far in a frame, in pixels: nothing else can uncover or cover,
// as long as the sky stays the same and the host's geometry has no edge there.
const float kMargin = 0.25, kMarginMoved = 0.25;

// Histories below this enum are kept in that range. In the first round, except at edges of the host's geometry, it would
// leave its own pattern: four pixels are no range for the mean of more.
#ifdef FIRST_ROUND
const float kClipped = 1.5;
#else
const float kClipped = 2.5;
#endif

vec4 historyAt(vec2 uv) {
#ifndef AVERAGE
  return textureLod(uHistory, uv, 0.0);
#else
  vec4 sum = vec4(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) sum += textureLod(uHistory, uv + vec2(x, y) * uSize.zw, 0.0);
  return sum * (1.0 / 9.0);
#endif
}

// Along the view, m, at a pixel of the history.
float hostOf(vec2 pixel) {
  return uDepthInfo.x < 0.5 ? 1e8 : hostAlongView(uHostDepth, (pixel + 0.5) * uSize.zw + uLock.xy);
}

// Of a direction in the panorama's axes.
vec3 panoramaUv(vec3 eye) {
  float turn = atan(eye.x, eye.z) - uCamera.angles.x;
  turn -= 6.28318531 * floor(turn / 6.28318531 + 0.5);
  float rise = atan(eye.y, length(eye.xz)) - uCamera.angles.y;
  return vec3(vec2(turn, rise) / uCamera.angles.zw * 0.5 + 0.5, 1.0);
}

// Where the last picture showed a point relative to the eye, or with w = 0 a direction: in [0, 1]; z is not positive
// where it did not.
vec3 shownAt(vec4 p) {
  vec3 clip = vec3(dot(uPrevious0, p), dot(uPrevious1, p), dot(uPrevious3, p));
  return uCamera.forward.w > 0.5 ? panoramaUv(clip) : vec3(clip.xy / max(clip.z, 1e-6) * 0.5 + 0.5, clip.z);
}

#ifdef FIRST_ROUND
// The order in which a block's pixels are marched (frame_params.cpp), and the frame in which a pixel is for the first time,
// by the grid as it stands now.
ivec2 placeOf2(int turn) { return ivec2(turn == 1 || turn == 2, turn & 1); }
int turnOf2(ivec2 p) { return p.x == p.y ? p.x : 3 - p.x; }
int turnOf(ivec2 pixel) {
  int now = int(uTiming.x), edge = int(uTiming.w);
  ivec2 first = ivec2(uOffset.xy) - (edge > 3 ? placeOf2(now >> 2) + 2 * placeOf2(now & 3) : placeOf2(now));
  ivec2 p = (pixel - first + edge) % edge;
  return edge > 3 ? 4 * turnOf2(p & 1) + turnOf2(p >> 1) : turnOf2(p);
}

// A pixel that no frame has marched yet: the mean of those round it that have been, by a bell as wide as they are apart.
// `back`: from a pixel to where the history shows the same, in pixels.
vec4 filled(ivec2 pixel, vec2 back) {
  int now = int(uTiming.x), reach = int(uTiming.w) - 1;
  float narrow = 2.0 * (uTiming.x + 1.0) / (uTiming.w * uTiming.w);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 at = pixel + ivec2(x, y);
      int turn = turnOf(max(at, 0));
      if (turn > now || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(uSize.xy)))) continue;
      float weight = exp(-narrow * float(x * x + y * y));
      sum += weight * (turn == now ? texelFetch(uMarched, at / int(uTiming.w), 0)
                                   : textureLod(uHistory, (vec2(at) + 0.5 + back) * uSize.zw, 0.0));
      weights += weight;
    }
  return sum / weights;
}
#endif

void main() {
  vec2 pixel = floor(gl_FragCoord.xy);
  ivec2 block = ivec2(pixel / uTiming.w);
  bool marched = all(lessThan(abs(pixel - vec2(block) * uTiming.w - uOffset.xy), vec2(0.5)));
  // Where the march target stands for this pixel: its texel centres lie at the marched pixels.
  vec2 place = (pixel - uOffset.xy) / uTiming.w;
  // The four marched pixels around, as far as they tell what stands before the host's picture here: what they show of is
  // as far away as the nearest of them, and what they do not show has gone.
  ivec2 corner = ivec2(floor(place)), last = ivec2(uMarchSize.xy) - 1;
  vec2 share = place - vec2(corner);
  float own = hostOf(pixel), depth = 1e9, weights = 0.0;
  vec4 fresh = vec4(0.0), low = vec4(1e9), high = vec4(-1e9);
  bool edge = false;
  for (int i = 0; i < 4; ++i) {
    ivec2 side = ivec2(i & 1, i >> 1), at = clamp(corner + side, ivec2(0), last);
    vec2 part = mix(1.0 - share, share, vec2(side));
    vec4 colour = texelFetch(uMarched, at, 0);
    float weight = part.x * part.y + 1e-3;
    float distance_ = texelFetch(uMarchedDepth, at, 0).x;
    if (tellsOf(own, hostOf(vec2(at) * uTiming.w + uOffset.xy), colour.a, 4.0 * distance_)) {
      low = min(low, colour);
      high = max(high, colour);
      depth = min(depth, distance_);
    } else {
      weight *= 1e-6;
      edge = true;
    }
    // As far away as marched pixels may be, on every side.
    vec2 beside = (i < 2 ? vec2(1.0, 0.0) : vec2(0.0, 1.0)) * (float(2 * (i & 1) - 1) * uTiming.w);
    edge = edge || !tellsOf(own, hostOf(pixel + beside), colour.a, 4.0 * distance_);
    fresh += weight * colour;
    weights += weight;
  }
  fresh = marched ? texelFetch(uMarched, block, 0) : fresh / weights;
  if (depth > 1e8) {
    low = high = fresh;
    depth = texelFetch(uMarchedDepth, clamp(corner, ivec2(0), last), 0).x;
  }
  vec2 uv = (pixel + 0.5) * uSize.zw;
  vec3 dir = normalize(rayAt(uv * 2.0 - 1.0));
  vec3 shown = shownAt(vec4(dir * (depth * 4.0) - uWind.xyz, 1.0));
#ifdef FIRST_ROUND
  if (uTiming.z > 3.5) shown = vec3(uv, 1.0);
#endif
  vec2 before = shown.xy;
  bool known = uTiming.z > 0.5 && shown.z > 0.0 && all(greaterThan(before, vec2(0.0))) && all(lessThan(before, vec2(1.0)));
#ifdef FIRST_ROUND
  ivec2 at = ivec2(pixel);
  vec4 old = turnOf(at) < int(uTiming.x) ? historyAt(before) : filled(at, before * uSize.xy - pixel - 0.5);
#else
  vec4 old = historyAt(before);
#endif
  if (uTiming.z < (edge ? 2.5 : kClipped)) {
    float moved = length((shownAt(vec4(dir, 0.0)).xy - before) * uSize.xy);
    vec4 margin = (kMargin + (uTiming.z > 1.5 && !edge ? kMarginMoved / max(moved, 1e-3) : 0.0)) * (high - low);
    // Over a host's picture, opacity that it gains comes with the new light, and what it loses takes its own along.
    float left = clamp(old.a, low.a - margin.a, high.a + margin.a), gain = old.a - left;
    if (uOptions.z != 1.0)
      old.rgb = gain > 0.0 ? old.rgb + fresh.rgb * (gain / max(1.0 - fresh.a, gain))
                           : old.rgb * ((1.0 - left) / max(1.0 - old.a, 1e-4));
    // Toward the middle of the range, all channels alike: each on its own would change the hue.
    vec3 middle = 0.5 * (low.rgb + high.rgb), away = old.rgb - middle;
    vec3 far = abs(away) / max(0.5 * (high.rgb - low.rgb) + margin.rgb, vec3(1e-6));
    old = vec4(middle + away / max(max(far.x, max(far.y, far.z)), 1.0), left);
  }
  vec4 kept = known ? old : fresh;
  oColour = marched ? mix(kept, fresh, known ? uTiming.y : 1.0) : kept;
}
