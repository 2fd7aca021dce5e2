// Drops and flakes near the eye: a triangle round the ellipse that each draws (drop_places.frag.glsl).
#include "welkin/base/law.glsl"
#include "welkin/realtime/shaders/frame.glsl"

uniform highp sampler2D uPlaces, uLights, uSizes;

out vec2 vShape;           // 1 at the ellipse's rim
flat out vec4 vLight;      // light in the target's units, w: opacity in the middle
flat out float vDistance;  // along the view, m

void main() {
  int drop = gl_VertexID / 3, corner = gl_VertexID - 3 * drop, across = textureSize(uPlaces, 0).x;
  ivec2 texel = ivec2(drop % across, drop / across);
  vec4 place = texelFetch(uPlaces, texel, 0);
  vec2 size = texelFetch(uSizes, texel, 0).xy;
  vLight = texelFetch(uLights, texel, 0);
  vDistance = size.y;
  // An equilateral triangle round the unit circle.
  vShape = corner == 0 ? vec2(0.0, 2.0) : vec2(corner == 1 ? -1.7320508 : 1.7320508, -1.0);
  vec2 pixel = place.xy + place.zw * vShape.y + vec2(place.w, -place.z) * (size.x * vShape.x);
  gl_Position = vec4(pixel * uTarget.zw * 2.0 - 1.0, 0.0, 1.0);
}
