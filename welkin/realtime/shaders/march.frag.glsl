// March pass: one ray in every block of interleave^2 history pixels.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/light/slab.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#include "welkin/realtime/shaders/frame.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"

uniform sampler2D uTransmittance;
uniform sampler3D uAerialInscatter;
uniform sampler3D uAerialTransmittance;
uniform sampler2D uSkyView;
uniform sampler3D uSun;
uniform sampler3D uDiffuse;
uniform sampler3D uBelow;
uniform sampler2D uHostDepth;
uniform sampler2D uBlueNoise;
uniform sampler2D uAirShade;
uniform sampler2D uRainSegments;

#ifdef LIGHT_VOLUME
const int kLightVolume = 1;
AirShade skyAirShade(Sky sky) { return sky.airShade; }
#else
const int kLightVolume = 0;
AirShade skyAirShade(Sky sky) { return AirShade(vec4(0.0), vec4(0.0)); }
#endif
float skySunDepth(vec3 q, Sky sky) { return lookupSunDepth(q, sky.dither, uVolume, uSun); }
int skySheetCount(Sky sky) { return SHEET_COUNT; }
SheetParams skySheet(int i, Sky sky) { return uSheet[i]; }

vec2 skyBelow(vec2 p, Sky sky) { return lookupBelow(p, uVolume, uBelow); }
vec2 skyBelowAir(vec2 p, Sky sky) { return lookupBelowAir(p, uVolume, uBelow); }

#ifdef LIGHTNING
#include "welkin/realtime/lightning.glsl"
layout(std140) uniform Lightning { LightningParams uLightning; };
vec3 skyLightning(vec3 q, Sky sky) { return lightningLight(q, uLightning); }
#endif

#include "welkin/realtime/march_params.glsl"
#include "welkin/realtime/span.glsl"
#ifdef LIGHT_VOLUME
#include "welkin/realtime/shaders/clearance.glsl"
uniform highp sampler2DArray uBounds;
float skyClearance(vec3 q, vec3 way, Sky sky) {
  float clear = 1e9;
  SKY_CLEARANCE
  return clear;
}
#include "welkin/realtime/shaders/march_volume.glsl"
#else
#include "welkin/realtime/march.glsl"
#endif
#include "welkin/realtime/shaders/rain_lookup.glsl"
#ifdef SKY_RAIN
const int kRains = 1;
#else
const int kRains = 0;
#endif
vec4 skyRainSegment(int k, Sky sky) { return lookupRainSegment(k, sky.uv, uRainSegments); }
#include "welkin/realtime/ray.glsl"

layout(std140) uniform March { MarchParams uMarch; };

layout(location = 0) out vec4 oColour;
layout(location = 1) out vec4 oDepth;
#ifdef COUNT_SAMPLES
layout(location = 2) out vec4 oSamples;
#endif

// Blue noise in [0, 1), moved on by the golden ratio every round: a pixel is marched once in each. `place` tells apart
// what must not go together.
float blueNoise(vec2 pixel, ivec2 place, float round_) {
  int size = textureSize(uBlueNoise, 0).x;
  return fract(texelFetch(uBlueNoise, (ivec2(pixel) + place) % size, 0).x + 0.61803399 * round_);
}

void main() {
  vec2 pixel = floor(gl_FragCoord.xy) * uTiming.w + uOffset.xy;
  vec2 uv = (pixel + 0.5 + uOffset.zw) * uSize.zw;
  vec3 ray = rayAt(uv * 2.0 - 1.0);
  float limit = hostDistance(uHostDepth, (pixel + 0.5) * uSize.zw + uLock.xy, ray);
  // The ground's shadows take the same place in all pixels of a round: they have edges of their own, and grain would
  // spoil them.
  vec3 jitter = vec3(0.5);
  float round_ = floor(uTiming.x / (uTiming.w * uTiming.w));
  if (uOptions.y > 0.5)
    jitter = vec3(blueNoise(pixel, ivec2(0), round_), blueNoise(pixel, ivec2(23, 41), round_),
                  fract(0.5 + 0.61803399 * round_));
  Sky sky;
  sky.dither = blueNoise(pixel, ivec2(47, 13), round_ * uOptions.y);
  sky.uv = uv;
#ifdef LIGHT_VOLUME
  sky.airShade = lookupAirShade(uv, uAirShade);
#endif
  vec4 colour;
  float depth, samples;
  renderRay(normalize(ray), limit, jitter, uMarch, uAir, uTransmittance, uAerialInscatter, uAerialTransmittance, sky,
            colour, depth, samples);
  // The sky behind is as smooth as the rest of the history. Clouds shade the air behind them, which makes their own share
  // negative there.
  if (uOptions.z == 1.0) colour.rgb = max(colour.rgb + colour.a * lookupSky(uSkyView, uAir, normalize(ray)), vec3(0.0));
  oColour = vec4(min(colour.rgb * uWind.w, vec3(60000.0)), colour.a);
  oDepth = vec4(min(depth * 0.25, 60000.0));
#ifdef COUNT_SAMPLES
  oSamples = vec4(samples);
#endif
}
