#pragma once
// A light aircraft as a rigid body: six degrees of freedom, fixed steps, plain arithmetic.
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace welkin::viewer {

inline constexpr double kFlightStep = 1.0 / 120.0;  // s

// What the pilot asks for.
struct Controls {
  float pitch = 0.0f;     // -1 nose down, 1 nose up
  float bank = 0.0f;      // -1 left, 1 right
  float yaw = 0.0f;       // -1 left, 1 right
  float throttle = 0.0f;  // 0 to 1
  float flaps = 0.0f;     // 0 to 1
  float brake = 0.0f;     // 0 to 1
};

// The air round the aircraft, east, north, up in m/s: the wind at its middle, and what it is more at the wing's tips.
struct Air {
  glm::dvec3 wind{0.0}, left{0.0}, right{0.0};
};

// What is below a wheel.
struct Surface {
  double height = 0.0;  // m
  glm::dvec3 normal{0.0, 0.0, 1.0};
  bool water = false, paved = false;
};
class SurfaceSource {
 public:
  virtual ~SurfaceSource() = default;
  virtual Surface surface(double east, double north) const = 0;
};

// Deflections in rad. Positive: the elevator brings the nose up, the ailerons the right wing down, the rudder the nose
// to the left.
struct Deflections {
  double elevator = 0.0, aileron = 0.0, rudder = 0.0;
};

struct Aircraft {
  glm::dvec3 position{0.0};                 // of the centre of mass: east, north, altitude in m
  glm::dvec3 velocity{0.0};                 // east, north, up in m/s, over ground
  glm::dquat attitude{1.0, 0.0, 0.0, 0.0};  // world (east, north, up) from body (forward, right, down)
  glm::dvec3 rates{0.0};                    // of turn about the body's axes, rad/s
  double power = 0.0;                       // of the engine, as a share; follows the throttle
  double flaps = 0.0;                       // as they stand
  double propeller = 0.0;                   // angle, rad
  Deflections surfaces;
  // What the control system holds while the stick is in the middle, rad; and the elevator's trim.
  double heldPitch = 0.0, heldBank = 0.0, trim = 0.0;
  bool onGround = false, crashed = false;
  // Of the last step.
  double airspeed = 0.0, angleOfAttack = 0.0, sideslip = 0.0;  // true airspeed in m/s, rad
  double loadFactor = 1.0;                                     // of lift, in g
  double stalled = 0.0;                                        // share of the wing's flow that has parted, 0 to 1
};

// Where the nose points, the wings hang: rad. heading: compass, 0 to 2 pi.
struct Attitude {
  double heading = 0.0, pitch = 0.0, bank = 0.0;
};
Attitude attitudeOf(const Aircraft& aircraft);
glm::dquat attitudeFrom(const Attitude& attitude);

// Knots that the pilot reads are those of this speed: what the pitot tube feels, m/s.
double indicatedAirspeed(const Aircraft& aircraft);
// Density of the air over that at sea level (ISO 2533, troposphere), held to 0.05 far above it.
double airDensityRatio(double altitude);

// Height of the centre of mass over the ground when it stands on its wheels, m.
double standingHeight();

// Standing still with its wheels on the ground.
Aircraft parked(const glm::dvec3& ground, double heading);
// In steady flight along a path that climbs by `climb` rad, wings level, in air at rest: angle of attack, trim and
// power are those of the equations below. Also says where the throttle has to be.
struct SteadyFlight {
  Aircraft aircraft;
  float throttle = 0.0f;
};
SteadyFlight steadyFlight(const glm::dvec3& position, double heading, double airspeed, double climb,
                          double flaps = 0.0);

// One step of kFlightStep. The control system makes the stick a rate of pitch or bank and holds both while it is in the
// middle, keeps turns level and coordinated; within what the surfaces can do: it neither prevents a stall that the
// stick asks for nor flies out of one. Lift and moments are the linear ones of a Cessna 182 at cruise (J. Roskam,
// "Airplane Flight Dynamics and Automatic Flight Controls", app. B), with a stronger engine; beyond 16 degrees the flow
// parts (R. Beard and T. McLain, "Small Unmanned Aircraft", 2012, eq. 4.9 to 4.11), each half of the wing by itself.
// Whatever the input holds, the state stays finite.
void step(Aircraft& aircraft, const Controls& controls, const Air& air, const SurfaceSource& ground);

}  // namespace welkin::viewer
