// Rain and snow along the ray at a point of the view (rain_segments.frag.glsl).
#include "welkin/realtime/rain_picture.glsl"

vec4 lookupRainSegment(int k, vec2 uv, sampler2D picture) {
  vec2 blocks = vec2(float(kRainColumns), float(kRainRows));
  vec2 edge = 0.5 * blocks / vec2(textureSize(picture, 0));
  vec2 block = vec2(float(k % kRainColumns), float(k / kRainColumns));
  return textureLod(picture, (block + clamp(uv, edge, 1.0 - edge)) / blocks, 0.0);
}
