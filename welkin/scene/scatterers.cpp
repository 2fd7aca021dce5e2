#include "welkin/scene/scatterers.hpp"

namespace welkin {

namespace {

// A fit whose share of Draine's function is none is Henyey and Greenstein's.
law::MiePhase phaseOf(ScatteringPhase phase, float diameter, float asymmetry) {
  if (phase == ScatteringPhase::henyey_greenstein) return {asymmetry, 0.0f, 0.0f, 0.0f};
  return computeMiePhase(diameter);
}

}  // namespace

law::MiePhase phaseOf(const CloudLayer& cloud) { return phaseOf(cloud.phase, cloud.dropletDiameter, cloud.asymmetry); }
law::MiePhase phaseOf(const HeroCloud& cloud) { return phaseOf(cloud.phase, cloud.dropletDiameter, cloud.asymmetry); }
law::MiePhase phaseOf(const GridCloud& cloud) { return phaseOf(cloud.phase, cloud.dropletDiameter, cloud.asymmetry); }

}  // namespace welkin
