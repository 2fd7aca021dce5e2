#pragma once
// Any phase function as a table for sampling.
//
// The table answers in the versine 1 - cosTheta, in [0, 2]: a droplet's forward peak is narrower than the step between
// two floats near cosTheta = 1. [0, 2] is cut into kCells cells of equal probability, so the peak is resolved by
// itself; a cell is one or more segments, on each of which the density of the samples is linear. `pdf` is exactly the
// density of `sample`; what is left of the phase function's shape is the weight evaluate / pdf: within 0.5 % of 1 for
// Henyey-Greenstein up to g = 0.99 and droplets up to 20 um (mean square below 1e-8), and exactly 1 for a tabulated
// function, which is linear on its segments itself.
// SIMD reading: phase_table-inl.hpp.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/light/phase.hpp"

namespace welkin {

// The table's arrays; valid as long as the PhaseTable that handed them out.
struct PhaseTableView {
  law::MiePhase mie;  // the function, unless it is tabulated
  int rows = 0;       // > 0: tabulated, linear between these
  const float *rowVersine = nullptr, *rowValue = nullptr;
  int segments = 0, segmentSteps = 0, rowSteps = 0;  // bisection steps that find a versine among all segments, rows
  int cellSteps = 0;                                 // and a segment in its cell: 0 when each is one
  const std::int32_t* firstSegment = nullptr;        // kCells + 1
  const float *fraction = nullptr, *mass = nullptr;  // a segment's place in its cell's probability: start and share
  const float *versine = nullptr, *width = nullptr;  // its place in [0, 2]
  const float *low = nullptr, *high = nullptr;       // density at its ends, 1/sr
};

class PhaseTable {
 public:
  static constexpr int kCells = 4096;

  // Henyey and Greenstein 1941. Throws Error (badInput) unless |g| <= 0.999.
  static PhaseTable henyeyGreenstein(double g);
  // The fit of Jendersie and d'Eon 2023 to droplets of one diameter (see computeMiePhase).
  static PhaseTable mie(const law::MiePhase& mie);
  // A measured or computed function: scattering angles in degrees, ascending from 0 to 180, and values of any scale,
  // linear in cosTheta between them; normalised to 1 over the sphere. Throws Error (badInput) for anything else.
  static PhaseTable tabulated(std::span<const double> degrees, std::span<const double> values);
  // The same from text: two columns, `#` starts a comment. `where` names the text in errors, which carry the line.
  static PhaseTable parse(std::string_view text, const std::string& where);

  struct Sample {
    float versine, pdf;  // pdf in 1/sr
  };
  Sample sample(float u) const;         // u in [0, 1)
  float pdf(float versine) const;       // 1/sr
  float evaluate(float versine) const;  // the phase function, 1/sr
  double meanCosine() const { return meanCosine_; }

  PhaseTableView view() const;

 private:
  PhaseTable() = default;
  void addSegment(double fraction, double mass, double from, double to, double low, double high);

  law::MiePhase mie_{};
  double meanCosine_ = 0.0;
  int cellSteps_ = 0;
  std::vector<float> rowVersine_, rowValue_;
  std::vector<std::int32_t> firstSegment_;
  std::vector<float> fraction_, mass_, versine_, width_, low_, high_;
};

}  // namespace welkin
