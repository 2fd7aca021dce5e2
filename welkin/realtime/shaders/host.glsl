// For the shaders of a host: how the sky lights what the host draws, and what air and clouds do on the way to the eye.
// Renderer::hostShader() hands this out with all that it includes, names prefixed, so that only what begins with
// "welkin", "Welkin" and "uWelkin" meets the host's own names.
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
#endif
#include "welkin/base/law.glsl"
#include "welkin/light/phase.glsl"
#include "welkin/light/transmittance.glsl"
#include "welkin/atmosphere/atmosphere.glsl"
#include "welkin/atmosphere/scattering.glsl"
#include "welkin/atmosphere/models.glsl"
#include "welkin/atmosphere/sky.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/precipitation/precipitation.glsl"
#include "welkin/realtime/light_volume.glsl"
#include "welkin/realtime/shaders/air_shade_picture.glsl"
#include "welkin/realtime/host_params.glsl"

layout(std140) uniform WelkinHost { HostParams uWelkin; };
uniform sampler2D uWelkinClouds;
uniform sampler2D uWelkinCloudDepth;
uniform sampler2D uWelkinTransmittance;
uniform sampler3D uWelkinInscatter;
uniform sampler3D uWelkinThrough;
uniform sampler3D uWelkinSunDepth;
uniform sampler3D uWelkinBelow;
uniform sampler2D uWelkinAirShade;
uniform sampler2D uWelkinRain;

// Light that falls on a point.
struct WelkinLight {
  vec3 toSun;  // unit vector in the host's axes, by night toward the moon
  vec3 sun;    // on a plane that faces it, klx; air and clouds taken off
  vec3 sky;    // on a level plane, from sky and clouds, klx
};

// What lies between the eye and a point.
struct WelkinFront {
  vec3 light;    // that it sends to the eye, in the target's units
  vec3 through;  // share of the point's own light that it lets through
  float clouds;  // the clouds' part of that share
};

// What falls from the clouds at a point, within 4 km of the eye.
struct WelkinRain {
  float rate;     // of water at the ground there, mm/h
  float snow;     // share of it that is snow
  float wetness;  // of an open surface: 0 dry, 1 soaked, from the rain of the last ten minutes
};

vec3 eastNorthUpOf(vec3 p) { return uWelkin.yUp > 0.5 ? vec3(p.x, -p.z, p.y) : p; }
vec3 hostAxesOf(vec3 p) { return uWelkin.yUp > 0.5 ? vec3(p.x, p.z, -p.y) : p; }

// Share of the sun's light that the clouds leave to a point of cloud space. What they scatter forward counts as sunlight,
// since it arrives from nearly where the sun stands.
float sunShareAt(vec3 q) {
  if (uWelkin.hasVolume < 0.5 || q.z >= uWelkin.top) return 1.0;
  return exp(-kReduced * lookupSunDepth(q, 0.0, uWelkin.volume, uWelkinSunDepth));
}

vec3 sunAt(float altitude, vec3 d) {
  vec3 normal = normalize(uWelkin.planet.up.xyz * uWelkin.planet.up.w + d);
  return uWelkin.air.sunIrradiance.xyz *
         lookupTransmittanceToSun(uWelkinTransmittance, uWelkin.air, altitude,
                                  dot(uWelkin.air.sunDirection.xyz, normal));
}

// Light without direction on level ground, klx, with what the clouds send back of the ground's; `direct`: the sun's on it.
vec3 diffuseOnGround(vec2 place, vec3 sunAbove, vec3 direct) {
  if (uWelkin.hasVolume < 0.5) return uWelkin.shadedSky.xyz;
  vec2 below = lookupBelow(place, uWelkin.volume, uWelkinBelow);
  vec3 sky = sunAbove * below.x + skyOnGround(uWelkin.skyOpen.xyz, uWelkin.skyAround.xyz, below.y);
  vec3 back = uWelkin.groundAlbedo.xyz * (1.0 - below.y);
  return sky + (direct + sky) * back / (1.0 - back);
}

// Where the picture shows a vector from the eye, in [0, 1].
vec2 pictureAt(vec3 d) {
  vec4 p = vec4(d, 1.0);
  return vec2(dot(uWelkin.clip0, p), dot(uWelkin.clip1, p)) / max(dot(uWelkin.clip3, p), 1e-6) * 0.5 + 0.5;
}

// The air's own light toward the eye, part of which the clouds shade (as in the march).
vec3 shadedInscatter(vec3 dir, float distance_, vec3 inscatter, vec3 through) {
  if (uWelkin.hasVolume < 0.5) {
    bool above = uWelkin.planet.altitude >= uWelkin.bottom;
    return mix(inscatter, uWelkin.shadedAir.xyz * (1.0 - through), above ? 0.0 : uWelkin.shadedAir.w);
  }
  vec3 sunAbove = sunAt(uWelkin.bottom, vec3(0.0));
  float loss = lossOf(through, distance_), end = 1.0 - exp(-loss * distance_);
  vec3 light = vec3(0.0);
  for (int i = 0; i < 2; ++i) {  // where equal shares of the light come from
    float t = -log(1.0 - end * (0.25 + 0.5 * float(i))) / max(loss, 1e-7);
    vec2 below = lookupBelowAir(dir.xy * min(t, distance_), uWelkin.volume, uWelkinBelow);
    light += 0.5 * (sunAbove * below.x + uWelkin.skyAround.xyz * (3.14159265 * below.y));
  }
  vec2 way = wayInShade(dir, uWelkin.bottom, uWelkin.top, uWelkin.planet);
  float dark = shadeBefore(lookupAirShade(pictureAt(dir), uWelkinAirShade), distance_, loss, way);
  return mix(inscatter, light * uWelkin.shadedAir.xyz * (1.0 - through), dark);
}

