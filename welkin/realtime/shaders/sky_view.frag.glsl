#include "welkin/realtime/shaders/sky_common.glsl"
uniform sampler2D uTransmittance, uMultiScattering;
out vec4 oTexel;
void main() { oTexel = skyViewTexel(uTransmittance, uMultiScattering, uAir, uPreetham, uGradient, vUv); }
