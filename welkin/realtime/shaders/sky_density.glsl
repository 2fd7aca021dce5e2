// The density of all layers at a point, for the passes that march through it. Includers have the law's vocabulary and
// the atmosphere before it, and the makers of the text define LAYER_SLOTS, GRID_SLOTS, SHEET_COUNT and SKY_LAYERS; and
// SKY_RAIN where anything falls.
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/density/space.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/density/profile.glsl"
#include "welkin/density/nubis.glsl"
#include "welkin/density/sheet.glsl"
#include "welkin/precipitation/precipitation.glsl"
#include "welkin/scene/rain.glsl"
#include "welkin/density/scatter.glsl"
#include "welkin/realtime/grid.glsl"
#include "welkin/realtime/light_volume.glsl"
#include "welkin/realtime/shaders/air_shade_picture.glsl"

struct Sky {
  float dither;
  AirShade airShade;  // of a ray of the march
  vec2 uv;            // its place in the picture
};

layout(std140) uniform Layers {
  LayerParams uLayer[LAYER_SLOTS];
  ClipParams uClip[LAYER_SLOTS];
  SheetParams uSheet[4];
  GridParams uGrid[GRID_SLOTS];
  AtmosphereParams uAir;
  LightVolumeParams uVolume;
  RainParams uRain[LAYER_SLOTS];
};

uniform sampler3D uBaseNoise;
uniform sampler3D uDetailNoise;
uniform sampler3D uWarpNoise;
uniform sampler3D uNubisBase;
uniform sampler3D uNubisDetail;
uniform sampler2D uCurl;
uniform sampler3D uGridIndex;
uniform sampler3D uGridBricks;
uniform sampler2DArray uWeather;
uniform sampler2DArray uExtra;

vec3 skyExtinction(vec3 q, float footprint, bool full, Sky sky) {
  vec3 sum = vec3(0.0, -1e4, 0.0);
  vec3 found;
  vec2 inGrid;
  SKY_LAYERS
  return sum;
}

#ifdef SKY_RAIN
// (Rate in mm/h, extinction in 1/m, that of snow) of what falls at a point.
vec3 skyFalling(vec3 q, Sky sky) {
  vec3 sum = vec3(0.0);
  float rate, snow, sigma;
  SKY_RAIN
  return sum;
}
#endif
