#pragma once
// Classical cloud models: what a sky file says of one (docs/classical.md).
#include <glm/vec3.hpp>

#include "welkin/base/fields.hpp"
#include "welkin/density/scatterers.hpp"

namespace welkin {

// height_map: columns as high as a map says (002). perlin: a filtered array of noise (001 ch. 5). metaballs (001 ch.
// 4.2). ellipsoids: with a texture that eats their rims (001 ch. 4.3). particles (001 ch. 4.1). automaton: cells of
// humidity, cloud and activation (001 ch. 4.4).
enum class ClassicalKind { height_map, perlin, metaballs, ellipsoids, particles, automaton };
template <>
struct ChoiceNames<ClassicalKind> {
  static constexpr std::array<std::string_view, 6> names{"height_map", "perlin",    "metaballs",
                                                         "ellipsoids", "particles", "automaton"};
};

// Where a classical cloud stands and what it is made of.
struct ClassicalCloud {
  ClassicalKind kind = ClassicalKind::height_map;
  glm::dvec3 position{0.0, 0.0, 1200.0};      // m
  float heading = 1.5708f;                    // rad, compass
  glm::vec3 size{3000.0f, 2400.0f, 1500.0f};  // m
  int voxels = 4000000;
  int seed = 0;
  float detail = 0.0f;
  float detailSize = 300.0f;  // m
  float edge = 1.0f;
  float extinction = 0.05f;  // 1/m
  float albedo = 1.0f;
  ScatteringPhase phase = ScatteringPhase::droplets;
  float dropletDiameter = 12.0f;  // um
  float asymmetry = 0.85f;
  float drift = 1.0f;
};
template <>
struct FieldTable<ClassicalCloud> {
  static auto make() {
    return fieldRows(
        field<&ClassicalCloud::kind>("kind", "which model: only the table of the same name counts"),
        field<&ClassicalCloud::position, kMetres>("position", {-1e7, 1e7}, {-10000, 10000},
                                                  "the middle of its base: east, north, up"),
        field<&ClassicalCloud::heading, kDegrees>("heading", {-360, 360}, {0, 360}, "compass heading of its length"),
        field<&ClassicalCloud::size, kMetres>("size", {20, 100000}, {200, 20000},
                                              "of its box: along the heading, across it, up"),
        field<&ClassicalCloud::voxels>("voxels", {1000, 30000000}, {100000, 8000000},
                                       "about how many cubes its box is divided into"),
        field<&ClassicalCloud::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another cloud of its kind"),
        field<&ClassicalCloud::detail>("detail", {0, 1}, {}, "how deep a noise carves what the model gives"),
        field<&ClassicalCloud::detailSize, kMetres>("detail_size", {1, 100000}, {50, 2000},
                                                    "cells of that noise; four octaves"),
        field<&ClassicalCloud::edge>("edge", {0.01, 1}, {},
                                     "share of the model's density at which the cloud is as dense as it gets"),
        field<&ClassicalCloud::extinction, kPerMetre>("extinction", {0, 1}, {0.001, 0.2}, "of the densest cloud"),
        albedoRow<&ClassicalCloud::albedo>(), phaseRow<&ClassicalCloud::phase>(),
        dropletRow<&ClassicalCloud::dropletDiameter>(), asymmetryRow<&ClassicalCloud::asymmetry>(),
        field<&ClassicalCloud::drift>("drift", {0, 2}, {0, 1}, "share of the wind that carries it"));
  }
};

// A map of heights by 002's octaves; one pixel of its picture is an element.
struct HeightMapSettings {
  int squares = 140;
  float amplitude = 1.0f;
  int octaves = 3;
  float step = 0.3f;
  int smoothing = 12;
  int elements = 2048;
  float element = 12.0f;  // m
  float warp = 0.0f;
  float cover = 0.45f;
};
template <>
struct FieldTable<HeightMapSettings> {
  static auto make() {
    return fieldRows(
        field<&HeightMapSettings::squares>(
            "squares", {2, 2048}, {20, 600},
            "side of the squares of one value in the first octave, in elements; half in each octave that follows"),
        field<&HeightMapSettings::amplitude>("amplitude", {0, 1}, {},
                                             "greatest difference within the first octave; half in each that follows"),
        field<&HeightMapSettings::octaves>("octaves", {1, 8}, {1, 6}, "how many"),
        field<&HeightMapSettings::step>("step", {0.01, 1}, {0.1, 1},
                                        "most that neighbouring squares differ, as a share of their octave's "
                                        "amplitude: 1 leaves them independent (cirrus)"),
        field<&HeightMapSettings::smoothing>("smoothing", {0, 100}, {0, 32},
                                             "how often each element becomes the mean of the nine round it"),
        field<&HeightMapSettings::elements>("elements", {256, 512, 1024, 2048, 4096},
                                            "side of the map, which repeats, in elements"),
        field<&HeightMapSettings::element, kMetres>("element", {0.5, 1000}, {5, 100}, "side of an element"),
        field<&HeightMapSettings::warp>("warp", {0, 500}, {0, 100},
                                        "how far, in elements, a noise bends the squares; 0: as in the source"),
        field<&HeightMapSettings::cover>("cover", {0, 1}, {}, "share of the map with cloud"));
  }
};

enum class ArrayInterpolation { linear, cosine, cubic };
template <>
struct ChoiceNames<ArrayInterpolation> {
  static constexpr std::array<std::string_view, 3> names{"linear", "cosine", "cubic"};
};

// A filtered array of noise: 001 ch. 5.
struct PerlinArraySettings {
  int cells = 5;
  int octaves = 4;
  float persistence = 0.5f;
  ArrayInterpolation interpolation = ArrayInterpolation::cosine;
  int smoothing = 0;
  float cover = 0.53f;
  float sharpness = 0.97f;
};
template <>
struct FieldTable<PerlinArraySettings> {
  static auto make() {
    return fieldRows(
        field<&PerlinArraySettings::cells>("cells", {2, 16}, {2, 12},
                                           "of the first array on each axis; twice as many in each that follows"),
        field<&PerlinArraySettings::octaves>("octaves", {1, 5}, {}, "how many arrays"),
        field<&PerlinArraySettings::persistence>("persistence", {0, 1}, {0.3, 0.8},
                                                 "weight of each array against the one before"),
        field<&PerlinArraySettings::interpolation>("interpolation", "between the values of an array"),
        field<&PerlinArraySettings::smoothing>("smoothing", {0, 8}, {0, 2},
                                               "how often each value becomes the mean of the 27 round it"),
        field<&PerlinArraySettings::cover>("cover", {0, 1}, {},
                                           "cloudCover: of the noise as little as this is no cloud"),
        field<&PerlinArraySettings::sharpness>(
            "sharpness", {0, 1}, {0.9, 0.999},
            "cloudSharpness: density is 1 - sharpness^(255 (noise - cover)); nearer to 1 is softer"));
  }
};

// Balls whose fields add up.
struct MetaballSettings {
  int count = 40;
  float radius = 0.15f;
  float variation = 0.4f;
  float strength = 1.0f;
  float threshold = 0.3f;
};
template <>
struct FieldTable<MetaballSettings> {
  static auto make() {
    return fieldRows(
        field<&MetaballSettings::count>("count", {1, 400}, {4, 80}, "how many balls"),
        field<&MetaballSettings::radius>("radius", {0.01, 0.5}, {0.05, 0.4},
                                         "mean radius of a ball's reach, as a share of the box's length"),
        field<&MetaballSettings::variation>("variation", {0, 1}, {}, "how unlike the radii are"),
        field<&MetaballSettings::strength>("strength", {0, 10}, {0.5, 2}, "field in the middle of a ball"),
        field<&MetaballSettings::threshold>("threshold", {0, 0.99}, {0.05, 0.8}, "field at the cloud's surface"));
  }
};

enum class EllipsoidTexture { spectral, perlin };
template <>
struct ChoiceNames<EllipsoidTexture> {
  static constexpr std::array<std::string_view, 2> names{"spectral", "perlin"};
};

// Ellipsoids with a texture.
struct EllipsoidSettings {
  int count = 9;
  EllipsoidTexture texture = EllipsoidTexture::spectral;
  float frequency = 4.0f;
  int octaves = 6;
  float contrast = 0.55f;
  float middle = 0.1f;
  float rim = 0.9f;
};
template <>
struct FieldTable<EllipsoidSettings> {
  static auto make() {
    return fieldRows(
        field<&EllipsoidSettings::count>("count", {1, 100}, {1, 24}, "how many ellipsoids"),
        field<&EllipsoidSettings::texture>("texture", "spectral: a sum of sines; perlin: noise in its place"),
        field<&EllipsoidSettings::frequency>("frequency", {0.1, 100}, {1, 20},
                                             "waves of the first octave along the box"),
        field<&EllipsoidSettings::octaves>("octaves", {1, 8}, {}, "how many, each with twice the frequency"),
        field<&EllipsoidSettings::contrast>("contrast", {0, 1}, {}, "amplitude of each octave against the one before"),
        field<&EllipsoidSettings::middle>("middle", {0, 1}, {},
                                          "texture below this is a hole in an ellipsoid's middle"),
        field<&EllipsoidSettings::rim>("rim", {0, 1}, {}, "the same at its rim"));
  }
};

// Soft balls that cover one another.
struct ParticleSettings {
  int count = 1500;
  float radius = 0.05f;
  float variation = 0.5f;
  float opacity = 0.35f;
  int puffs = 12;
};
template <>
struct FieldTable<ParticleSettings> {
  static auto make() {
    return fieldRows(
        field<&ParticleSettings::count>("count", {1, 20000}, {50, 4000}, "how many particles"),
        field<&ParticleSettings::radius>("radius", {0.002, 0.3}, {0.01, 0.15},
                                         "mean radius, as a share of the box's length"),
        field<&ParticleSettings::variation>("variation", {0, 1}, {}, "how unlike the radii are"),
        field<&ParticleSettings::opacity>("opacity", {0, 1}, {}, "density in the middle of one"),
        field<&ParticleSettings::puffs>("puffs", {1, 200}, {1, 40}, "ellipsoids on whose surfaces they sit"));
  }
};

// Cells with three bits each.
struct AutomatonSettings {
  int width = 128;
  int breadth = 128;
  int height = 48;
  int regions = 8;
  float humidity = 0.3f;
  float rehumidification = 0.05f;
  float activation = 0.001f;
  float extinction = 0.05f;
  int start = 60;
  float step = 5.0f;  // s
  int shear = 0;
  int smoothing = 2;
  int memory = 2;
};
template <>
struct FieldTable<AutomatonSettings> {
  static auto make() {
    return fieldRows(
        field<&AutomatonSettings::width>("width", {64, 128, 192, 256, 320, 384, 448, 512}, "cells along the heading"),
        field<&AutomatonSettings::breadth>("breadth", {8, 512}, {32, 256}, "cells across it"),
        field<&AutomatonSettings::height>("height", {4, 256}, {16, 96}, "cells up"),
        field<&AutomatonSettings::regions>("regions", {0, 64}, {0, 24},
                                           "ellipsoids in which clouds form; 0: the whole box"),
        field<&AutomatonSettings::humidity>("humidity", {0, 1}, {}, "share of humid cells at the beginning"),
        field<&AutomatonSettings::rehumidification>("rehumidification", {0, 1}, {0, 0.2},
                                                    "chance of a cell to become humid in a step"),
        field<&AutomatonSettings::activation>("activation", {0, 1}, {0, 0.02},
                                              "chance of a cell to become active in a step"),
        field<&AutomatonSettings::extinction>(
            "extinction", {0, 1}, {0, 0.3}, "chance of a cell's cloud to vanish in a step, in the middle of a region"),
        field<&AutomatonSettings::start>("start", {0, 1000}, {0, 200}, "steps before time 0"),
        field<&AutomatonSettings::step, kSeconds>("step", {0.1, 10000}, {1, 60}, "time from one step to the next"),
        field<&AutomatonSettings::shear>("shear", {-4, 4}, {}, "cells by which wind moves the top in a step"),
        field<&AutomatonSettings::smoothing>("smoothing", {0, 6}, {},
                                             "cells round one that its density is the mean of"),
        field<&AutomatonSettings::memory>("memory", {0, 8}, {}, "steps before the last that it is the mean of, too"));
  }
};

// A classical cloud with the tables of all models.
struct Classical {
  ClassicalCloud cloud;
  HeightMapSettings heightMap;
  PerlinArraySettings perlin;
  MetaballSettings metaballs;
  EllipsoidSettings ellipsoids;
  ParticleSettings particles;
  AutomatonSettings automaton;
};

bool sameClassical(const Classical& a, const Classical& b);

}  // namespace welkin
