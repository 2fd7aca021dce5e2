// What falls at the ground round the eye, and how wet the ground is. No memory: the weather drifts as a whole, so that what
// has fallen at a place stands downwind of it by now.
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/realtime/shaders/sky_density.glsl"

uniform vec4 uPlace;  // x: edge of the map, m; yz: way of the wind in a second, m

const float kDrying = 600.0;  // s, in which a wet surface loses all but 1 / e of its water
const float kSoaked = 0.15;   // mm of water that make a surface nearly as wet as it can be
const int kLooks = 8;         // into the past, each for an equal share of the drying

in vec2 vUv;
layout(location = 0) out vec4 oMap;

void main() {
  vec2 p = (vUv - 0.5) * uPlace.x;
  Sky sky;
  sky.dither = 0.0;
  float now = skyFalling(vec3(p, 0.0), sky).x, water = 0.0;
  for (int i = 0; i < kLooks; ++i) {
    float ago = -kDrying * log(1.0 - (float(i) + 0.5) / float(kLooks));
    water += kDrying / (3600.0 * float(kLooks)) * skyFalling(vec3(p + uPlace.yz * ago, 0.0), sky).x;
  }
  oMap = vec4(now, 1.0 - exp(-water / kSoaked), 0.0, 1.0);
}
