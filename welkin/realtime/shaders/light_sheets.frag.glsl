// Light volume: what the high sheets take from sunlight that goes through the top of a level, as optical depths of cloud
// droplets toward the sun, a sheet in each channel.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"

uniform vec4 uLevel;    // xy: centre relative to the anchor, z: edge, m
uniform vec4 uSunward;  // direction toward the sun; w: least sine of its height
uniform float uTop;     // altitude of the level's top, m

in vec2 vUv;
layout(location = 0) out vec4 oDepth;

void main() {
  vec2 p = uLevel.xy + (vUv - 0.5) * uLevel.z;
  float slant = max(uSunward.z + dot(uSunward.xy, p) * uVolume.shift.z, uSunward.w);
  vec4 depth = vec4(0.0);
  for (int i = 0; i < SHEET_COUNT; ++i)
    depth[i] = sheetDepthToward(p, uSheet[i].height - uTop, uSunward.xyz, slant, uVolume.shift.z, uSheet[i]);
  oDepth = depth / kReduced;
}
