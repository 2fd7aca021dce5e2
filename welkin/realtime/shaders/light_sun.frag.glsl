// Light volume, second pass: optical depth toward the sun of one slice, from the slice above it: each point adds what lies
// between it and the slice above.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler2D uAbove;  // the slice above
uniform sampler3D uSun;    // coarser levels, finished before this one
uniform vec4 uSunward;     // direction toward the sun; w: least sine of its height
uniform vec2 uWay;         // altitude of the slice above; steps to it
uniform int uTop;          // 1 for the topmost slice

in vec2 vUv;
layout(location = 0) out vec4 oTau;

float above(vec2 p) {
  vec2 uv = (p - uLevel.xy) / uLevel.z + 0.5;
  if (uCoarsest == 1 || all(lessThan(abs(uv - 0.5), vec2(0.5)))) return textureLod(uAbove, uv, 0.0).x;
  vec3 q = vec3(p, uWay.x);
  return textureLod(uSun, lightVolumePlace(lightVolumeLevel(q, 0.0, uVolume), q, uVolume), 0.0).x;
}

void main() {
  vec2 p = uLevel.xy + (vUv - 0.5) * uLevel.z;
  float rise = uWay.x - uSlice.x;
  // Far away the ground has turned away from the anchor's horizon.
  float slant = max(uSunward.z + dot(uSunward.xy, p) * uVolume.shift.z, uSunward.w);
  vec2 shift = uSunward.xy * (rise / slant);
  float tau = 0.0;
  int steps = int(uWay.y);
  for (int i = 0; i < steps; ++i) {
    float share = (float(i) + 0.5) / uWay.y;
    tau += density(vUv + shift * (share / uLevel.z), uSlice.z + share);
  }
  tau *= length(vec3(shift, rise)) / uWay.y;
  if (uTop == 0) tau += above(p + shift);
  oTau = vec4(min(tau, 60000.0), 0.0, 0.0, 1.0);
}
