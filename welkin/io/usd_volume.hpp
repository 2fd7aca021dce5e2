#pragma once
// A USD stage (.usda) that shows OpenVDB files as volumes: what Solaris, Omniverse and Blender's USD import ask for.
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace welkin {

struct UsdVolume {
  std::vector<std::string> files;  // one for each frame; names beside the stage
  glm::dvec3 low, high;            // its box
};

struct UsdStage {
  std::string title;
  double metresPerUnit = 1.0;
  char upAxis = 'Z';
  int firstFrame = 0;
  double framesPerSecond = 24.0;
};

// The stage's text. Several files to a volume become time samples.
std::string usdStage(const UsdStage& stage, std::span<const UsdVolume> volumes);

}  // namespace welkin
