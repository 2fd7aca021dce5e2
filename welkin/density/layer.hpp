#pragma once
// Plain values that describe a layer of volumetric clouds and a thin high sheet. Lengths in metres above the ground's
// zero, unless said otherwise.
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "welkin/base/fields.hpp"
#include "welkin/density/scatterers.hpp"

namespace welkin {

// The ten genera of the WMO; `none` for a layer that is not meant to be one of them.
enum class Genus {
  none,
  cirrus,
  cirrocumulus,
  cirrostratus,
  altocumulus,
  altostratus,
  nimbostratus,
  stratocumulus,
  stratus,
  cumulus,
  cumulonimbus
};
template <>
struct ChoiceNames<Genus> {
  static constexpr std::array<std::string_view, 11> names{"none",        "cirrus",      "cirrocumulus", "cirrostratus",
                                                          "altocumulus", "altostratus", "nimbostratus", "stratocumulus",
                                                          "stratus",     "cumulus",     "cumulonimbus"};
};

// profile: height field in metres minus noise in metres. nubis: Schneider's model (000 ch. 2.3, 004 ch. 4.3).
enum class LayerShape { profile, nubis };
template <>
struct ChoiceNames<LayerShape> {
  static constexpr std::array<std::string_view, 2> names{"profile", "nubis"};
};

// How the clouds of a layer are spread over the land.
enum class Population { domes, clusters, streets, cells, front, uniform };
template <>
struct ChoiceNames<Population> {
  static constexpr std::array<std::string_view, 6> names{"domes", "clusters", "streets", "cells", "front", "uniform"};
};

// Where the clouds of a layer stand: the authoring values (coverage, precipitation, type, base height) and the
// generator that turns them into what the shape needs.
struct WeatherSettings {
  Population population = Population::clusters;
  float coverage = 0.42f;
  float precipitation = 0.0f;
  float type = 0.5f;
  float cellSize = 3800.0f;      // m
  float sizeExponent = 2.2f;     // p(r) ~ r^-sizeExponent
  float clusterSize = 10000.0f;  // m
  float clustering = 0.9f;
  float roughness = 0.35f;
  float orientation = 1.5708f;    // rad, compass
  float streetSpacing = 2800.0f;  // m
  float stretch = 1.0f;
  float anvil = 0.0f;
  std::string map;            // picture: red coverage, green precipitation, blue type, alpha base height
  float mapSize = 60000.0f;   // m
  float mapBaseRange = 0.0f;  // m
};
template <>
struct FieldTable<WeatherSettings> {
  static auto make() {
    return fieldRows(
        field<&WeatherSettings::population>(
            "population",
            "how clouds are spread: single domes, clusters of domes, streets along the wind, closed "
            "cells, a front, or a uniform sheet"),
        field<&WeatherSettings::coverage>("coverage", {0, 1}, {}, "share of the sky that is given to clouds"),
        field<&WeatherSettings::precipitation>("precipitation", {0, 1}, {},
                                               "chance of rain; darkens the bases and, for nubis, turns the type"),
        field<&WeatherSettings::type>("type", {0, 1}, {},
                                      "0 flat and shallow, 0.5 in between, 1 tall (nubis: stratus, stratocumulus, "
                                      "cumulus)"),
        field<&WeatherSettings::cellSize, kMetres>("cell_size", {200, 100000}, {500, 20000},
                                                   "diameter of the largest cloud or cell"),
        field<&WeatherSettings::sizeExponent>("size_exponent", {0.5, 4}, {1.2, 3.2},
                                              "number of clouds of radius r falls as r to this power"),
        field<&WeatherSettings::clusterSize, kMetres>("cluster_size", {1000, 200000}, {4000, 40000},
                                                      "distance between clusters"),
        field<&WeatherSettings::clustering>("clustering", {0, 1.5}, {0, 1}, "0 evenly scattered, 1 strongly clustered"),
        field<&WeatherSettings::roughness>("roughness", {0, 1}, {}, "warp of the clouds' outlines"),
        field<&WeatherSettings::orientation, kDegrees>("orientation", {0, 360}, {},
                                                       "compass heading along which streets, fronts and rolls run"),
        field<&WeatherSettings::streetSpacing, kMetres>("street_spacing", {500, 50000}, {1500, 8000},
                                                        "distance between cloud streets"),
        field<&WeatherSettings::stretch>("stretch", {1, 12}, {1, 4},
                                         "length over width of closed cells, which become rolls along the orientation"),
        field<&WeatherSettings::anvil>("anvil", {0, 1}, {}, "how far an anvil spreads from the tallest towers"),
        fileField<&WeatherSettings::map>("map",
                                         "picture that replaces the generator's authoring map: red coverage, green "
                                         "precipitation, blue type, alpha base height"),
        field<&WeatherSettings::mapSize, kMetres>("map_size", {1000, 1e7}, {10000, 500000},
                                                  "edge of the land that the picture covers; it repeats beyond"),
        field<&WeatherSettings::mapBaseRange, kMetres>("map_base_range", {0, 5000}, {0, 2000},
                                                       "how far the picture's alpha raises the base"));
  }
};

// Shape "profile" (see docs/model.md).
struct ProfileSettings {
  float baseVariation = 40.0f;  // m
  float lengthScale = 900.0f;   // m
  float lengthFraction = 0.9f;
  float minLength = 300.0f;  // m
  float erosion = 0.65f;
  float baseErosion = 0.9f;
  float baseCut = 0.25f;
  float noiseTile = 3000.0f;  // m
  float billowMix = 0.75f;
  float warp = 400.0f;        // m
  float detail = 160.0f;      // m
  float detailTile = 700.0f;  // m
  float fineDetail = 60.0f;   // m
  float fineTile = 130.0f;    // m
  float ramp = 30.0f;         // m
  float baseFade = 40.0f;     // m
  float baseRagged = 25.0f;   // m
  float liquidGradient = 0.3f;
  float anvilDensity = 0.15f;
};
template <>
struct FieldTable<ProfileSettings> {
  static auto make() {
    return fieldRows(
        field<&ProfileSettings::baseVariation, kMetres>("base_variation", {0, 500}, {0, 100},
                                                        "how much the height of the flat base varies"),
        field<&ProfileSettings::lengthScale, kMetres>("length_scale", {50, 5000}, {200, 2000},
                                                      "amplitude of the noise in tall clouds"),
        field<&ProfileSettings::lengthFraction>("length_fraction", {0, 2}, {}, "amplitude as a share of the height"),
        field<&ProfileSettings::minLength, kMetres>("min_length", {10, 2000}, {60, 600},
                                                    "least amplitude, that of the thinnest cloud"),
        field<&ProfileSettings::erosion>("erosion", {0, 2}, {0.4, 1.2},
                                         "0 smooth domes, 0.8 cauliflower, above ragged"),
        field<&ProfileSettings::baseErosion>("base_erosion", {0, 1}, {}, "erosion at the base as a share of erosion"),
        field<&ProfileSettings::baseCut>("base_cut", {0, 1}, {0, 0.5}, "how far the outline draws in at the base"),
        field<&ProfileSettings::noiseTile, kMetres>("noise_tile", {200, 20000}, {1300, 7000},
                                                    "edge of the shape noise's tile: about twice the cloud's depth"),
        field<&ProfileSettings::billowMix>("billow_mix", {0, 1}, {}, "0 Perlin-Worley, 1 billows"),
        field<&ProfileSettings::warp, kMetres>("warp", {0, 5000}, {0, 2500}, "overhangs: sideways warp of the columns"),
        field<&ProfileSettings::detail, kMetres>("detail", {0, 1000}, {0, 400}, "depth of the detail noise"),
        field<&ProfileSettings::detailTile, kMetres>("detail_tile", {50, 5000}, {300, 1500}, "edge of its tile"),
        field<&ProfileSettings::fineDetail, kMetres>("fine_detail", {0, 500}, {0, 120}, "depth of the finest noise"),
        field<&ProfileSettings::fineTile, kMetres>("fine_tile", {20, 2000}, {80, 400}, "edge of its tile"),
        field<&ProfileSettings::ramp, kMetres>("ramp", {1, 2000}, {8, 450}, "width of the edge: 30 water, 450 ice"),
        field<&ProfileSettings::baseFade, kMetres>("base_fade", {1, 1000}, {20, 200}, "width of the base's edge"),
        field<&ProfileSettings::baseRagged, kMetres>("base_ragged", {0, 500}, {0, 100}, "raggedness of the base"),
        field<&ProfileSettings::liquidGradient>("liquid_gradient", {0, 1}, {},
                                                "how much the density grows with height above the base"),
        field<&ProfileSettings::anvilDensity>("anvil_density", {0, 1}, {0.05, 0.4},
                                              "density of the anvil as a share of the tower's"));
  }
};

// How relative height turns the wispy detail into billows (eq. 2.30 and 004 differ, see docs/sources.md).
enum class DetailTransition { saturated, linear };
template <>
struct ChoiceNames<DetailTransition> {
  static constexpr std::array<std::string_view, 2> names{"saturated", "linear"};
};

// Shape "nubis".
struct NubisSettings {
  float baseTile = 9000.0f;      // m
  float detailTile = 900.0f;     // m
  float curlTile = 3000.0f;      // m
  float curlAmplitude = 150.0f;  // m
  float detailErosion = 0.2f;
  float weatherTile = 60000.0f;  // m, feature size of the procedural map
  DetailTransition transition = DetailTransition::saturated;
};
template <>
struct FieldTable<NubisSettings> {
  static auto make() {
    return fieldRows(
        field<&NubisSettings::baseTile, kMetres>("base_tile", {500, 100000}, {3000, 30000},
                                                 "edge of the base shape's tile"),
        field<&NubisSettings::detailTile, kMetres>("detail_tile", {50, 20000}, {300, 3000},
                                                   "edge of the detail's tile"),
        field<&NubisSettings::curlTile, kMetres>("curl_tile", {100, 100000}, {1000, 10000}, "edge of the curl's tile"),
        field<&NubisSettings::curlAmplitude, kMetres>("curl_amplitude", {0, 2000}, {0, 500},
                                                      "displacement of the detail at the base"),
        field<&NubisSettings::detailErosion>("detail_erosion", {0, 1}, {0, 0.5}, "0.2 in eq. 2.30"),
        field<&NubisSettings::weatherTile, kMetres>("weather_tile", {5000, 1e6}, {20000, 120000},
                                                    "size of the largest pattern of coverage"),
        field<&NubisSettings::transition>("transition",
                                          "from wisps to billows: saturate(10 h) (004) or linear in h (000 eq. 2.30)"));
  }
};

// One layer of volumetric clouds.
struct CloudLayer {
  LayerShape shape = LayerShape::profile;
  Genus genus = Genus::cumulus;
  float base = 1200.0f;       // m
  float thickness = 1700.0f;  // m
  float extinction = 0.1f;    // 1/m
  float albedo = 1.0f;
  ScatteringPhase phase = ScatteringPhase::droplets;
  float dropletDiameter = 12.0f;  // um
  float asymmetry = 0.85f;
  float shear = 0.0f;        // m of sideways offset from base to top
  float detailDrift = 1.3f;  // speed of the detail noise relative to the wind
  float updraft = 0.5f;      // m/s
  int seed = 0;
};
template <>
struct FieldTable<CloudLayer> {
  static auto make() {
    return fieldRows(
        field<&CloudLayer::shape>("shape", "how the clouds are modelled"),
        field<&CloudLayer::genus>("genus", "what they are called; a name for people, it changes nothing"),
        field<&CloudLayer::base, kMetres>("base", {0, 20000}, {0, 12000}, "height of the cloud base"),
        field<&CloudLayer::thickness, kMetres>("thickness", {20, 20000}, {100, 12000},
                                               "from the base to the highest top"),
        field<&CloudLayer::extinction, kPerMetre>("extinction", {0, 1}, {0.005, 0.2}, "extinction of dense cloud"),
        field<&CloudLayer::albedo>("albedo", {0, 1}, {0.9, 1}, "single-scattering albedo of a droplet"),
        phaseRow<&CloudLayer::phase>(), dropletRow<&CloudLayer::dropletDiameter>(),
        asymmetryRow<&CloudLayer::asymmetry>(),
        field<&CloudLayer::shear, kMetres>("shear", {0, 20000}, {0, 3000}, "how far the wind leans the tops"),
        field<&CloudLayer::detailDrift>("detail_drift", {0, 5}, {0, 2}, "speed of the detail as a share of the wind"),
        field<&CloudLayer::updraft, kMetresPerSecond>("updraft", {0, 20}, {0, 3}, "rise of the noise inside the cloud"),
        field<&CloudLayer::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another sky"));
  }
};

// A layer with all its parts.
struct Layer {
  CloudLayer cloud;
  WeatherSettings weather;
  ProfileSettings profile;
  NubisSettings nubis;
};

enum class SheetKind { cirrus, cirrostratus, cirrocumulus, altocumulus };
template <>
struct ChoiceNames<SheetKind> {
  static constexpr std::array<std::string_view, 4> names{"cirrus", "cirrostratus", "cirrocumulus", "altocumulus"};
};

// A thin high cloud: a drifting two-dimensional field of optical depth (004 ch. 4.5.4).
struct Sheet {
  SheetKind kind = SheetKind::cirrus;
  float height = 9000.0f;  // m
  float opticalDepth = 0.25f;
  float coverage = 0.5f;
  float tile = 9000.0f;  // m
  float stretch = 4.0f;
  float warp = 3500.0f;      // m
  float orientation = 1.2f;  // rad
  float windSpeed = 25.0f;   // m/s
  float windFrom = 4.7124f;  // rad
  int seed = 0;
};
template <>
struct FieldTable<Sheet> {
  static auto make() {
    return fieldRows(
        field<&Sheet::kind>("kind", "what the sheet looks like"),
        field<&Sheet::height, kMetres>("height", {500, 20000}, {2000, 13000}, "height above the ground"),
        field<&Sheet::opticalDepth>("optical_depth", {0, 20}, {0.02, 3}, "vertical optical depth where it is full"),
        field<&Sheet::coverage>("coverage", {0, 1}, {}, "share of the sky that it covers"),
        field<&Sheet::tile, kMetres>("tile", {200, 100000}, {1000, 20000}, "size of its largest features"),
        field<&Sheet::stretch>("stretch", {1, 20}, {1, 8}, "length over width of the fibres"),
        field<&Sheet::warp, kMetres>("warp", {0, 20000}, {0, 6000}, "how strongly the fibres curl"),
        field<&Sheet::orientation, kDegrees>("orientation", {0, 360}, {}, "compass heading of the fibres"),
        field<&Sheet::windSpeed, kMetresPerSecond>("wind_speed", {0, 150}, {0, 60}, "speed of the wind up there"),
        field<&Sheet::windFrom, kDegrees>("wind_from", {0, 360}, {}, "where that wind comes from"),
        field<&Sheet::seed>("seed", {0, 2147483647}, {0, 100}, "another seed, another sheet"));
  }
};

}  // namespace welkin
