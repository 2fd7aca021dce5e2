// Light volume: what a slice of a level that has moved starts from: what it knew already, elsewhere the coarser level.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;
uniform vec4 uBefore;  // the level before it moved, xy: centre relative to the anchor, z: edge, m; w: 0 when there is none
uniform vec4 uCoarser; // the same of the coarser level, w: its number
uniform int uFirst;    // first slice of the level; that of the coarser one follows it

in vec2 vUv;
layout(location = 0) out vec4 oLight;

void main() {
  vec2 p = uLevel.xy + (vUv - 0.5) * uLevel.z;
  vec2 before = (p - uBefore.xy) / uBefore.z + 0.5, coarser = (p - uCoarser.xy) / uCoarser.z + 0.5;
  float depth = 1.0 / float(textureSize(uDiffuse, 0).z), slice = float(uFirst) + uSlice.z + 0.5;
  vec2 light = vec2(0.1, 0.5);
  if (uCoarser.w > 0.5) light = textureLod(uDiffuse, vec3(coarser, (slice + uVolume.slices) * depth), 0.0).xy;
  if (uBefore.w > 0.5 && all(lessThan(abs(before - 0.5), vec2(0.5))))
    light = textureLod(uDiffuse, vec3(before, slice * depth), 0.0).xy;
  oLight = vec4(light, 0.0, 1.0);
}
