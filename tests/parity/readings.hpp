#pragma once
// The scalar reading of every room, and the order in which GLSL reads the law files. One line per room.
#include "welkin/atmosphere/law.hpp"
#include "welkin/base/law_tone.hpp"
#include "welkin/density/law.hpp"
#include "welkin/light/law.hpp"
#include "welkin/noise/law.hpp"
#include "welkin/precipitation/law.hpp"
#include "welkin/scene/law.hpp"

#define WELKIN_BASE_LAW "welkin/base/law.glsl", "welkin/base/tone.glsl"
#define WELKIN_LIGHT_LAW "welkin/light/phase.glsl", "welkin/light/transmittance.glsl", "welkin/light/slab.glsl"
#define WELKIN_NOISE_LAW                                                                                           \
  "welkin/noise/hash.glsl", "welkin/noise/remap.glsl", "welkin/noise/lattice.glsl", "welkin/noise/perlin.glsl",    \
      "welkin/noise/simplex.glsl", "welkin/noise/worley.glsl", "welkin/noise/fbm.glsl", "welkin/noise/gamma.glsl", \
      "welkin/noise/perlin_worley.glsl", "welkin/noise/curl.glsl", "welkin/noise/textures.glsl"
#define WELKIN_DENSITY_LAW                                                                     \
  "welkin/density/space.glsl", "welkin/density/weather.glsl", "welkin/density/profile.glsl",   \
      "welkin/density/nubis.glsl", "welkin/density/sheet.glsl", "welkin/density/scatter.glsl", \
      "welkin/density/hero.glsl"
#define WELKIN_ATMOSPHERE_LAW                                                                                \
  "welkin/atmosphere/atmosphere.glsl", "welkin/atmosphere/scattering.glsl", "welkin/atmosphere/models.glsl", \
      "welkin/atmosphere/sky.glsl", "welkin/atmosphere/night.glsl"
#define WELKIN_PRECIPITATION_LAW "welkin/precipitation/precipitation.glsl"
#define WELKIN_SCENE_LAW "welkin/scene/camera.glsl", "welkin/scene/rain.glsl"
#define WELKIN_LAW_FILES                                                                          \
  WELKIN_BASE_LAW, WELKIN_LIGHT_LAW, WELKIN_NOISE_LAW, WELKIN_DENSITY_LAW, WELKIN_ATMOSPHERE_LAW, \
      WELKIN_PRECIPITATION_LAW, WELKIN_SCENE_LAW
