// Composite pass: the history over the sky, or over the host's picture by blending (one, source alpha). Variants: NIGHT
// draws the moon, STARS besides it what else shines at night.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#ifdef NIGHT
#include "welkin/atmosphere/night.glsl"
#endif
#include "welkin/realtime/shaders/frame.glsl"

layout(std140) uniform Air { AtmosphereParams uAir; };
#ifdef NIGHT
layout(std140) uniform Night { NightParams uNight; };
#endif
uniform sampler2D uHistory;
uniform sampler2D uSkyView;
uniform sampler2D uTransmittance;
uniform sampler2D uHostDepth;

in vec2 vUv;
layout(location = 0) out vec4 oColour;

void main() {
  vec4 cloud = textureLod(uHistory, vUv, 0.0);
  cloud.rgb *= uOptions.x;
  vec3 ray = rayAt(vUv * 2.0 - 1.0);
  bool open = hostDistance(uHostDepth, vUv, ray) > 5e7;
  if (uOptions.z > 2.5) {
    oColour = vec4(cloud.aaa, 0.0);
  } else if (uOptions.z > 0.5 && open) {
    vec3 dir = normalize(ray);
    vec3 behind = lookupSky(uSkyView, uAir, dir);
    vec3 outside = vec3(0.0);
    if (uOptions.z > 1.5) outside = sunDisc(uAir, dir, uOptions.w);
#ifdef NIGHT
    outside += moonDisc(uNight, dir, uOptions.w);
#endif
#ifdef STARS
    outside += starlight(uNight, dir, uOptions.w);
#endif
    behind += outside * lookupTransmittanceToSun(uTransmittance, uAir, uAir.cameraAltitude, dir.z);
    // Clouds shade the air behind them, which makes their own share negative there.
    oColour = vec4(max(cloud.rgb + cloud.a * min(behind * uWind.w * uOptions.x, vec3(60000.0)), vec3(0.0)), 0.0);
  } else {
    oColour = cloud;
  }
}
