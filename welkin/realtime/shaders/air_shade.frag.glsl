// The view's picture of shaded air (air_shade.glsl): below the segments near the eye, above the far ones.
#include "welkin/base/law.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/realtime/light_volume.glsl"
#include "welkin/realtime/air_shade.glsl"
#include "welkin/realtime/march_params.glsl"
#include "welkin/realtime/shaders/frame.glsl"

layout(std140) uniform March { MarchParams uMarch; };
layout(std140) uniform Volume { LightVolumeParams uVolume; };
uniform sampler3D uSun;

in vec2 vUv;
layout(location = 0) out vec4 oShade;

const int kSamples = 4;  // of a segment

void main() {
  bool far = vUv.y > 0.5;
  vec3 dir = normalize(rayAt(vec2(vUv.x, fract(2.0 * vUv.y)) * 2.0 - 1.0));
  float start = far ? 8.0 * kShadeFirst : 0.0, length_ = far ? start : kShadeFirst;
  for (int k = 0; k < 4; ++k) {
    float dark = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      vec3 q = cloudSpace(dir * (start + length_ * ((float(i) + 0.5) / float(kSamples))), uMarch.planet);
      if (far && k + 4 >= kShadeFar) q.z = min(q.z, shadeAltitude(uMarch.bottom, uMarch.top));
      dark += 1.0 - exp(-kReduced * lookupSunDepth(q, 0.5, uVolume, uSun));
    }
    oShade[k] = dark / float(kSamples);
    start += length_;
    length_ = start;
  }
}
