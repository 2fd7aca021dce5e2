// Light at the eye, for the drops round it: sunlight in klx, and light from all sides in kcd/m^2.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"
#include "welkin/realtime/march_params.glsl"

layout(std140) uniform March { MarchParams uMarch; };
uniform sampler2D uTransmittance;
uniform sampler3D uSun;
uniform sampler3D uBelow;

layout(location = 0) out vec4 oLight;

void main() {
  vec3 sun = uAir.sunIrradiance.xyz *
             lookupTransmittanceToSun(uTransmittance, uAir, max(uMarch.planet.altitude, 0.0),
                                      dot(uMarch.sun.xyz, uMarch.planet.up.xyz));
  vec3 q = vec3(0.0, 0.0, uMarch.planet.altitude), around = uMarch.shadedAir.xyz;
#ifdef LIGHT_VOLUME
  vec2 below = lookupBelowAir(q.xy, uVolume, uBelow);
  around *= sun * below.x + uMarch.skyAround.xyz * (3.14159265 * below.y);
  sun *= exp(-kReduced * lookupSunDepth(q, 0.0, uVolume, uSun));
#else
  sun *= uMarch.rain.w;
#endif
  oLight = vec4(gl_FragCoord.x < 1.0 ? sun : around, 1.0);
}
