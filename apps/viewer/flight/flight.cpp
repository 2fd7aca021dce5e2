#include "apps/viewer/flight/flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

#include "welkin/base/angle.hpp"

namespace welkin::viewer {

namespace {

const glm::dvec3 kHead(0.25, -0.28, -0.62);  // the pilot's, body axes, m
constexpr double kChaseDistance = 16.0, kChaseHeight = 3.4;
// How much lower than the nose, or than ahead, the eyes look: rad.
constexpr double kHeadLow = 0.06, kChaseLow = 0.2;
constexpr double kWingTip = 5.5;

double wrapped(double angle) { return std::remainder(angle, 2.0 * kPi); }

// Heights in the air over the runway, by the lowest clouds.
double startAltitude(const Scene& scene, FlightStart start) {
  double base = 1500.0, top = 2500.0;
  if (!scene.layers.empty()) {
    const auto lowest = std::min_element(scene.layers.begin(), scene.layers.end(),
                                         [](const Layer& a, const Layer& b) { return a.cloud.base < b.cloud.base; });
    base = lowest->cloud.base;
    top = base + lowest->cloud.thickness;
  }
  if (start == FlightStart::below) return 0.7 * base;
  return start == FlightStart::inside ? base + 0.35 * (top - base) : top + 300.0;
}

}  // namespace

Flight::Flight(const Scene& scene, FlightStart start) : terrain_(static_cast<unsigned>(scene.seed)), start_(start) {
  restart(scene);
}

void Flight::setScene(const Scene& scene, std::span<const Volume> weatherMaps, std::span<const PlacedGrid> grids) {
  air_.setScene(scene, weatherMaps, grids);
}

void Flight::restart(const Scene& scene) {
  const Runway& runway = terrain_.runway();
  const FlightView view = pilot.view();
  pilot = Pilot();
  pilot.setView(view);
  recorder_ = FlightRecorder();
  if (start_ == FlightStart::runway) {
    const glm::dvec2 place = terrain_.runwayPlace(-0.5 * runway.length + 60.0, 0.0);
    aircraft_ = parked({place, terrain_.height(place.x, place.y)}, runway.heading);
  } else {
    const bool lands = start_ == FlightStart::final;
    const double slope = lands ? -3.0 * kPi / 180.0 : 0.0, away = lands ? 2600.0 : 600.0;
    const glm::dvec2 place = terrain_.runwayPlace(-0.5 * runway.length - away, 0.0);
    double altitude = runway.elevation + (away + 300.0) * std::tan(-slope);
    if (!lands) altitude = std::max(startAltitude(scene, start_), terrain_.height(place.x, place.y) + 150.0);
    const glm::dvec3 wind = meanWind(scene.wind, altitude);
    const SteadyFlight steady =
        steadyFlight({place, altitude}, runway.heading, lands ? 38.0 : 65.0, slope, lands ? 1.0 : 0.0);
    aircraft_ = steady.aircraft;
    aircraft_.velocity += wind;
    pilot.setThrottle(steady.throttle);
    pilot.setFlaps(lands ? 1.0f : 0.0f);
  }
  const Attitude attitude = attitudeOf(aircraft_);
  chaseHeading_ = attitude.heading;
  chasePitch_ = 0.5 * attitude.pitch;
  climb_ = aircraft_.velocity.z;
  visibility_ = 1e6;
  seconds_ = 0.0;
}

void Flight::advance(const Hands& hands, double time) {
  pilot.move(hands);
  const Controls controls = pilot.controls();
  recorder_.add(controls, pilot.view());
  const glm::dvec3 right = glm::mat3_cast(aircraft_.attitude)[1];
  const Air air = air_.at(aircraft_.position, right * kWingTip, time);
  for (int i = 0; i < std::lround(kFlightFrame / kFlightStep); ++i) step(aircraft_, controls, air, terrain_);
  const double extinction = air_.extinction(aircraft_.position);
  visibility_ = extinction > 3.9e-6 ? 3.9 / extinction : 1e6;
  climb_ += (aircraft_.velocity.z - climb_) * kFlightFrame / 0.6;
  const Attitude attitude = attitudeOf(aircraft_);
  // Near the vertical a heading says nothing.
  if (std::abs(attitude.pitch) < 1.2)
    chaseHeading_ += wrapped(attitude.heading - chaseHeading_) * (1.0 - std::exp(-kFlightFrame / 0.35));
  chasePitch_ += (0.6 * attitude.pitch - chasePitch_) * (1.0 - std::exp(-kFlightFrame / 0.35));
  seconds_ += kFlightFrame;
}

Camera Flight::camera(const Camera& camera, const Gaze& gaze) const {
  Camera out = camera;
  out.projection = Projection::perspective;
  if (pilot.view() == FlightView::cockpit) {
    const glm::dmat3 world = glm::mat3_cast(aircraft_.attitude);
    out.position = aircraft_.position + world * kHead;
    // The head turns in the body's axes.
    const double up = gaze.pitch - kHeadLow, cp = std::cos(up), sp = std::sin(up);
    const double cy = std::cos(gaze.yaw), sy = std::sin(gaze.yaw);
    const glm::dmat3 head(glm::dvec3(cp * cy, cp * sy, -sp), glm::dvec3(-sy, cy, 0.0),
                          glm::dvec3(sp * cy, sp * sy, cp));
    Aircraft eye;
    eye.attitude = glm::quat_cast(world * head);
    const Attitude attitude = attitudeOf(eye);
    out.heading = static_cast<float>(attitude.heading);
    out.pitch = static_cast<float>(attitude.pitch);
    out.roll = static_cast<float>(attitude.bank);
    return out;
  }
  const double heading = chaseHeading_ + gaze.yaw;
  const double pitch = std::clamp(chasePitch_ + gaze.pitch, -1.4, 1.4);
  const glm::dvec3 ahead(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch), std::sin(pitch));
  out.position = aircraft_.position - kChaseDistance * ahead + glm::dvec3(0.0, 0.0, kChaseHeight);
  const double ground = std::max(terrain_.height(out.position.x, out.position.y), 0.0) + 1.5;
  out.position.z = std::max(out.position.z, ground);
  out.heading = static_cast<float>(wrapped(heading));
  out.pitch = static_cast<float>(pitch - kChaseLow);
  out.roll = 0.0f;
  return out;
}

}  // namespace welkin::viewer
