#pragma once
// Phase functions of what a scene's clouds are made of.
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/hero.hpp"
#include "welkin/density/layer.hpp"
#include "welkin/light/phase.hpp"

namespace welkin {

// Of a layer, of a cloud that comes as a volume, and of a hero cloud.
law::MiePhase phaseOf(const CloudLayer& cloud);
law::MiePhase phaseOf(const GridCloud& cloud);
law::MiePhase phaseOf(const HeroCloud& cloud);

}  // namespace welkin
