#pragma once
// Flashes inside thunderclouds.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "welkin/scene/scene.hpp"

namespace welkin {

// A flash that shines now.
struct Flash {
  glm::dvec3 position{0.0};  // east, north, altitude above the ground, m
  double intensity = 0.0;    // luminous intensity in all directions, kcd
};

// When a flash shines and how brightly: its number, and its share of the mean intensity of a fifth of a second; no
// share when none shines. A pure function: each 60 s / rate hold one flash, of three to five strokes 40 to 70 ms apart,
// each fading in 25 ms (Rakov and Uman 2003, table 4.4: 3 to 5 strokes, 60 ms; the fading is slower than a stroke's
// own, since light is delayed in the cloud and a picture is exposed for a while).
struct FlashTime {
  long number = 0;
  double share = 0.0;
};
FlashTime flashTime(const Lightning& lightning, double time);

// The flash that shines at a time of the scene's, seen from a place: inside one of the towers within 60 km that are
// deep and rain or carry an anvil, nearer ones more often. Layers whose weather comes from a picture have none.
std::optional<Flash> flashAt(const Scene& scene, const glm::dvec2& place, double time);

}  // namespace welkin
