// Light volume, on the way up: light = P * light of the slice below + Q.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;  // Q
uniform sampler3D uShare;    // P
uniform sampler2D uBelow;    // the slice below

layout(location = 0) out vec4 oLight;

void main() {
  ivec3 cell = ivec3(ivec2(gl_FragCoord.xy), int(uSlice.z));
  vec2 light = texelFetch(uDiffuse, cell, 0).xy;
  if (cell.z > 0) light += texelFetch(uShare, cell, 0).x * texelFetch(uBelow, cell.xy, 0).xy;
  oLight = vec4(light, 0.0, 1.0);
}
