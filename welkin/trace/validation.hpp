#pragma once
// The solver held against published and exact numbers (published.hpp).
#include <functional>
#include <string>
#include <vector>

#include "welkin/trace/flux.hpp"

namespace welkin {

struct ValidationRow {
  std::string section, name, source;
  FluxEstimate ours;  // se 0: no sampling is involved
  double theirs = 0.0;
  double gate = 0.0;  // |ours - theirs| may be this much
  bool passes() const;
  double differenceInSe() const;  // 0 where there is no se
};

enum class ValidationEffort {
  quick,  // a twentieth of the photons: rows are gated by their wider standard errors
  full,
};

struct ValidationSettings {
  ValidationEffort effort = ValidationEffort::full;
  // The phase function for an asymmetry. Another one is for seeing that the suite fails then.
  std::function<PhaseTable(double g)> henyeyGreenstein = PhaseTable::henyeyGreenstein;
};

// Runs the suite. Fluxes are gated at the larger of 4 standard errors and 1e-3, radiances at that of 4 standard errors
// and 1 %, closed forms at the digits that are printed.
std::vector<ValidationRow> validate(const ValidationSettings& settings, const Progress& progress = {});

}  // namespace welkin
