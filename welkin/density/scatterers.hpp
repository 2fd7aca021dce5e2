#pragma once
// What clouds are made of, as far as light sees it.
#include "welkin/base/fields.hpp"

namespace welkin {

// droplets: the fit to Mie scattering for their diameter (Jendersie and d'Eon 2023). henyey_greenstein: that of one
// mean cosine, which other renderers have too.
enum class ScatteringPhase { droplets, henyey_greenstein };
template <>
struct ChoiceNames<ScatteringPhase> {
  static constexpr std::array<std::string_view, 2> names{"droplets", "henyey_greenstein"};
};

// Rows of what every kind of cloud says of its droplets, whose members are a struct's own.
template <auto Albedo>
Field albedoRow() {
  return field<Albedo>("albedo", {0, 1}, {0.9, 1}, "single-scattering albedo, for the path tracer");
}
template <auto Phase>
Field phaseRow() {
  return field<Phase>("phase", "phase function; in real time that of the first cloud serves all");
}
template <auto Diameter>
Field dropletRow() {
  return field<Diameter, kMicrometres>("droplet_diameter", {5, 50}, {5, 40},
                                       "diameter of the droplets, for phase droplets");
}
template <auto Asymmetry>
Field asymmetryRow() {
  return field<Asymmetry>("asymmetry", {-0.99, 0.99}, {0.7, 0.9},
                          "mean cosine of scattering, for phase henyey_greenstein");
}

}  // namespace welkin
