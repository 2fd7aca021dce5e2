#include "welkin/realtime/shaders/sky_common.glsl"
uniform sampler2D uTransmittance;
out vec4 oTexel;
void main() { oTexel = multiScatteringTexel(uTransmittance, uAir, vUv); }
