// One slice of the aerial volumes: carries the running sums of the slice before it on to `uSlice`.
#include "welkin/realtime/shaders/sky_common.glsl"
uniform sampler2D uTransmittance, uMultiScattering, uInscatterBefore, uThroughBefore;
uniform int uSlice;
layout(location = 0) out vec4 oInscatter;
layout(location = 1) out vec4 oThrough;
layout(location = 2) out vec4 oInscatterSum;
layout(location = 3) out vec4 oThroughSum;
void main() {
  vec3 inscatter = vec3(0.0), through = vec3(1.0);
  if (uSlice > 0) {
    ivec2 p = ivec2(gl_FragCoord.xy);
    inscatter = texelFetch(uInscatterBefore, p, 0).xyz;
    through = texelFetch(uThroughBefore, p, 0).xyz;
  }
  aerialTexel(uTransmittance, uMultiScattering, uAir, vUv, uSlice, inscatter, through);
  oInscatter = vec4(aerialStored(uAir, uSlice, inscatter), 1.0);
  oInscatterSum = vec4(inscatter, 1.0);
  oThrough = oThroughSum = vec4(through, 1.0);
}
