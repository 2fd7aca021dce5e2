// Drops and flakes, over the target by blending (one, one minus source alpha).
#include "welkin/base/law.glsl"
#include "welkin/realtime/shaders/frame.glsl"

uniform sampler2D uHostDepth;

in vec2 vShape;
in vec4 vLight;
in float vDistance;
layout(location = 0) out vec4 oColour;

void main() {
  float r2 = dot(vShape, vShape);
  if (r2 >= 1.0) discard;
  if (uDepthInfo.x > 0.5) {
    vec2 uv = gl_FragCoord.xy * uTarget.zw;
    if (hostDistance(uHostDepth, uv, rayAt((uv - uLock.xy) * 2.0 - 1.0)) < vDistance) discard;
  }
  float opacity = vLight.w * (1.0 - r2);
  oColour = vec4(vLight.rgb * opacity, opacity);
}
