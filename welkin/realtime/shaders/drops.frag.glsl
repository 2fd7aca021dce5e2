// Drops and flakes, over the target by blending (one, one minus source alpha). Variant HOST_DEPTH: behind what the host
// has drawn.
#include "welkin/base/law.glsl"
#include "welkin/realtime/shaders/frame.glsl"

uniform sampler2D uHostDepth;

in vec2 vShape;
flat in vec4 vLight;
flat in float vDistance;
layout(location = 0) out vec4 oColour;

void main() {
  float opacity = vLight.w * max(1.0 - dot(vShape, vShape), 0.0);
#ifdef HOST_DEPTH
  if (hostAlongView(uHostDepth, gl_FragCoord.xy * uTarget.zw) < vDistance) opacity = 0.0;
#endif
  oColour = vec4(vLight.rgb * opacity, opacity);
}
