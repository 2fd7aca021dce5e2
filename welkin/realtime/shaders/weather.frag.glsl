// Weather pass: one clip level of one layer.
#include "welkin/base/law.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"

layout(std140) uniform Weather { WeatherParams uParams; };
uniform sampler2D uMap;
uniform vec4 uLevel;  // xy: centre relative to the anchor, z: extent, w: shape

in vec2 vUv;
out vec4 oWeather;

void main() {
  vec2 p = uLevel.xy + (vUv - 0.5) * uLevel.z;
  oWeather = uLevel.w > 0.5 ? nubisWeather(p, uParams, uMap) : profileWeather(p, uParams, uMap);
}
