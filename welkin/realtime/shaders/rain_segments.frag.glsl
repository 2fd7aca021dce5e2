// The view's picture of rain and snow along its rays.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/realtime/shaders/frame.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"
#include "welkin/realtime/march_params.glsl"

layout(std140) uniform March { MarchParams uMarch; };
uniform sampler3D uSun;
uniform sampler3D uBelow;

#ifdef LIGHT_VOLUME
const int kLightVolume = 1;
#else
const int kLightVolume = 0;
#endif
float skySunDepth(vec3 q, Sky sky) { return lookupSunDepth(q, sky.dither, uVolume, uSun); }
vec2 skyBelowAir(vec2 p, Sky sky) { return lookupBelowAir(p, uVolume, uBelow); }
vec2 skyRain(vec3 q, Sky sky) {
  vec3 found = skyFalling(q, sky);
  return vec2(found.y, found.z / max(found.y, 1e-12));
}
#include "welkin/realtime/drops.glsl"
#include "welkin/realtime/rain_picture.glsl"
#include "welkin/realtime/rain_segments.glsl"

in vec2 vUv;
layout(location = 0) out vec4 oSegment;

void main() {
  vec2 place = vUv * vec2(float(kRainColumns), float(kRainRows));
  Sky sky;
  sky.dither = 0.5;
  oSegment = rainSegment(int(place.y) * kRainColumns + int(place.x), normalize(rayAt(fract(place) * 2.0 - 1.0)), uMarch, sky);
}
