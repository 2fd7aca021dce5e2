#include "apps/welkin/environment_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "welkin/atmosphere/params.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/file.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/io/hdr.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

// The axes of a target: what it is called, its axes in words, and the heading of the picture's middle.
struct Axes {
  const char *name, *text;
  glm::dvec3 (*fromWorld)(const glm::dvec3&);  // of east, north, up
  double heading;
};
glm::dvec3 zUp(const glm::dvec3& d) { return d; }
glm::dvec3 yUp(const glm::dvec3& d) { return {d.x, d.z, -d.y}; }
glm::dvec3 leftHanded(const glm::dvec3& d) { return {d.x, -d.y, d.z}; }
constexpr Axes kAxes[] = {{"none", "+x east, +y north, +z up", zUp, 0.0},
                          {"blender", "+x east, +y north, +z up", zUp, 90.0},
                          {"usd", "+x east, +y up, -z north", yUp, 180.0},
                          {"three", "+x east, +y up, -z north", yUp, 90.0},
                          {"unreal", "+x east, +y south, +z up", leftHanded, 0.0}};
const Axes& axesOf(EnvironmentTarget target) { return kAxes[static_cast<std::size_t>(target)]; }

double degrees(double radians) { return std::round(radians / kDegree * 1e6) / 1e6; }
double heading(const glm::dvec3& d) {
  const double h = degrees(std::atan2(d.x, d.y));
  return h < 0.0 ? h + 360.0 : h;
}
double elevation(const glm::dvec3& d) { return degrees(std::asin(std::clamp(d.z, -1.0, 1.0))); }
double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Json lightJson(const DirectionalLight& light, const Axes& axes) {
  const glm::dvec3 d = axes.fromWorld(light.direction);
  const double lux = luminance(light.illuminance) * 1000.0;
  const glm::dvec3 colour = lux > 0.0 ? light.illuminance * (1000.0 / lux) : glm::dvec3(0.0);
  return {{"type", "directional"},
          {"azimuth", heading(light.direction)},
          {"elevation", elevation(light.direction)},
          {"direction", {d.x, d.y, d.z}},
          {"angular_diameter", degrees(kSunAngularDiameter)},
          {"illuminance", lux},
          {"color", {colour.x, colour.y, colour.z}}};
}

std::string sidecar(const std::string& path, const Environment& e, const Scene& scene,
                    const EnvironmentOptions& options) {
  constexpr const char* kStyles[] = {"full", "soft", "clamp", "none"};
  const Axes& axes = axesOf(options.target);
  const glm::dvec3 sun(sunDirection(scene.sun));
  Json lights = Json::array();
  if (e.lost) lights.push_back(lightJson(*e.lost, axes));
  const Json json{{"picture", std::filesystem::path(path).filename().string()},
                  {"title", scene.title},
                  {"layout", options.layout == EnvironmentLayout::cube ? "cube" : "latlong"},
                  {"target", axes.name},
                  {"axes", axes.text},
                  {"center_heading", degrees(options.centerHeading)},
                  {"unit", "kcd/m^2"},
                  {"sun",
                   {{"azimuth", heading(sun)},
                    {"elevation", elevation(sun)},
                    {"style", kStyles[static_cast<std::size_t>(options.sun.style)]}}},
                  {"lights", lights},
                  {"upward_illuminance", luminance(e.upward) * 1000.0}};
  return json.dump(2) + "\n";
}

ExrMetadata metadataOf(const Scene& scene, const EnvironmentOptions& options) {
  const glm::dvec3 sun(sunDirection(scene.sun));
  std::string date = scene.sun.date;
  std::replace(date.begin(), date.end(), '-', ':');
  const std::string& time = scene.sun.time;
  return {.environment = options.layout == EnvironmentLayout::cube ? ExrEnvironment::cube : ExrEnvironment::latlong,
          .captureDate = date + " " + (time.size() == 5 ? time + ":00" : time.substr(0, 8)),
          .utcOffset = scene.sun.utcOffset,
          .placed = true,
          .latitude = degrees(scene.sun.latitude),
          .longitude = degrees(scene.sun.longitude),
          .numbers = {{"centerHeading", degrees(options.centerHeading)},
                      {"sunAzimuth", heading(sun)},
                      {"sunElevation", elevation(sun)}}};
}

}  // namespace

double centerHeadingOf(EnvironmentTarget target) { return axesOf(target).heading * kDegree; }

void saveEnvironment(const std::string& path, const Environment& environment, const Scene& scene,
                     const EnvironmentOptions& options) {
  if (path.ends_with(".hdr"))
    saveHdr(path, environment.light);
  else
    saveExr(path, environment.light, options.sun.style == SunStyle::full ? ExrPrecision::full : ExrPrecision::half,
            metadataOf(scene, options));
  writeFileAtomically(path + ".json", sidecar(path, environment, scene, options));
}

}  // namespace welkin::app
