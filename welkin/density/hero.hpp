#pragma once
// Hero clouds: what a sky file says of a single cloud, modelled by itself (docs/hero.md).
#include <glm/vec3.hpp>

#include "welkin/base/fields.hpp"
#include "welkin/density/scatterers.hpp"

namespace welkin {

// Presets of all parameters but place, heading, scale and seed.
enum class HeroSpecies {
  humilis,
  mediocris,
  congestus,
  calvus,
  incus,
  lenticularis,
  stratus_fractus,
  cirrus_uncinus,
  mammatus,
  altocumulus_castellanus
};
template <>
struct ChoiceNames<HeroSpecies> {
  static constexpr std::array<std::string_view, 10> names{
      "humilis",      "mediocris",       "congestus",      "calvus",   "incus",
      "lenticularis", "stratus_fractus", "cirrus_uncinus", "mammatus", "altocumulus_castellanus"};
};

// Where a hero cloud stands, how old it is and what it is made of.
struct HeroCloud {
  HeroSpecies species = HeroSpecies::congestus;
  glm::dvec3 position{0.0, 0.0, 1200.0};  // m
  float heading = 1.5708f;                // rad, compass
  float scale = 1.0f;
  int seed = 0;
  float age = 0.75f;
  float lifetime = 0.0f;    // s
  float extinction = 0.2f;  // 1/m
  float albedo = 1.0f;
  ScatteringPhase phase = ScatteringPhase::droplets;
  float dropletDiameter = 12.0f;  // um
  float asymmetry = 0.85f;
  float drift = 1.0f;
  float updraft = 1.0f;  // m/s
};
template <>
struct FieldTable<HeroCloud> {
  static auto make() {
    return fieldRows(
        field<&HeroCloud::species>("species",
                                   "what kind of cloud it is: sets all of its parameters but place, heading, scale and "
                                   "seed; whatever else stands in its tables wins"),
        field<&HeroCloud::position, kMetres>("position", {-1e7, 1e7}, {-10000, 10000},
                                             "the middle of its base: east, north, up"),
        field<&HeroCloud::heading, kDegrees>("heading", {-360, 360}, {0, 360},
                                             "compass heading of its length, toward which it leans and spreads"),
        field<&HeroCloud::scale>("scale", {0.01, 100}, {0.2, 3}, "of its size; edges and extinction stay"),
        field<&HeroCloud::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another cloud of its kind"),
        field<&HeroCloud::age>("age", {0, 1}, {},
                               "0 nothing yet, 0.15 a puff, 0.45 grown, 0.5 to 0.75 an anvil spreads if it has one, "
                               "0.8 to 1 it decays"),
        field<&HeroCloud::lifetime, kSeconds>("lifetime", {0, 1e6}, {0, 7200},
                                              "time in which the age goes from 0 to 1; 0: it stays"),
        field<&HeroCloud::extinction, kPerMetre>("extinction", {0, 1}, {0.005, 0.3}, "extinction of dense cloud"),
        albedoRow<&HeroCloud::albedo>(), phaseRow<&HeroCloud::phase>(), dropletRow<&HeroCloud::dropletDiameter>(),
        asymmetryRow<&HeroCloud::asymmetry>(),
        field<&HeroCloud::drift>("drift", {0, 2}, {0, 1}, "share of the wind that carries it"),
        field<&HeroCloud::updraft, kMetresPerSecond>("updraft", {0, 30}, {0, 10}, "rise of the billows through it"));
  }
};

// towers: a cluster of them, built of balls. rows: two rows of turrets on flat cloud. curve: a gradation curve swept
// round the axis (003 ch. 3.1.3). ellipsoid: half of one, with an exponent for the height (003 ch. 3.1.1, 3.1.2).
// plates: smooth ones stacked. patches: shreds. filaments: bundles of falling ice. pouches: a slab that hangs down in
// bags. classic: 003's own formula (eq. 3.4).
enum class HeroShape { towers, rows, curve, ellipsoid, plates, patches, filaments, pouches, classic };
template <>
struct ChoiceNames<HeroShape> {
  static constexpr std::array<std::string_view, 9> names{"towers",  "rows",      "curve",   "ellipsoid", "plates",
                                                         "patches", "filaments", "pouches", "classic"};
};

// The smooth shape.
struct HeroForm {
  HeroShape shape = HeroShape::towers;
  float width = 2600.0f;  // m, along the heading
  float breadth = 0.75f;
  float height = 3300.0f;  // m
  int parts = 14;
  float towerRadius = 0.19f;
  float rimRadius = 0.115f;
  float rimHeight = 0.25f;
  float waist = 0.12f;
  float lean = 0.05f;
  int pucks = 0;
  float exponent = 2.0f;
  glm::vec3 radiiLow{0.85f, 0.95f, 0.8f};
  glm::vec3 radiiHigh{0.62f, 0.5f, 0.0f};
  float anvil = 0.0f;  // m
  float anvilThickness = 0.11f;
  float anvilDensity = 0.03f;
};
template <>
struct FieldTable<HeroForm> {
  static auto make() {
    return fieldRows(
        field<&HeroForm::shape>("shape",
                                "towers, rows of turrets, a curve swept round the axis, ellipsoid, plates, patches, "
                                "filaments, pouches, or classic: the formula of [hero.classic]"),
        field<&HeroForm::width, kMetres>("width", {20, 100000}, {200, 12000}, "along the heading"),
        field<&HeroForm::breadth>("breadth", {0.05, 20}, {0.3, 2}, "across it, as a share of the width"),
        field<&HeroForm::height, kMetres>("height", {20, 20000}, {100, 12000}, "of the cloud above its base"),
        field<&HeroForm::parts>("parts", {1, 40}, {1, 20}, "how many towers, plates, patches or bundles of filaments"),
        field<&HeroForm::towerRadius>("tower_radius", {0.005, 0.6}, {0.05, 0.3},
                                      "of the tower in the middle, as a share of the width"),
        field<&HeroForm::rimRadius>("rim_radius", {0.005, 0.6}, {0.05, 0.3}, "of those at the rim"),
        field<&HeroForm::rimHeight>("rim_height", {0.02, 1}, {0.1, 1}, "height of those at the rim as a share"),
        field<&HeroForm::waist>("waist", {0, 0.5}, {0, 0.3}, "how much towers narrow halfway up"),
        field<&HeroForm::lean>("lean", {-2, 2}, {0, 0.5}, "metres toward the heading for each metre up"),
        field<&HeroForm::pucks>("pucks", {0, 20}, {0, 8}, "flat bulges that join the towers at the base"),
        field<&HeroForm::exponent>("exponent", {0.2, 10}, {0.5, 4}, "of the height, for shape ellipsoid"),
        field<&HeroForm::radiiLow>("radii_low", {0, 1}, {},
                                   "gradation curve: radius at 0, 0.2 and 0.4 of the height as a share of half the "
                                   "width, for shapes curve and classic"),
        field<&HeroForm::radiiHigh>("radii_high", {0, 1}, {}, "the same at 0.6, 0.8 and 1"),
        field<&HeroForm::anvil, kMetres>("anvil", {0, 200000}, {0, 20000}, "radius of an anvil on top; 0: none"),
        field<&HeroForm::anvilThickness>("anvil_thickness", {0.01, 0.5}, {0.05, 0.25},
                                         "of the anvil as a share of the height"),
        field<&HeroForm::anvilDensity>("anvil_density", {0, 1}, {0.005, 0.3}, "extinction of its ice as a share"));
  }
};

// The billows that displace the smooth shape, and its edge.
struct HeroSurface {
  float billow = 0.9f;
  float billowSize = 0.3f;
  float gain = 1.0f;
  int octaves = 6;
  float edge = 12.0f;  // m
  float topEdge = 1.0f;
  float topBillow = 1.0f;
  float wisp = 0.0f;
  float taper = 0.05f;
  float baseNoise = 0.02f;
  float baseBillow = 0.35f;
  float interior = 0.6f;
};
template <>
struct FieldTable<HeroSurface> {
  static auto make() {
    return fieldRows(
        field<&HeroSurface::billow>("billow", {0, 3}, {0, 1.4},
                                    "depth of the billows over their size: 0.3 wax, 0.6 soft, 0.9 cauliflower, 1.3 "
                                    "ragged; for pouches how far they hang"),
        field<&HeroSurface::billowSize>("billow_size", {0.02, 1}, {0.1, 0.5},
                                        "of the largest billows or the pouches, as a share of the cloud's size, which "
                                        "is the root of width times height"),
        field<&HeroSurface::gain>("gain", {0, 2}, {0.5, 1.2}, "1: each octave has half the depth of the one before"),
        field<&HeroSurface::octaves>("octaves", {0, 8}, {3, 7}, "how many sizes of billows, each half of the last"),
        field<&HeroSurface::edge, kMetres>("edge", {0.5, 2000}, {3, 120}, "way from clear air to full density"),
        field<&HeroSurface::topEdge>("top_edge", {0.1, 100}, {1, 20}, "edge of the top over that of the rest"),
        field<&HeroSurface::topBillow>("top_billow", {0, 1}, {}, "billows of the top, 0 where it has turned to ice"),
        field<&HeroSurface::wisp>("wisp", {0, 1}, {0, 0.2}, "how deep wind tears the lee side, as a share of the size"),
        field<&HeroSurface::taper>("taper", {0, 0.5}, {0, 0.15}, "how far the rim draws in at the base"),
        field<&HeroSurface::baseNoise>("base_noise", {0, 0.5}, {0, 0.1}, "unevenness of the flat base"),
        field<&HeroSurface::baseBillow>("base_billow", {0, 1}, {}, "strength of the billows at the base"),
        field<&HeroSurface::interior>("interior", {0, 1}, {}, "density just above the base, as a share"));
  }
};

// Shape "classic": the parameters of 003's two nodes by their names. Its gradation curve is radii_low and radii_high.
struct HeroClassic {
  float cloudScale = 1.0f;
  float density = 1.0f;
  float distortion = 0.6f;
  float overallScale = 0.5f;
  float worleyInfluence = 0.7f;
  float worleyClump = 0.5f;
  float wave = 0.0f;
  float noiseInfluence = 0.7f;
  float noiseScale = 1.0f;
  int noiseDetail = 5;
  float noiseWhisp = 0.5f;
  float windStrength = 0.0f;  // m/s
  glm::vec3 windDirection{1.0f, 0.0f, 0.0f};
  float stationary = 1.0f;
  float time = 0.0f;  // s
};
template <>
struct FieldTable<HeroClassic> {
  static auto make() {
    return fieldRows(
        field<&HeroClassic::cloudScale>("cloud_scale", {0.01, 10}, {0.2, 2},
                                        "Cloud Scale: of the coordinates; larger makes the cloud smaller in its box"),
        field<&HeroClassic::density>("density", {0, 100}, {0, 1}, "Density: factor on what the formula gives"),
        field<&HeroClassic::distortion>("distortion", {0, 10}, {0, 1}, "Distortion: degree of the noise's effect"),
        field<&HeroClassic::overallScale>("overall_scale", {0.01, 20}, {0.05, 1},
                                          "Overall Scale: of the texture; 1 is ten cells in the cloud's size"),
        field<&HeroClassic::worleyInfluence>("worley_influence", {0, 10}, {0, 1},
                                             "Worley Influence: of the cellular component"),
        field<&HeroClassic::worleyClump>("worley_clump", {0, 4}, {0, 1},
                                         "Worley Clump: gain of its second octave, which puffs the cloud up"),
        field<&HeroClassic::wave>("wave", {0, 1}, {}, "Wave: mixes the wave texture in, for cirrus"),
        field<&HeroClassic::noiseInfluence>("noise_influence", {0, 10}, {0, 1},
                                            "Noise Influence: of the simplex noise"),
        field<&HeroClassic::noiseScale>("noise_scale", {0.01, 20}, {0.1, 4}, "Noise Scale: of the simplex noise"),
        field<&HeroClassic::noiseDetail>("noise_detail", {1, 10}, {}, "Noise Detail: its octaves"),
        field<&HeroClassic::noiseWhisp>("noise_whisp", {0, 2}, {0, 1}, "Noise Whisp: its gain"),
        field<&HeroClassic::windStrength, kMetresPerSecond>("wind_strength", {0, 150}, {0, 40},
                                                            "Wind Strength: speed of the texture"),
        field<&HeroClassic::windDirection>(
            "wind_direction", {-1, 1}, {},
            "Wind Direction: where it goes, in the cloud's own axes; made a unit vector"),
        field<&HeroClassic::stationary>("stationary", {0, 1}, {},
                                        "Stationary: share of the cloud's place that the texture follows"),
        field<&HeroClassic::time, kSeconds>("time", {0, 1e7}, {0, 3600}, "Time: added to the sky's"));
  }
};

// A hero cloud with all its parts.
// Copies of it over the land round its place: it stays the one in the middle.
struct HeroScatter {
  float radius = 0.0f;      // m
  float spacing = 4000.0f;  // m
  float share = 0.6f;
  float variation = 0.3f;
  float turn = 0.4363323f;  // rad
};
template <>
struct FieldTable<HeroScatter> {
  static auto make() {
    return fieldRows(
        field<&HeroScatter::radius, kMetres>("radius", {0, 300000}, {0, 40000},
                                             "of the land on which copies stand; 0: none"),
        field<&HeroScatter::spacing, kMetres>("spacing", {0, 300000}, {500, 20000},
                                              "edge of the squares that hold a copy each; never less than it needs"),
        field<&HeroScatter::share>("share", {0, 1}, {}, "chance of a square to hold one"),
        field<&HeroScatter::variation>("variation", {0, 0.9}, {0, 0.6}, "half the range of their sizes"),
        field<&HeroScatter::turn, kDegrees>("turn", {0, 180}, {0, 90},
                                            "how far they turn from its heading; half of them are mirrored"));
  }
};

struct Hero {
  HeroCloud cloud;
  HeroForm form;
  HeroSurface surface;
  HeroClassic classic;
  HeroScatter scatter;
};

// The cloud without its copies.
inline Hero alone(Hero hero) {
  hero.scatter.radius = 0.0f;
  return hero;
}

// The cloud of a species: the defaults of all tables.
Hero heroPreset(HeroSpecies species);

// Gives a cloud another species; what the species does not decide stays.
void setSpecies(Hero& hero, HeroSpecies species);

}  // namespace welkin
