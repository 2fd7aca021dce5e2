#pragma once
// A sky as a picture of all directions: drawn in tiles, finished, and written with its sidecar.
#include <string>

#include "apps/welkin/traced.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/scene/environment.hpp"

namespace welkin::app {

// Which program's axes the picture is made for; `none` puts north in the middle.
enum class EnvironmentTarget { none, blender, usd, three, unreal };

struct EnvironmentOptions {
  EnvironmentLayout layout = EnvironmentLayout::latlong;
  EnvironmentTarget target = EnvironmentTarget::none;
  int size = 4096;             // width of a latlong picture, four times that of a face
  double centerHeading = 0.0;  // rad
  SunTreatment sun{};
  int frames = 0;  // marches a pixel; 0 for the usual number
  Progress progress{};
};

struct Environment {
  Image light;  // linear RGB in kcd/m^2
  std::optional<DirectionalLight> lost;
  glm::dvec3 upward{0.0};  // klx on a plane facing up, `lost` included
};

// The heading of the picture's middle that a target expects, in rad, for a world with +x east and north as it is usual
// there (docs/hdri.md).
double centerHeadingOf(EnvironmentTarget target);

// By the real-time renderer, from the scene's camera, in tiles of bounded size. Throws Error (noOpenGl).
Environment renderEnvironment(const Scene& scene, const EnvironmentOptions& options);

// The same, path-traced.
Environment traceEnvironment(const Scene& scene, const EnvironmentOptions& options, const TraceOptions& trace);

// Writes path (.exr or .hdr) and path.json.
void saveEnvironment(const std::string& path, const Environment& environment, const Scene& scene,
                     const EnvironmentOptions& options);

}  // namespace welkin::app
