#include "welkin/realtime/shaders/sky_common.glsl"
out vec4 oTexel;
void main() { oTexel = transmittanceTexel(uAir, vUv); }
