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
layout(location = 0) out vec4 oMain;
layout(location = 1) out vec4 oExtra;

void main() {
  vec2 p = uLevel.xy + (vUv - 0.5) * uLevel.z;
  vec4 w = uLevel.w > 0.5 ? nubisWeather(p, uParams, uMap) : profileWeather(p, uParams, uMap);
  oMain = vec4(w.xy, 0.0, 1.0);
  oExtra = vec4(w.zw, 0.0, 1.0);
}
