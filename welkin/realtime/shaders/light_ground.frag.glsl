// Light volume, at the very end: what comes down on level ground from the clouds round its zenith. Of what falls on it
// from a height h, r^2 / (r^2 + h^2) comes from within r: half is from overhead, the rest as at four places at 1.73 h.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler2D uOverhead;  // light_below.frag.glsl
uniform sampler3D uGround;    // this pass's own, a slice for each level
uniform vec4 uCoarser;        // the coarser level, xy: centre relative to the anchor, z: edge, m; w: 0 when there is none

in vec2 vUv;
layout(location = 0) out vec4 oLight;

vec2 above(vec2 uv) {
  if (uCoarser.w < 0.5 || all(lessThan(abs(uv - 0.5), vec2(0.5)))) return textureLod(uOverhead, uv, 0.0).xy;
  vec2 coarser = (uLevel.xy + (uv - 0.5) * uLevel.z - uCoarser.xy) / uCoarser.z + 0.5;
  return textureLod(uGround, vec3(coarser, (uCoarser.w + 0.5) / float(textureSize(uGround, 0).z)), 0.0).xy;
}

void main() {
  float ring = 1.73 * max(uVolume.bottom, 0.0) / uLevel.z;
  vec2 light = 0.5 * above(vUv) + 0.125 * (above(vUv + vec2(ring, 0.0)) + above(vUv - vec2(ring, 0.0)) +
                                           above(vUv + vec2(0.0, ring)) + above(vUv - vec2(0.0, ring)));
  oLight = vec4(light, 0.0, 1.0);
}
