// Composite pass: the history over the sky, or over the host's picture by blending (one, source alpha). The history has
// the sky in it where no geometry of the host hides it. Variants, since the software driver runs all of a shader: SKY
// adds the sky here, up to the edges of the host's geometry; DEPTH keeps clouds behind what the host has drawn; DISC,
// MOON and STARS add what is sharper than the history.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#if defined(MOON) || defined(STARS)
#include "welkin/atmosphere/night.glsl"
layout(std140) uniform Night { NightParams uNight; };
#endif
#include "welkin/realtime/shaders/frame.glsl"

layout(std140) uniform Air { AtmosphereParams uAir; };
uniform sampler2D uHistory;
uniform sampler2D uSkyView;
uniform sampler2D uTransmittance;
uniform sampler2D uHostDepth;
uniform sampler2D uMarchedDepth;

// What is nearer than this share of the clouds' distance has next to none before it, in fog too, and within so many m no
// rain to speak of.
const float kBefore = 0.2, kNear = 100.0;

in vec2 vUv;
layout(location = 0) out vec4 oColour;

#ifdef DEPTH
// The history between its pixels, of those that tell what stands before this one of the target; `clouds`: their distance.
vec4 historyBefore(vec2 uv, float own, float clouds) {
  vec2 place = uv * uSize.xy - 0.5, share = fract(place);
  ivec2 corner = ivec2(floor(place)), last = ivec2(uSize.xy) - 1;
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 side = ivec2(i & 1, i >> 1), at = clamp(corner + side, ivec2(0), last);
    vec2 part = mix(1.0 - share, share, vec2(side));
    float there = hostAlongView(uHostDepth, (vec2(at) + 0.5) * uSize.zw + uLock.xy);
    vec4 cloud = texelFetch(uHistory, at, 0);
    float weight = part.x * part.y * (tellsOf(own, there, cloud.a, clouds) ? 1.0 : 1e-3);
    sum += weight * cloud;
    weights += weight;
  }
  return sum / weights;
}
#endif

void main() {
  vec2 uv = vUv - uLock.xy;
  vec3 ray = rayAt(uv * 2.0 - 1.0);
#ifdef DEPTH
  // The history is too coarse for what is thin: it mixes it with the clouds that stand behind.
  ivec2 corner = ivec2(floor((uv * uSize.xy - 0.5 - uOffset.xy) / uTiming.w)), last = ivec2(uMarchSize.xy) - 1;
  float clouds = 1e9;
  for (int i = 0; i < 4; ++i)
    clouds = min(clouds, texelFetch(uMarchedDepth, clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last), 0).x);
  clouds *= 4.0;
  vec4 cloud = historyBefore(uv, hostAlongView(uHostDepth, vUv), clouds);
  if (hostDistance(uHostDepth, vUv, ray) < min(kBefore * clouds, kNear)) cloud = vec4(vec3(0.0), 1.0);
#else
  vec4 cloud = textureLod(uHistory, uv, 0.0);
#endif
  cloud.rgb *= uOptions.x;
  if (uOptions.z > 2.5) cloud = vec4(cloud.aaa, 0.0);
#if defined(SKY) || defined(DISC) || defined(MOON) || defined(STARS)
  vec3 dir = normalize(ray), behind = vec3(0.0);
#ifdef DISC
  behind += sunDisc(uAir, dir, uOptions.w);
#endif
#ifdef MOON
  behind += moonDisc(uNight, dir, uOptions.w);
#endif
#ifdef STARS
  behind += starlight(uNight, dir, uOptions.w);
#endif
#if defined(DISC) || defined(MOON) || defined(STARS)
  behind *= lookupTransmittanceToSun(uTransmittance, uAir, uAir.cameraAltitude, dir.z);
#endif
#ifdef SKY
  behind += lookupSky(uSkyView, uAir, dir);
#endif
  // Clouds shade the air behind them, which makes their own share negative there.
  if (hostDistance(uHostDepth, vUv, ray) > 5e7)
    cloud = vec4(max(cloud.rgb + cloud.a * min(behind * uWind.w * uOptions.x, vec3(60000.0)), vec3(0.0)), 0.0);
#endif
  // Where Welkin draws the sky nothing of the target shines through.
  if (uOptions.z == 1.0) cloud.a = 0.0;
  oColour = cloud;
}
