#pragma once
// What other programs expect of volumes, and what to type into them afterwards.
#include <optional>
#include <string>

#include "apps/welkin/volume_plan.hpp"

namespace welkin::app {

enum class VolumeTarget { blender, houdini, unreal, mitsuba, pbrt };
std::optional<VolumeTarget> volumeTargetNamed(const std::string& name);

// Axes, unit and meaning that the program expects.
VolumeConvention conventionFor(VolumeTarget target);
// Suffix of the file that it reads.
std::string suffixFor(VolumeTarget target);

// The medium that a file stands for.
struct VolumeMedium {
  double extinction = 0.0;  // 1/m at the value 1
  double albedo = 1.0;
  double asymmetry = 0.0;  // mean cosine
};
VolumeMedium mediumOf(const Scene& scene, VolumeDensity density);

// A few lines that say which numbers to enter there; for no target, what they are.
std::string instructionsFor(std::optional<VolumeTarget> target, const VolumeMedium& medium,
                            const VolumeConvention& convention, const VoxelBox& box, const std::string& file);

}  // namespace welkin::app
