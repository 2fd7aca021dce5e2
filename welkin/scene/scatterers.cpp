#include "welkin/scene/scatterers.hpp"

namespace welkin {

namespace {

// A fit whose share of Draine's function is none is Henyey and Greenstein's.
template <class Cloud>
law::MiePhase phaseOfDroplets(const Cloud& cloud) {
  if (cloud.phase == ScatteringPhase::henyey_greenstein) return {cloud.asymmetry, 0.0f, 0.0f, 0.0f};
  return computeMiePhase(cloud.dropletDiameter);
}

}  // namespace

law::MiePhase phaseOf(const CloudLayer& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const HeroCloud& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const GridCloud& cloud) { return phaseOfDroplets(cloud); }
law::MiePhase phaseOf(const ClassicalCloud& cloud) { return phaseOfDroplets(cloud); }

}  // namespace welkin
