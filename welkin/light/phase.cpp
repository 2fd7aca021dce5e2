#include "welkin/light/phase.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {

namespace {
constexpr double kSmallest = 5.0, kLargest = 50.0;  // um, the range of the fit
}

law::MiePhase computeMiePhase(double diameter) {
  const double d = std::clamp(diameter, kSmallest, kLargest);
  return {static_cast<float>(std::exp(-0.0990567 / (d - 1.67154))),
          static_cast<float>(std::exp(-2.20679 / (d + 3.91029) - 0.428934)),
          static_cast<float>(std::exp(3.62489 - 8.29288 / (d + 5.52825))),
          static_cast<float>(std::exp(-0.599085 / (d - 0.641583) - 0.665888))};
}

double meanCosine(const law::MiePhase& mie) {
  const double g = mie.gDraine, a = mie.alpha;
  const double draine = g * (1.0 + a * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + a * (1.0 + 2.0 * g * g) / 3.0);
  return (1.0 - mie.wDraine) * mie.gHG + mie.wDraine * draine;
}

double diameterFromMeanCosine(double g) {
  double low = kSmallest, high = kLargest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (meanCosine(computeMiePhase(middle)) < g ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace welkin
