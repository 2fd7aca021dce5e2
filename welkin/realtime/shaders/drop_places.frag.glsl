// Where drops and flakes stand in the picture and what they look like, a texel each, so that it is worked out once and
// not for every corner. Variants: PANORAMA, and FLAKES where there are any.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/precipitation/precipitation.glsl"
#include "welkin/realtime/drops.glsl"
#include "welkin/realtime/shaders/frame.glsl"

layout(std140) uniform Drops {
  DropParams uDrops;
  DropClass uClass[DROP_LEVELS * DROP_CLASSES];
};
uniform highp sampler2D uCells;     // xyz: number of the cell from the eye's, w: level
uniform highp sampler2D uRainMap;   // x: mm/h
uniform highp sampler2D uRainLight; // sunlight at the eye in klx, light from all sides in kcd/m^2

layout(location = 0) out vec4 oPlace;  // middle and half axis of the ellipse that a drop draws while the shutter is open, px
layout(location = 1) out vec4 oLight;  // in the target's units, w: opacity in the middle
layout(location = 2) out vec2 oSize;   // breadth over length, distance along the view in m

const float kThinnest = 0.75;  // px, half of what is drawn at the least

// Pixels of the target, and the distance along the view in m.
vec3 shownAt(vec3 p) {
  vec4 q = vec4(p, 1.0);
  vec3 clip = vec3(dot(uDrops.clip0, q), dot(uDrops.clip1, q), dot(uDrops.clip3, q));
#ifdef PANORAMA
  float turn = atan(clip.x, clip.z) - uCamera.angles.x;
  turn -= 6.28318531 * floor(turn / 6.28318531 + 0.5);
  vec2 uv = vec2(turn, atan(clip.y, length(clip.xz)) - uCamera.angles.y) / uCamera.angles.zw * 0.5 + 0.5;
  return vec3(uv * uTarget.xy, 1.0);
#else
  return vec3((clip.xy / max(clip.z, 1e-4) * 0.5 + 0.5) * uTarget.xy, clip.z);
#endif
}

void main() {
  // Those that are not drawn have no size.
  oPlace = vec4(0.5 * uTarget.xy, 0.0, 0.0);
  oLight = vec4(0.0);
  oSize = vec2(0.0);
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int number = texel.x % DROPS_PER_CELL;
  vec4 cell = texelFetch(uCells, ivec2(texel.x / DROPS_PER_CELL, texel.y), 0);
  int level = int(cell.w + 0.5);
  DropClass kind = uClass[level * DROP_CLASSES + number % DROP_CLASSES];
  uint h0 = hashCell3(int(cell.x) + kind.cellX, int(cell.y) + kind.cellY, int(cell.z) + kind.cellZ,
                      uint(number + DROPS_PER_CELL * level));
  uint h1 = nextHash(h0), h2 = nextHash(h1), h3 = nextHash(h2);
  vec3 p = particlePlace(cell.xyz, kind.start.xyz, vec3(unitFromHash(h0), unitFromHash(h1), unitFromHash(h2)),
                         uDrops.edges[level]);
  float chance = unitFromHash(h3), diameter = kind.start.w;
  float shownArea = 0.785398163 * diameter * diameter * exp2(3.0 * float(level));
  float lit = 1.0;  // flakes turn sides of their own to the light
#ifdef FLAKES
  if (kind.flake == 1) {
    uint h4 = nextHash(h3);
    float phase = unitFromHash(h4), turn = fract(uDrops.turns * floor(8.0 + 24.0 * chance));
    p += flutter(turn, phase, 6.0 * diameter);
    shownArea *= tumbled(turn, phase);
    lit = 0.5 + unitFromHash(nextHash(h4));
  }
#endif
  float distance_ = length(p), far = uDrops.reaches[level];
  float share = 1.0 - smoothstep(kRainFade * far, far, distance_);
  if (level > 0) share *= smoothstep(0.5 * kRainFade * far, 0.5 * far, distance_);
  // As many as the rate of this place asks for.
  float rate = textureLod(uRainMap, p.xy * uDrops.mapScale + 0.5, 0.0).x;
  float there = rate > 1e-3 ? pow(rate / uDrops.rate, 0.6) : 0.0;
  if (share <= 0.0 || chance >= there || distance_ < 0.05 || uDrops.up.w + dot(uDrops.up.xyz, p) < 0.0) return;

  vec3 half_ = kind.velocity.xyz * (0.5 * uDrops.shutter);
  vec3 a = shownAt(p - half_), b = shownAt(p + half_);
  if (min(a.z, b.z) < 0.05) return;
  float pixels = 1.0 / (distance_ * uOptions.w);  // of a metre there
  float across_ = max(0.5 * diameter * pixels, kThinnest);
  vec2 middle = 0.5 * (a.xy + b.xy), way = 0.5 * (b.xy - a.xy);
  float moved = length(way), along = moved + across_;
  vec2 beyond = abs(middle - 0.5 * uTarget.xy) - 0.5 * uTarget.xy;
  if (along > 0.5 * uTarget.x || max(beyond.x, beyond.y) > 2.0 * along) return;
  oPlace = vec4(middle, (moved > 1e-3 ? way / moved : vec2(0.0, 1.0)) * along);
  oSize = vec2(across_ / along, 0.5 * (a.z + b.z));
  float phase = phaseHenyeyGreenstein(dot(p, uDrops.sun.xyz) / distance_,
                                      kind.flake == 1 ? kSnowAsymmetry : kRainAsymmetry);
  vec3 source = texelFetch(uRainLight, ivec2(0), 0).rgb * phase + texelFetch(uRainLight, ivec2(1, 0), 0).rgb;
  oLight = vec4(uOptions.z > 2.5 ? vec3(0.0) : source * (lit * uDrops.sun.w),
                share * streakOpacity(shownArea * pixels * pixels, along, across_));
}
