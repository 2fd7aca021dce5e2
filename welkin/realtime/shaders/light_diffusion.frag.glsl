// Light volume, third pass: a step of relaxation toward the balance of diffusing light. Columns are solved exactly, with
// their neighbours' light as it was. On the way down, slice by slice, the light of a cell is found as a share P of that of
// the cell below plus Q; on the way up (light_column.frag.glsl) both are put together.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uSun;      // optical depth toward the sun
uniform sampler3D uDiffuse;  // the light that is known so far
uniform sampler2D uShareAbove, uLightAbove;  // P and Q of the slice above
uniform sampler2D uSides;    // light_sides.frag.glsl
uniform float uSideways;     // 0 where nothing is known of neighbours yet: columns stand alone

in vec2 vUv;
layout(location = 0) out vec4 oLight;
layout(location = 1) out vec4 oShare;

// Towers of a cloud light each other: what is clear beside a cell sends it what its own neighbours send there, not the
// mean of the level, unless light goes farther than this (m; by measured error on bench/error.cpp's cumulus).
const float kNearby = 2000.0;

float densityAt(ivec3 cell) { return texelFetch(uDensity, cell, 0).x; }

void main() {
  ivec3 cell = ivec3(ivec2(gl_FragCoord.xy), int(uSlice.z));
  int last = int(uLevel.w) - 1, top = int(uVolume.slices) - 1;
  float own = densityAt(cell);
  float width = uLevel.z / uLevel.w;
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  // Outside are the sky above, the ground below, at the sides the two and other clouds.
  vec2 beside = texelFetch(uSides, ivec2(cell.z, 0), 0).xy;
  for (int i = 0; i < 4; ++i) {
    ivec3 at = ivec3(clamp(cell.xy + ivec2(i == 0 ? -1 : i == 1 ? 1 : 0, i == 2 ? -1 : i == 3 ? 1 : 0), 0, last), cell.z);
    vec2 way = exchange(own, densityAt(at), width);
    way.x *= uSideways;
    vec2 there = texelFetch(uDiffuse, at, 0).xy;
    sum += way.x * there + way.y * mix(beside, there, uSideways * exp(-width / kNearby));
    weights += way.x + way.y;
  }
  vec2 up = exchange(own, cell.z == top ? 0.0 : densityAt(cell + ivec3(0, 0, 1)), uSlice.y);
  sum.y += up.y;
  weights += up.y;
  if (cell.z < top) {
    sum += up.x * texelFetch(uLightAbove, cell.xy, 0).xy;
    weights += up.x * (1.0 - texelFetch(uShareAbove, cell.xy, 0).x);
  }
  vec2 down = exchange(own, cell.z == 0 ? 0.0 : densityAt(cell - ivec3(0, 0, 1)), uSlice.y);
  weights += down.x + down.y;
  // Sunlight that loses its way in this cell: the mean over its depth of an exponential that is known in its middle, with
  // half of the cell before it at least.
  float reduced = kSpreading * texelFetch(uDensity, cell, 0).y;
  float half_ = max(0.5 * reduced * min(width, uSlice.y), 0.01);
  float tau = kSpreading * texelFetch(uSun, cell, 0).x;
  sum.x += reduced * exp(half_ - max(tau, half_)) * (1.0 - exp(-2.0 * half_)) / (2.0 * half_);
  oLight = vec4(sum / weights, 0.0, 1.0);
  oShare = vec4(down.x / weights);
}