// Mean distance of the clouds at a point of the picture, m. The texels stand where this frame has marched; those that
// hold no cloud do not count.
float cloudDistance(vec2 uv) {
  vec2 at = uv * uWelkin.depthPlace.xy + uWelkin.depthPlace.zw;
  ivec2 last = textureSize(uWelkinCloudDepth, 0) - 1;
  vec2 f = fract(at);
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 step_ = ivec2(i & 1, i >> 1);
    float depth = texelFetch(uWelkinCloudDepth, clamp(ivec2(floor(at)) + step_, ivec2(0), last), 0).x;
    vec2 near = mix(1.0 - f, f, vec2(step_));
    float weight = depth < uWelkin.depthFar ? near.x * near.y + 1e-4 : 0.0;
    sum += weight * depth;
    weights += weight;
  }
  return (weights > 0.0 ? sum / weights : uWelkin.depthFar) * uWelkin.depthUnit;
}

// `fromEye` is everywhere the vector from the eye to the point in the host's axes, m.

// Share of sunlight that the clouds leave to a point: their shadow.
float welkinSunShare(vec3 fromEye) { return sunShareAt(cloudSpace(eastNorthUpOf(fromEye), uWelkin.planet)); }

WelkinLight welkinLight(vec3 fromEye) {
  vec3 d = eastNorthUpOf(fromEye);
  vec3 q = cloudSpace(d, uWelkin.planet);
  WelkinLight light;
  light.toSun = hostAxesOf(uWelkin.air.sunDirection.xyz);
  light.sun = sunAt(max(q.z, 0.0), d) * sunShareAt(q);
  // Inside the clouds' shell between what is known of its bottom and of its top.
  float height = clamp((q.z - uWelkin.bottom) / max(uWelkin.top - uWelkin.bottom, 1.0), 0.0, 1.0);
  float slant = dot(uWelkin.air.sunDirection.xyz, normalize(uWelkin.planet.up.xyz * uWelkin.planet.up.w + d));
  vec3 onGround = diffuseOnGround(q.xy, sunAt(uWelkin.bottom, d), light.sun * max(slant, 0.0));
  light.sky = mix(onGround, uWelkin.clearSky.xyz, height);
  return light;
}

WelkinRain welkinRain(vec3 fromEye) {
  vec3 q = cloudSpace(eastNorthUpOf(fromEye), uWelkin.planet);
  vec2 found = textureLod(uWelkinRain, q.xy * uWelkin.rainScale + 0.5, 0.0).xy * sign(uWelkin.rainScale);
  WelkinRain rain;
  rain.rate = found.x;
  rain.snow = snowShare(q.z, uWelkin.freezing);
  rain.wetness = found.y * (1.0 - rain.snow);
  return rain;
}

// The air alone: for what the host draws before the clouds, which are then laid over it.
WelkinFront welkinAir(vec3 fromEye) {
  vec3 d = eastNorthUpOf(fromEye);
  float distance_ = length(d);
  vec3 dir = d / max(distance_, 1e-3);
  WelkinFront front;
  vec3 inscatter;
  lookupAerial(uWelkinInscatter, uWelkinThrough, uWelkin.air, dir, distance_, inscatter, front.through);
  front.through = mix(vec3(1.0), front.through, min(distance_, 1.0));  // the table's first metre stands for none
  front.light = shadedInscatter(dir, distance_, inscatter, front.through) * uWelkin.exposure;
  front.clouds = 1.0;
  return front;
}

// Air and clouds: for what the host draws after the clouds. A pixel knows its clouds' light, transmittance and mean
// distance; where the point lies inside, they are taken for one slab of even extinction with that mean.
WelkinFront welkinFront(vec3 fromEye) {
  WelkinFront front = welkinAir(fromEye);
  vec3 d = eastNorthUpOf(fromEye);
  vec2 uv = pictureAt(d);
  vec4 clouds = textureLod(uWelkinClouds, uv, 0.0);
  float whole = -log(clamp(clouds.a, 0.01, 1.0));  // optical depth
  float mean_ = whole < 0.02 ? 0.5 * whole : 1.0 - whole / (exp(whole) - 1.0);  // of what is seen of it
  float inside = (length(d) - cloudDistance(uv)) * uWelkin.extinction + mean_;
  float share = 0.0;  // of the clouds' light that comes from before the point
  if (inside > 0.0) {
    bool behind = inside >= whole;
    front.clouds = behind ? clouds.a : exp(-inside);
    share = behind ? 1.0 : (1.0 - front.clouds) / (1.0 - exp(-whole));
  }
  front.light = max(clouds.rgb * (share * uWelkin.cloudExposure) + front.clouds * front.light, vec3(0.0));
  front.through *= front.clouds;
  return front;
}

// A transparent surface's premultiplied colour (in the target's units) as it is seen through air and clouds, to be
// blended with (one, one minus source alpha) over the finished frame.
vec4 welkinThrough(vec4 colour, vec3 fromEye) {
  WelkinFront front = welkinFront(fromEye);
  return vec4(colour.rgb * front.through + front.light * colour.a, colour.a);
}
