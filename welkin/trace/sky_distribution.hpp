#pragma once
// Directions of the sky by its brightness, for skies that come from a table: bright spots that the phase function of a
// scattering would find by chance only.
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace welkin::trace {

// Cells of equal solid angle, drawn by an alias table (Vose 1991). One row of cells after the other, upward.
struct SkyDistributionView {
  static constexpr int kRows = 64, kColumns = 128;  // of z in [-1, 1] and of azimuth
  const float* keep = nullptr;                      // chance that a cell, once chosen, stands for itself
  const int* alias = nullptr;                       // what it stands for otherwise
  const float* density = nullptr;                   // 1/sr
  float share = 0.0f;  // of the questions for light that go to the sky, not the sun; 0: no table
};

class SkyDistribution {
 public:
  SkyDistribution() = default;
  // `luminance`: of the light from a unit direction. `sun`: illuminance of the sun, in the same unit times sr.
  SkyDistribution(const std::function<float(const glm::vec3&)>& luminance, float sun);
  SkyDistributionView view() const { return {keep_.data(), alias_.data(), density_.data(), share_}; }

 private:
  std::vector<float> keep_, density_;
  std::vector<int> alias_;
  float share_ = 0.0f;
};

}  // namespace welkin::trace
