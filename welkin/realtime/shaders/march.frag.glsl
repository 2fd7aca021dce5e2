// March pass: one ray in every block of interleave^2 history pixels.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/density/profile.glsl"
#include "welkin/density/nubis.glsl"
#include "welkin/density/sheet.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#include "welkin/realtime/shaders/frame.glsl"

#include "welkin/realtime/grid.glsl"

struct Sky {
  float dither;
};

layout(std140) uniform Layers {
  LayerParams uLayer[LAYER_SLOTS];
  ClipParams uClip[LAYER_SLOTS];
  SheetParams uSheet[4];
  GridParams uGrid[GRID_SLOTS];
  AtmosphereParams uAir;
};

uniform sampler3D uBaseNoise;
uniform sampler3D uDetailNoise;
uniform sampler3D uWarpNoise;
uniform sampler3D uNubisBase;
uniform sampler3D uNubisDetail;
uniform sampler2D uCurl;
uniform sampler3D uGridIndex;
uniform sampler3D uGridBricks;
uniform sampler2DArray uWeather;
uniform sampler2DArray uExtra;
uniform sampler2D uTransmittance;
uniform sampler3D uAerialInscatter;
uniform sampler3D uAerialTransmittance;
uniform sampler2D uHostDepth;

vec3 skyExtinction(vec3 q, float footprint, bool full, Sky sky) {
  vec3 sum = vec3(0.0, -1.0, 0.0);
  vec3 found;
  vec2 inGrid;
  SKY_LAYERS
  return sum;
}
int skySheetCount(Sky sky) { return SHEET_COUNT; }
SheetParams skySheet(int i, Sky sky) { return uSheet[i]; }

#include "welkin/realtime/march_params.glsl"
#include "welkin/realtime/march.glsl"
#include "welkin/realtime/ray.glsl"

layout(std140) uniform March { MarchParams uMarch; };

layout(location = 0) out vec4 oColour;
layout(location = 1) out vec4 oDepth;
#ifdef COUNT_SAMPLES
layout(location = 2) out vec4 oSamples;
#endif

// Interleaved gradient noise (Jimenez 2014), moved on by the golden ratio every frame.
float gradientNoise(vec2 pixel, float frame) {
  return fract(fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) + 0.61803399 * frame);
}

// White noise for the lighting: what is left after averaging looks like grain, where a regular pattern would look like
// hatching.
float whiteNoise(vec2 pixel, float frame) {
  uint h = hashCell2(int(pixel.x), int(pixel.y), 9u);
  return fract(unitFromHash(h) + 0.61803399 * frame);
}

void main() {
  vec2 pixel = floor(gl_FragCoord.xy) * uTiming.w + uOffset.xy;
  vec2 uv = (pixel + 0.5 + uOffset.zw) * uSize.zw;
  vec3 ray = rayAt(uv * 2.0 - 1.0);
  float limit = hostDistance(uHostDepth, (pixel + 0.5) * uSize.zw, ray);
  // The ground's shadows take the same place in all pixels of a round: they have edges of their own, and grain would
  // spoil them.
  vec3 jitter = vec3(0.5);
  float round_ = floor(uTiming.x / (uTiming.w * uTiming.w));
  if (uOptions.y > 0.5)
    jitter = vec3(gradientNoise(pixel, uTiming.x), whiteNoise(pixel, uTiming.x), fract(0.5 + 0.61803399 * round_));
  Sky sky;
  sky.dither = whiteNoise(pixel + 4096.0, uTiming.x * uOptions.y);
  vec4 colour;
  float depth, samples;
  renderRay(normalize(ray), limit, jitter, uMarch, uAir, uTransmittance, uAerialInscatter, uAerialTransmittance, sky,
            colour, depth, samples);
  oColour = vec4(min(colour.rgb * uWind.w, vec3(60000.0)), colour.a);
  oDepth = vec4(min(depth * 0.25, 60000.0));
#ifdef COUNT_SAMPLES
  oSamples = vec4(samples);
#endif
}
