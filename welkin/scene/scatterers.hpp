#pragma once
// Phase functions of what a scene's clouds are made of.
#include <optional>

#include "welkin/light/phase.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// Of a layer, of a cloud that comes as a volume, of a classical and of a hero cloud.
law::MiePhase phaseOf(const CloudLayer& cloud);
law::MiePhase phaseOf(const GridCloud& cloud);
law::MiePhase phaseOf(const ClassicalCloud& cloud);
law::MiePhase phaseOf(const HeroCloud& cloud);

// What light meets in a cloud.
struct Scatterers {
  float albedo, dropletDiameter;  // um
  law::MiePhase phase;
};

// Of the cloud that stands for all where a renderer or a file has but one kind: the first layer, or else the first
// classical cloud, hero cloud or volume. None where there are only sheets.
std::optional<Scatterers> leadingScatterers(const Scene& scene);

}  // namespace welkin
