// What the passes that fill sky tables share.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"

layout(std140) uniform SkyBlock {
  AtmosphereParams uAir;
  PreethamParams uPreetham;
  GradientParams uGradient;
};
in vec2 vUv;
