// Light volume, at the end: clear cells hold half the flux that comes down from the cloud above them, so that the lowest
// slice tells what lies below the clouds how much that is (lookupBelow() in light_volume.glsl). Out of a cell's middle the
// light passes half of its depth and the cloud's surface (exchange()).
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;
uniform sampler2D uAbove;  // the slice above
uniform sampler2D uFaces;  // light_faces.frag.glsl

layout(location = 0) out vec4 oLight;

float densityAt(ivec3 cell) { return texelFetch(uDensity, cell, 0).x; }
vec2 leaving(vec2 light, float density) { return light / (1.0 + 0.75 * kReduced * uSlice.y * density); }

void main() {
  ivec3 cell = ivec3(ivec2(gl_FragCoord.xy), int(uSlice.z));
  vec2 light = texelFetch(uDiffuse, cell, 0).xy;
  float own = densityAt(cell);
  if (cell.z + 1 < int(uVolume.slices)) {
    vec2 above = leaving(texelFetch(uAbove, cell.xy, 0).xy, densityAt(cell + ivec3(0, 0, 1)));
    light = mix(light, above, exp(-kClearing * own));
  }
  if (cell.z == 0) {
    // The ground sees the clouds' sides too, the lower the more: as light_sides.frag.glsl, but for level ground.
    light = leaving(light, own);
    vec3 met = vec3(0.0);
    for (int s = 0; s < int(uVolume.slices); ++s) {
      vec3 face = texelFetch(uFaces, ivec2(s, 0), 0).xyz;
      met += vec3(face.xy * face.z, face.z);
    }
    light = mix(0.5 * met.xy / max(met.z, 1e-4), light, pow(1.0 + 0.95 * met.z, -1.5));
  }
  oLight = vec4(light, 0.0, 1.0);
}
