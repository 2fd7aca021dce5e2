#pragma once
// Phase functions of what a scene's clouds are made of.
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/layer.hpp"
#include "welkin/light/phase.hpp"

namespace welkin {

// Of a layer or of a cloud that comes as a volume.
law::MiePhase phaseOf(const CloudLayer& cloud);
law::MiePhase phaseOf(const GridCloud& cloud);

}  // namespace welkin
