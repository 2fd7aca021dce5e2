// Light volume, first pass: the mean extinction of the cells of one slice, from four of their points.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"

uniform vec4 uLevel;  // xy: centre relative to the anchor, z: edge, w: texels; m
uniform vec3 uSlice;  // altitude of the middle of its cells, their height in m; number

in vec2 vUv;
layout(location = 0) out vec4 oDensity;

const float kClearWay = 0.2;  // by the path tracer, on bench/error.cpp's views

void main() {
  vec3 size = vec3(vec2(uLevel.z / uLevel.w), uSlice.y);
  vec3 middle = vec3(uLevel.xy + (vUv - 0.5) * uLevel.z, uSlice.x);
  Sky sky;
  sky.dither = 0.5;
  // The mean, and what gives the mean of the light that points let through over a share of a cell's width: a half of a
  // coarse cell that is clear is not quite shaded by the other.
  float finest = 1.0 / (uVolume.levels.level0.inverseSize * uLevel.w);
  float path = kClearWay * clamp(size.x - finest, 1.0, 0.4 / uVolume.inverseHeight), sum = 0.0, through = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec3 corner = vec3((i & 1) == 0 ? -0.25 : 0.25, (i & 2) == 0 ? -0.25 : 0.25, i == 0 || i == 3 ? -0.25 : 0.25);
    float sigma = skyExtinction(middle + corner * size, 0.25 * size.x, true, sky).x;
    sum += 0.25 * sigma;
    through += 0.25 * exp(-path * sigma);
  }
  oDensity = vec4(sum, -log(max(through, 1e-12)) / path, 0.0, 1.0);
}
