#pragma once
// Pictures of one cloud by Blender's Cycles, under the sun and a sky of one radiance: bench/cycles.py draws them.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "welkin/atmosphere/params.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/atmosphere/tables.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin::bench {

// The sun and a sky of one radiance, no air and black ground: what both renderers can be given alike.
inline Scene clearScene() {
  Scene scene = loadSky(WELKIN_SOURCE_DIR "/presets/cumulus.sky.toml");
  // One cloud for good, whatever the preset becomes.
  scene.seed = 3;
  scene.layers.front().weather.roughness = 0.35f;
  scene.layers.front().profile.erosion = 0.65f;
  Atmosphere& air = scene.atmosphere;
  air.rayleigh = air.mie = air.ozone = air.haze = 0.0f;
  air.model = SkyKind::gradient;
  air.gradientHorizon = air.gradientZenith = {3.0f, 5.0f, 9.0f};
  air.gradientGlow = glm::vec3(0.0f);
  scene.ground.albedo = glm::vec3(0.0f);
  return scene;
}

inline std::string listOf(const glm::dvec3& v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z); }

// "extinction", the medium's in 1/m where the density is 1, and "asymmetry", as members of a JSON object.
inline std::string mediumText(float extinction, float asymmetry) {
  return fmt::format("\"extinction\": {:.9g}, \"asymmetry\": {}", extinction, asymmetry);
}

// A cloud from a file, as such members too.
inline std::string volumeText(const std::string& file, const glm::dvec3& location, double voxel) {
  return fmt::format("\"volume\": \"{}\", \"location\": {}, \"voxel\": {:.9g}", file, listOf(location), voxel);
}

struct Shot {
  std::string name;
  int samples, scatterings, seed;
  double stepRate;
};

// Throws Error where there is no Blender.
inline void requireBlender() {
  if (std::system("command -v blender > /dev/null") != 0)
    throw Error(ErrorKind::failed, "", "there is no blender on the path (Debian: blender); it draws the other half");
}

// Lets one Blender draw the shots into the folder, NAME.exr; `cloud`: members of a JSON object. Answers CPU seconds of
// each. Throws Error (failed) with all that Blender has said.
inline std::map<std::string, double> runCycles(const Scene& scene, const std::string& cloud, int width, int height,
                                               const std::string& folder, const std::vector<Shot>& shots) {
  const Camera& camera = scene.camera;
  const glm::dvec3 sun = sunDirection(scene.sun);
  const SkyParams sky = makeSkyParams(scene.atmosphere, glm::vec3(sun), camera.position.z, scene.ground.albedo);
  std::string list;
  for (const Shot& shot : shots)
    list += fmt::format("{}{{\"name\": \"{}\", \"samples\": {}, \"scatterings\": {}, \"seed\": {}, \"step_rate\": {}}}",
                        list.empty() ? "" : ", ", shot.name, shot.samples, shot.scatterings, shot.seed, shot.stepRate);
  const std::string settings = folder + "/cycles.json";
  writeBytes(settings,
             fmt::format("{{\"folder\": \"{}\", {}, \"to_sun\": {}, \"sun_angle\": {:.9g}, "
                         "\"irradiance\": {}, \"sky\": {}, \"horizon\": {:.9g}, \"eye\": {}, \"backward\": {}, "
                         "\"fov\": {:.9g}, \"width\": {}, \"height\": {}, \"shots\": [{}]}}\n",
                         folder, cloud, listOf(sun), 2.0 * sky.air.sunDirection.w, listOf(sky.air.sunIrradiance),
                         listOf(scene.atmosphere.gradientZenith), std::sin(sky.air.horizonElevation),
                         listOf(camera.position), listOf(-cameraAxes(camera)[2]), camera.fov, width, height, list));
  const std::string command = "blender -b --factory-startup -noaudio --python-exit-code 1 --python '" WELKIN_SOURCE_DIR
                              "/bench/cycles.py' -- '" +
                              settings + "' 2>&1";
  std::map<std::string, double> seconds;
  std::string said;
  FILE* pipe = ::popen(command.c_str(), "r");
  for (char line[4096]; pipe && std::fgets(line, sizeof line, pipe);) {
    char name[256];
    double value = 0.0;
    if (std::sscanf(line, "SHOT %255s %lf", name, &value) == 2) {
      seconds[name] = value;
      fmt::print("  Cycles {} {:.1f} s\n", name, value);
      std::fflush(stdout);
    }
    said += line;
  }
  if (!pipe || ::pclose(pipe) != 0 || seconds.size() != shots.size())
    throw Error(ErrorKind::failed, "blender", "Blender did not draw all pictures; it said\n" + said);
  return seconds;
}

inline double luminanceOf(const float* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

}  // namespace welkin::bench
