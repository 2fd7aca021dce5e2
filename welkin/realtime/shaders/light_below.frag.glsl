// Light volume, at the end: clear cells hold the light that comes down from the cloud above them, so that the lowest slice
// tells what lies below the clouds how much that is.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;
uniform sampler2D uAbove;  // the slice above

layout(location = 0) out vec4 oLight;

void main() {
  ivec3 cell = ivec3(ivec2(gl_FragCoord.xy), int(uSlice.z));
  vec2 light = texelFetch(uDiffuse, cell, 0).xy;
  float clear = exp(-kClearing * texelFetch(uDensity, cell, 0).x);
  if (cell.z + 1 < int(uVolume.slices)) light = mix(light, texelFetch(uAbove, cell.xy, 0).xy, clear);
  oLight = vec4(light, 0.0, 1.0);
}
