// Light volume, at the end: half the flux that leaves the clouds downward. Clear cells pass on what comes from the cloud
// above them. Out of a cell's middle the light passes half of its depth and the cloud's surface (exchange()).
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;
uniform sampler2D uFaces;  // light_faces.frag.glsl

layout(location = 0) out vec4 oLight;

vec2 leaving(vec2 light, float density) { return light / (1.0 + 0.75 * kReduced * uSlice.y * density); }

void main() {
  ivec2 column = ivec2(gl_FragCoord.xy);
  int top = int(uVolume.slices);
  vec2 light = vec2(0.0, 0.5);
  float above = 0.0;
  for (int s = top - 1; s >= 0; --s) {
    float own = texelFetch(uDensity, ivec3(column, s), 0).x;
    light = mix(texelFetch(uDiffuse, ivec3(column, s), 0).xy, leaving(light, above), exp(-kClearing * own));
    above = own;
  }
  // The ground sees the clouds' sides too, the lower the more: as light_sides.frag.glsl, but for level ground.
  vec3 met = vec3(0.0);
  for (int s = 0; s < top; ++s) {
    vec3 face = texelFetch(uFaces, ivec2(s, 0), 0).xyz;
    met += vec3(face.xy * face.z, face.z);
  }
  light = mix(0.5 * met.xy / max(met.z, 1e-4), leaving(light, above), pow(1.0 + 0.95 * met.z, -1.5));
  oLight = vec4(light, 0.0, 1.0);
}
