// Light volume, before each step of relaxation, a texel for a slice: what falls on the side of a cloud there through clear
// air (xy): from other clouds' sides, and from the sky between them. Ways that rise or fall by an angle `a` go through
// clear air as exp(-met / tan a) where a level line meets `met` clouds over the height; its mean over a side that a cosine
// weighs is (1 + 3.4 met)^-1.175 within .025.
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler2D uFaces;  // light_faces.frag.glsl

layout(location = 0) out vec4 oSides;

void main() {
  int z = int(gl_FragCoord.x), top = int(uVolume.slices);
  vec3 above = vec3(0.0), below = vec3(0.0);  // light times clouds met, clouds met
  for (int s = 0; s < top; ++s) {
    vec3 face = texelFetch(uFaces, ivec2(s, 0), 0).xyz;
    float half_ = s == z ? 0.5 : 1.0;
    vec3 met = half_ * vec3(face.xy * face.z, face.z);
    if (s >= z) above += met;
    if (s <= z) below += met;
  }
  float through = pow(1.0 + 3.4 * above.z, -1.175), down = pow(1.0 + 3.4 * below.z, -1.175);
  vec2 light = 0.5 * through * vec2(0.0, 1.0) + 0.5 * (1.0 - through) * above.xy / max(above.z, 1e-4) +
               0.5 * (1.0 - down) * below.xy / max(below.z, 1e-4);
  oSides = vec4(light, 0.0, 1.0);
}
