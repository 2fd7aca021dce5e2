// Light volume, before each step of relaxation, a texel for a slice: what the sides of its clouds send into the clear air
// between them, in the mean over the level (xy), and how many of them a level line meets on a way as long as the slice is
// high (z).
#include "welkin/realtime/shaders/light_level.glsl"

uniform sampler3D uDiffuse;  // the light that is known so far
uniform sampler2D uSides;    // light_sides.frag.glsl; of the step before, if there was one
uniform float uKnown;        // 1 if so

layout(location = 0) out vec4 oFaces;

const int kAcross = 16;  // cells that are asked, along an edge of the level

void main() {
  int z = int(gl_FragCoord.x), cells = int(uLevel.w);
  float width = uLevel.z / uLevel.w;
  vec2 falling = mix(vec2(0.0, 0.5), texelFetch(uSides, ivec2(z, 0), 0).xy, uKnown), light = vec2(0.0);
  float faces = 0.0, air = 0.0;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    ivec3 a = ivec3((2 * ivec2(i % kAcross, i / kAcross) + 1) * cells / (2 * kAcross), z), b = a + ivec3(1, 0, 0);
    float own = texelFetch(uDensity, a, 0).x, other = texelFetch(uDensity, b, 0).x;
    float clear = exp(-kClearing * own), clearBeside = exp(-kClearing * other);
    float here = (1.0 - clear) * clearBeside, there = (1.0 - clearBeside) * clear;
    // Through half a cell and the surface, which sends back what it does not let in.
    vec2 share = 1.0 / (0.5 + 0.375 * kReduced * width * vec2(own, other));
    light += here * (falling + share.x * (texelFetch(uDiffuse, a, 0).xy - falling)) +
             there * (falling + share.y * (texelFetch(uDiffuse, b, 0).xy - falling));
    faces += here + there;
    air += 0.5 * (clear + clearBeside);
  }
  // Where there is next to no air between them, nothing of it is seen.
  float met = 0.5 * faces / (air + 0.02 * float(kAcross * kAcross)) * uSlice.y / width;
  oFaces = vec4(max(light, vec2(0.0)) / max(faces, 1e-4), met, 1.0);
}
