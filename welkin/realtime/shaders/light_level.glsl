// What the passes over one level of the light volume share.
#include "welkin/base/law.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/remap.glsl"
#include "welkin/density/weather.glsl"
#include "welkin/realtime/light_volume.glsl"

layout(std140) uniform Volume { LightVolumeParams uVolume; };
uniform vec4 uLevel;        // xy: centre relative to the anchor, z: edge, w: texels; m
uniform vec3 uSlice;        // altitude of the middle of its cells, their height in m; number
uniform int uCoarsest;      // 1 for the coarsest level
uniform sampler3D uDensity; // extinction of this level's cells: mean; for shadows
