#pragma once
#include "welkin/base/fields.hpp"

namespace welkin {

// physical: multiple scattering by diffusion in a light volume, or by octaves. nubis: six cone samples, Beer-powder
// (004 ch. 4.4).
enum class LightingModel { physical, nubis };
template <>
struct ChoiceNames<LightingModel> {
  static constexpr std::array<std::string_view, 2> names{"physical", "nubis"};
};

// Of light that is scattered once. lobes: two Henyey-Greenstein lobes. droplets: the fit to Mie scattering (Jendersie
// and d'Eon 2023) for the first layer's droplet diameter. Later scatterings have lobes in both cases.
enum class PhaseModel { lobes, droplets };
template <>
struct ChoiceNames<PhaseModel> {
  static constexpr std::array<std::string_view, 2> names{"lobes", "droplets"};
};

// How clouds are lit in real time.
struct LightingSettings {
  LightingModel model = LightingModel::physical;
  PhaseModel phase = PhaseModel::droplets;
  int octaves = 5;
  float contribution = 0.75f;
  float octaveExtinction = 0.6f;
  float eccentricity = 0.5f;
  float octaveGain = 1.5f;
  float forwardG = 0.8f;
  float backwardG = -0.2f;
  float backwardWeight = 0.25f;
  float powder = 0.0f;
  float rainAbsorption = 1.0f;
  float ambient = 1.0f;
  float groundBounce = 1.0f;
};
template <>
struct FieldTable<LightingSettings> {
  static auto make() {
    return fieldRows(
        field<&LightingSettings::model>("model", "the lighting model"),
        field<&LightingSettings::phase>(
            "phase",
            "phase function of light that is scattered once: two lobes, or that of the first "
            "cloud: layer, or else classical cloud, hero cloud or volume"),
        field<&LightingSettings::octaves>("octaves", {1, 8}, {},
                                          "octaves of multiple scattering, where quality.light_volume is off"),
        field<&LightingSettings::contribution>("contribution", {0, 1}, {},
                                               "energy of each such octave against the last"),
        field<&LightingSettings::octaveExtinction>("octave_extinction", {0, 1}, {},
                                                   "extinction of each such octave against the last"),
        field<&LightingSettings::eccentricity>("eccentricity", {0, 1}, {},
                                               "forward peak of each such octave against the last"),
        field<&LightingSettings::octaveGain>("octave_gain", {0, 4}, {0.5, 2},
                                             "gain of every such octave but the first"),
        field<&LightingSettings::forwardG>("forward_g", {-0.99, 0.99}, {0, 0.95}, "mean cosine of the forward lobe"),
        field<&LightingSettings::backwardG>("backward_g", {-0.99, 0.99}, {-0.6, 0.2}, "mean cosine of the other lobe"),
        field<&LightingSettings::backwardWeight>("backward_weight", {0, 1}, {0, 0.5}, "share of the other lobe"),
        field<&LightingSettings::powder>("powder", {0, 1}, {}, "dark edges (004 4.4.4); nubis uses it in full"),
        field<&LightingSettings::rainAbsorption>("rain_absorption", {0, 10}, {0, 4},
                                                 "how much precipitation thickens the cloud for sunlight"),
        field<&LightingSettings::ambient>("ambient", {0, 4}, {0, 2}, "light of the sky, 1 is physical"),
        field<&LightingSettings::groundBounce>("ground_bounce", {0, 4}, {0, 1.5},
                                               "light from the ground, 1 is an unshaded ground"));
  }
};

}  // namespace welkin
