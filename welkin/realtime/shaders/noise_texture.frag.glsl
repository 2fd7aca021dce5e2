// One slice of a noise texture. NOISE_PARAMS names the law's parameter struct, NOISE_TEXEL(uvw, p) its texel as a vec4.
#include "welkin/base/law.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/perlin.glsl"
#include "welkin/noise/worley.glsl"
#include "welkin/noise/fbm.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/noise/gamma.glsl"
#include "welkin/noise/perlin_worley.glsl"
#include "welkin/noise/curl.glsl"
#include "welkin/noise/textures.glsl"

layout(std140) uniform Noise { NOISE_PARAMS uParams; };
uniform vec3 uSize;
uniform float uSlice;

out vec4 oTexel;

void main() { oTexel = NOISE_TEXEL(vec3(gl_FragCoord.xy, uSlice + 0.5) / uSize, uParams); }
