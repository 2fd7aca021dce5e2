// The shade along the ray at a point of the picture (air_shade.frag.glsl).
#include "welkin/realtime/air_shade.glsl"

AirShade lookupAirShade(vec2 uv, sampler2D shade) {
  float edge = 0.5 / float(textureSize(shade, 0).y), row = clamp(0.5 * uv.y, edge, 0.5 - edge);
  return AirShade(textureLod(shade, vec2(uv.x, row), 0.0), textureLod(shade, vec2(uv.x, row + 0.5), 0.0));
}
