#pragma once
// A flight: aircraft, land, air and pilot, a sixtieth of a second at a time. Knows neither window nor OpenGL.
#include <optional>
#include <span>
#include <string>

#include "apps/viewer/flight/air.hpp"
#include "apps/viewer/flight/aircraft.hpp"
#include "apps/viewer/flight/pilot.hpp"
#include "apps/viewer/flight/terrain.hpp"

namespace welkin::viewer {

// Where a flight begins: on the runway, on the approach to it, or in the air over it below, in or above the lowest
// clouds.
enum class FlightStart { runway, final, below, inside, above };
inline constexpr std::string_view kFlightStarts[] = {"runway", "final", "below", "inside", "above"};

// Where the pilot, or who follows the aircraft, looks: turned by dragging, rad.
struct Gaze {
  double yaw = 0.0, pitch = 0.0;
};

class Flight {
 public:
  // The land is that of the scene's seed.
  Flight(const Scene& scene, FlightStart start);

  // The weather. Throws Error (badInput).
  void setScene(const Scene& scene, std::span<const Volume> weatherMaps, std::span<const PlacedGrid> grids);
  // Begins anew, where it began.
  void restart(const Scene& scene);
  // A sixtieth of a second, at the sky's time in s.
  void advance(const Hands& hands, double time);

  // The view, with the angle of view that `camera` has.
  Camera camera(const Camera& camera, const Gaze& gaze) const;

  Pilot pilot;
  const Aircraft& aircraft() const { return aircraft_; }
  const Terrain& terrain() const { return terrain_; }
  // The script of all that was flown since the last restart.
  std::string recording() const { return recorder_.text(); }
  // Of the last step: visibility inside cloud in m, 1e6 outside; vertical speed as an instrument shows it, m/s.
  double visibility() const { return visibility_; }
  double climb() const { return climb_; }
  double time() const { return seconds_; }  // s since it began

 private:
  Terrain terrain_;
  FlightStart start_;
  AirOfSky air_;
  Aircraft aircraft_;
  FlightRecorder recorder_;
  // Of the chase camera, which follows: rad.
  double chaseHeading_ = 0.0, chasePitch_ = 0.0;
  double visibility_ = 1e6, climb_ = 0.0, seconds_ = 0.0;
};

}  // namespace welkin::viewer
