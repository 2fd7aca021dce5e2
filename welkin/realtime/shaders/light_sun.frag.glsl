// Light volume, second pass: optical depth toward the sun, by doubling. At first every cell knows that of a short step;
// then, again and again, of twice as far, from itself and from where its way has ended. The last time it adds what the
// coarser levels know of the rest, and the sheets above.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uSteps;  // optical depths of the steps so far, this level's cells
uniform sampler3D uSun;    // coarser levels, finished before this one
uniform vec4 uSunward;     // direction toward the sun; w: least sine of its height
uniform vec2 uWay;         // length of the way that uSteps knows, 0 at first; of the first step; m
uniform int uLast;         // 1 the last time
uniform sampler2D uSheets;    // light_sheets.frag.glsl
uniform vec4 uSheetHeights;   // m, far below where there is no sheet

in vec2 vUv;
layout(location = 0) out vec4 oTau;

const int kSamples = 2;  // of the first step, which is no longer than a cell

// Texture coordinates in this level of a point; outside of it nothing is known.
vec3 placeOf(vec3 q) {
  return vec3((q.xy - uLevel.xy) / uLevel.z + 0.5, (q.z - uVolume.bottom) * uVolume.inverseHeight);
}
bool inside(vec3 place) { return all(lessThan(abs(place - 0.5), vec3(0.5))); }

void main() {
  vec3 q = vec3(uLevel.xy + (vUv - 0.5) * uLevel.z, uSlice.x);
  // Far away the ground has turned away from the anchor's horizon.
  float slant = max(uSunward.z + dot(uSunward.xy, q.xy) * uVolume.shift.z, uSunward.w);
  vec3 way = normalize(vec3(uSunward.xy, slant));
  float tau = 0.0;
  if (uWay.x == 0.0) {
    for (int i = 0; i < kSamples; ++i) {
      vec3 place = placeOf(q + way * (uWay.y * (float(i) + 0.5) / float(kSamples)));
      if (inside(place)) tau += textureLod(uDensity, place, 0.0).y * uWay.y / float(kSamples);
    }
  } else {
    vec3 place = placeOf(q + way * uWay.x);
    tau = texelFetch(uSteps, ivec3(ivec2(gl_FragCoord.xy), int(uSlice.z)), 0).x;
    if (inside(place)) tau += textureLod(uSteps, place, 0.0).x;
  }
  if (uLast == 1 && uCoarsest == 0) {
    vec2 side = (mix(vec2(-0.5), vec2(0.5), vec2(greaterThan(way.xy, vec2(0.0)))) * uLevel.z + uLevel.xy - q.xy) /
                mix(way.xy, vec2(1e-6), vec2(lessThan(abs(way.xy), vec2(1e-6))));
    vec3 leave = q + way * min(abs(side.x), abs(side.y));
    if (placeOf(leave).z < 1.0)
      tau += textureLod(uSun, lightVolumePlace(lightVolumeLevel(leave, 0.0, uVolume), leave, uVolume), 0.0).x;
  }
  if (uLast == 1) {
    // Where the way goes through the level's top; where it leaves by a side, the coarser level knows the sheets.
    float up = (uVolume.bottom + 1.0 / uVolume.inverseHeight - q.z) / way.z;
    vec2 top = placeOf(q + way * up).xy;
    if (uCoarsest == 1 || all(lessThan(abs(top - 0.5), vec2(0.5))))
      tau += dot(mix(vec4(0.0), textureLod(uSheets, top, 0.0), greaterThan(uSheetHeights, vec4(q.z))), vec4(1.0));
  }
  oTau = vec4(min(tau, 60000.0), 0.0, 0.0, 1.0);
}
