#include "apps/viewer/flight/aircraft.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

#include "welkin/base/angle.hpp"

namespace welkin::viewer {

namespace {

constexpr double kGravity = 9.81, kSeaLevelDensity = 1.225;

// Sizes and masses: m, m^2, kg, kg m^2. Roskam's Cessna 182, somewhat heavier.
constexpr double kMass = 1300.0, kWing = 16.2, kSpan = 11.0, kChord = 1.5;
constexpr glm::dvec3 kInertia(1285.0, 1825.0, 2667.0);
// Our own engine, a small turbine; the propeller gives kStaticThrust standing still.
constexpr double kPower = 300e3, kEfficiency = 0.8, kStaticThrust = 5200.0, kIdle = 0.03;

// Coefficients by angles in rad and by rates in half spans or chords a length of way.
constexpr double kLift0 = 0.307, kLiftAlpha = 4.41, kLiftRate = 3.9, kLiftElevator = 0.43, kLiftFlaps = 0.6;
constexpr double kDrag0 = 0.027, kDragLift = 0.054, kDragFlaps = 0.05, kDragSide = 0.3;
constexpr double kPitch0 = 0.04, kPitchAlpha = -0.613, kPitchRate = -12.4, kPitchElevator = 1.122, kPitchFlaps = -0.04,
                 kPitchStalled = -0.35;
constexpr double kSideSlip = -0.393, kSideRoll = -0.075, kSideYaw = 0.214, kSideRudder = 0.187;
constexpr double kRollSlip = -0.0923, kRollYaw = 0.0798, kRollAileron = 0.229, kRollRudder = 0.0147;
constexpr double kYawSlip = 0.0587, kYawRoll = -0.0278, kYawRate = -0.0937, kYawAileron = -0.0216, kYawRudder = 0.0645;
// Where the half wings' lift acts: gives Roskam's damping in roll, -.484, before the flow parts.
const double kHalfWing = kSpan * std::sqrt(0.484 / (2.0 * kLiftAlpha));
constexpr double kStallAngle = 16.0 * kDegree, kStallSharpness = 60.0;

constexpr double kMostElevator = 22.0 * kDegree, kMostAileron = 20.0 * kDegree, kMostRudder = 22.0 * kDegree;
constexpr double kPitchRateAsked = 14.0 * kDegree, kBankRateAsked = 50.0 * kDegree;

// Wheels, and what must not touch the ground; body axes from the centre of mass, m.
struct Wheel {
  glm::dvec3 at;
  double stiffness, damping;  // N/m, N s/m
  bool steers;
};
const std::array<Wheel, 3> kWheels{{{{1.35, 0.0, 1.28}, 45e3, 4.5e3, true},
                                    {{-0.42, -1.25, 1.3}, 65e3, 6.5e3, false},
                                    {{-0.42, 1.25, 1.3}, 65e3, 6.5e3, false}}};
const std::array<glm::dvec3, 6> kHull{
    {{2.6, 0.0, 0.45}, {-5.2, 0.0, -0.3}, {0.0, -5.5, -1.0}, {0.0, 5.5, -1.0}, {0.0, 0.0, 0.75}, {0.0, 0.0, -1.1}}};
constexpr double kHardestLanding = 4.5;  // m/s of sink that the gear survives

double finiteOr(double value, double fallback) { return std::isfinite(value) ? value : fallback; }
double asked(float value, double low, double high) { return std::clamp(finiteOr(value, 0.0), low, high); }
glm::dvec3 airOr0(const glm::dvec3& v) {
  return {std::clamp(finiteOr(v.x, 0.0), -80.0, 80.0), std::clamp(finiteOr(v.y, 0.0), -80.0, 80.0),
          std::clamp(finiteOr(v.z, 0.0), -80.0, 80.0)};
}

double partedShare(double alpha) {
  const double m = kStallSharpness;
  const double a = std::clamp(alpha, -0.8, 0.8);
  const double low = std::exp(-m * (a - kStallAngle)), high = std::exp(m * (a + kStallAngle));
  return (1.0 + low + high) / ((1.0 + low) * (1.0 + high));
}
// Of a wing, or half of one; a flat plate once the flow has parted.
double liftOf(double alpha, double flaps, double parted) {
  const double attached = kLift0 + kLiftFlaps * flaps + kLiftAlpha * alpha;
  const double s = std::sin(alpha);
  return (1.0 - parted) * attached + parted * 2.0 * std::copysign(s * s, alpha) * std::cos(alpha);
}
double dragOf(double alpha, double lift, double flaps, double parted) {
  const double s = std::sin(alpha);
  return kDrag0 + kDragFlaps * flaps + (1.0 - parted) * kDragLift * lift * lift + parted * 2.0 * s * s;
}

double thrustOf(double power, double speed, double densityRatio) {
  const double still = kEfficiency * kPower / kStaticThrust;
  return power * std::sqrt(densityRatio) * kEfficiency * kPower / std::hypot(speed, still);
}

struct Forces {
  glm::dvec3 force{0.0}, moment{0.0};  // N, N m, body axes
};

Forces aerodynamics(Aircraft& a, const glm::dvec3& flow, const glm::dvec3& flowLeft, const glm::dvec3& flowRight) {
  Forces out;
  const double speed = glm::length(flow);
  a.airspeed = speed;
  a.angleOfAttack = speed > 1.0 ? std::atan2(flow.z, std::max(flow.x, 0.0) + 1e-9) : 0.0;
  if (flow.x < 0.0 && speed > 1.0) a.angleOfAttack = std::atan2(flow.z, flow.x);
  a.sideslip = speed > 1.0 ? std::asin(std::clamp(flow.y / speed, -1.0, 1.0)) : 0.0;
  a.stalled = 0.0;
  if (speed < 1.0) return out;
  const double density = kSeaLevelDensity * airDensityRatio(a.position.z);
  const double pressure = 0.5 * density * speed * speed * kWing;
  const double byChord = kChord / (2.0 * speed), bySpan = kSpan / (2.0 * speed);
  const Deflections& d = a.surfaces;
  const glm::dvec3& w = a.rates;
  // Each half of the wing meets the air at its own angle.
  const double up[] = {(flowLeft.z - w.x * kHalfWing) / speed, (flowRight.z + w.x * kHalfWing) / speed};
  const double forward[] = {(flowLeft.x + w.z * kHalfWing) / speed, (flowRight.x - w.z * kHalfWing) / speed};
  double lift = 0.0, drag = 0.0, roll = 0.0, yaw = 0.0;
  for (int side = 0; side < 2; ++side) {
    const double alpha = std::atan2(up[side], forward[side]);
    const double parted = partedShare(alpha);
    const double l = 0.5 * liftOf(alpha, a.flaps, parted);
    const double c = 0.5 * dragOf(alpha, 2.0 * l, a.flaps, parted);
    const double arm = (side == 0 ? 1.0 : -1.0) * kHalfWing / kSpan;
    a.stalled += 0.5 * parted;
    lift += l;
    drag += c;
    roll += arm * l;
    yaw -= arm * parted * c;
  }
  const double attached = 1.0 - a.stalled;
  lift += attached * (kLiftRate * w.y * byChord - kLiftElevator * d.elevator);
  drag += kDragSide * a.sideslip * a.sideslip;
  const double side = kSideSlip * a.sideslip + bySpan * (kSideRoll * w.x + kSideYaw * w.z) + kSideRudder * d.rudder;
  const double ca = std::cos(a.angleOfAttack), sa = std::sin(a.angleOfAttack);
  out.force = pressure * glm::dvec3(-drag * ca + lift * sa, side, -drag * sa - lift * ca);
  a.loadFactor = (lift * ca + drag * sa) * pressure / (kMass * kGravity);
  const double effect = 0.3 + 0.7 * attached;  // of surfaces in the wing's wake
  out.moment.x = pressure * kSpan *
                 (roll + kRollSlip * std::clamp(a.sideslip, -0.5, 0.5) + bySpan * kRollYaw * w.z +
                  effect * (kRollAileron * d.aileron + kRollRudder * d.rudder));
  out.moment.y = pressure * kChord *
                 (kPitch0 + kPitchFlaps * a.flaps + kPitchAlpha * std::clamp(a.angleOfAttack, -0.7, 0.7) +
                  kPitchStalled * a.stalled * std::sin(a.angleOfAttack) + byChord * kPitchRate * w.y +
                  effect * kPitchElevator * d.elevator);
  out.moment.z = pressure * kSpan *
                 (yaw + kYawSlip * std::clamp(a.sideslip, -0.5, 0.5) + bySpan * (kYawRoll * w.x + kYawRate * w.z) -
                  effect * (kYawRudder * d.rudder - kYawAileron * d.aileron));
  return out;
}

// Wheels as springs with friction; what else touches the ground breaks.
Forces contact(Aircraft& a, const Controls& controls, const glm::dmat3& world, const SurfaceSource& ground) {
  Forces out;
  a.onGround = false;
  if (a.position.z > ground.surface(a.position.x, a.position.y).height + 20.0) return out;
  const double brake = asked(controls.brake, 0.0, 1.0);
  const double steer = asked(controls.yaw + controls.bank, -1.0, 1.0) * 0.4 / (1.0 + a.airspeed * a.airspeed / 150.0);
  for (const Wheel& wheel : kWheels) {
    const glm::dvec3 arm = world * wheel.at, at = a.position + arm;
    const Surface s = ground.surface(at.x, at.y);
    const double depth = (s.height - at.z) * s.normal.z;
    if (depth <= 0.0) continue;
    a.onGround = true;
    const glm::dvec3 v = a.velocity + world * glm::cross(a.rates, wheel.at);
    const double sink = -glm::dot(v, s.normal);
    if (s.water || sink > kHardestLanding || depth > 0.6) a.crashed = true;
    const double load = std::clamp(wheel.stiffness * depth + wheel.damping * sink, 0.0, 6.0 * kMass * kGravity);
    const double turn = wheel.steers ? steer : 0.0;
    glm::dvec3 along = world * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
    along = along - glm::dot(along, s.normal) * s.normal;
    if (glm::length(along) < 1e-3) continue;
    along = glm::normalize(along);
    const glm::dvec3 across = glm::cross(s.normal, along);
    const double rolls = glm::dot(v, along), slides = glm::dot(v, across);
    const double resistance = (s.paved ? 0.02 : 0.07) + (wheel.steers ? 0.0 : 0.45 * brake);
    const glm::dvec3 force = load * (s.normal - along * (resistance * std::clamp(rolls / 0.3, -1.0, 1.0)) -
                                     across * (0.7 * std::clamp(slides / 0.6, -1.0, 1.0)));
    out.force += force;
    out.moment += glm::cross(wheel.at, glm::transpose(world) * force);
  }
  for (const glm::dvec3& point : kHull) {
    const glm::dvec3 at = a.position + world * point;
    if (at.z < ground.surface(at.x, at.y).height) a.crashed = true;
  }
  out.force = glm::transpose(world) * out.force;
  return out;
}

// Stick to surfaces, see step().
void control(Aircraft& a, const Controls& controls) {
  const Attitude now = attitudeOf(a);
  const double speed = std::max(a.airspeed, 20.0);
  const double soft = 60.0 * 60.0 / (speed * speed);  // surfaces move less where the air is faster
  const double pitch = asked(controls.pitch, -1.0, 1.0), bank = asked(controls.bank, -1.0, 1.0);
  const bool upright = std::abs(now.pitch) < 75.0 * kDegree && std::abs(now.bank) < 80.0 * kDegree;
  const double turn = upright && !a.onGround ? kGravity / speed * std::tan(std::clamp(now.bank, -1.2, 1.2)) : 0.0;

  double pitchRate = pitch * kPitchRateAsked;
  // A turn takes more lift: the nose is held that much higher (lift 0 lies at -kLift0 / kLiftAlpha).
  const double higher = kLift0 / kLiftAlpha * (1.0 - std::cos(now.bank));
  if (std::abs(pitch) > 0.02 || !upright || a.onGround) {
    a.heldPitch = now.pitch - higher;
  } else {
    // It does not hold the nose up into a stall.
    const double beyond = a.angleOfAttack - 0.8 * kStallAngle;
    if (beyond > 0.0) a.heldPitch -= 1.5 * beyond * kFlightStep + 0.02 * kFlightStep;
    pitchRate = std::clamp(1.6 * (a.heldPitch + higher - now.pitch), -0.2, 0.2);
  }
  pitchRate += turn * std::sin(now.bank) * std::cos(now.pitch);
  const double pitchError = std::clamp(pitchRate - a.rates.y, -0.5, 0.5);
  if (a.onGround)
    a.trim = 0.0;
  else
    a.trim = std::clamp(a.trim + 2.2 * soft * pitchError * kFlightStep, -kMostElevator, kMostElevator);
  const double elevator = a.onGround ? pitch * kMostElevator : a.trim + 1.1 * soft * pitchError;

  double bankRate = bank * kBankRateAsked;
  if (std::abs(bank) > 0.02 || !upright || a.onGround)
    a.heldBank = std::abs(now.bank) < 4.0 * kDegree ? 0.0 : now.bank;
  else
    bankRate = std::clamp(1.5 * (a.heldBank - now.bank), -0.5, 0.5);
  const double rollRate = bankRate - turn * std::sin(now.pitch);
  const double aileron = 0.7 * soft * (rollRate - a.rates.x);

  const double yawRate = turn * std::cos(now.bank) * std::cos(now.pitch);
  const double rudder = -asked(controls.yaw, -1.0, 1.0) * 0.8 * kMostRudder - 0.8 * a.sideslip +
                        (a.onGround ? 0.0 : -0.5 * soft * (yawRate - a.rates.z));

  const auto follow = [](double& surface, double wanted, double most) {
    const double rate = 2.5 * kFlightStep;  // rad/s that an actuator makes
    surface += std::clamp(std::clamp(wanted, -most, most) - surface, -rate, rate);
  };
  follow(a.surfaces.elevator, elevator, kMostElevator);
  follow(a.surfaces.aileron, aileron, kMostAileron);
  follow(a.surfaces.rudder, rudder, kMostRudder);
}

}  // namespace

Attitude attitudeOf(const Aircraft& aircraft) {
  const glm::dmat3 world = glm::mat3_cast(aircraft.attitude);
  const glm::dvec3 forward = world[0], right = world[1], down = world[2];
  double heading = std::atan2(forward.x, forward.y);
  if (heading < 0.0) heading += 2.0 * kPi;
  return {heading, std::asin(std::clamp(forward.z, -1.0, 1.0)), std::atan2(-right.z, -down.z)};
}

glm::dquat attitudeFrom(const Attitude& attitude) {
  const double ch = std::cos(attitude.heading), sh = std::sin(attitude.heading);
  const double cp = std::cos(attitude.pitch), sp = std::sin(attitude.pitch);
  const double cb = std::cos(attitude.bank), sb = std::sin(attitude.bank);
  const glm::dvec3 forward(sh * cp, ch * cp, sp), level(ch, -sh, 0.0), under(sh * sp, ch * sp, -cp);
  return glm::normalize(glm::quat_cast(glm::dmat3(forward, cb * level + sb * under, cb * under - sb * level)));
}

double airDensityRatio(double altitude) {
  const double t = 1.0 - 2.2558e-5 * std::clamp(finiteOr(altitude, 0.0), -1000.0, 25000.0);
  return std::max(std::pow(t, 4.2559), 0.05);
}

double indicatedAirspeed(const Aircraft& aircraft) {
  return aircraft.airspeed * std::sqrt(airDensityRatio(aircraft.position.z));
}

double standingHeight() { return 1.22; }

Aircraft parked(const glm::dvec3& ground, double heading) {
  Aircraft a;
  a.position = ground + glm::dvec3(0.0, 0.0, standingHeight());
  a.attitude = attitudeFrom({heading, 0.0, 0.0});
  a.onGround = true;
  return a;
}

SteadyFlight steadyFlight(const glm::dvec3& position, double heading, double airspeed, double climb, double flaps) {
  SteadyFlight out;
  Aircraft& a = out.aircraft;
  a.position = position;
  a.airspeed = std::clamp(finiteOr(airspeed, 60.0), 25.0, 120.0);
  a.flaps = std::clamp(finiteOr(flaps, 0.0), 0.0, 1.0);
  const double ratio = airDensityRatio(position.z);
  const double pressure = 0.5 * kSeaLevelDensity * ratio * a.airspeed * a.airspeed * kWing;
  double alpha = 0.0, elevator = 0.0, thrust = 0.0;
  for (int i = 0; i < 30; ++i) {
    elevator = -(kPitch0 + kPitchFlaps * a.flaps + kPitchAlpha * alpha) / kPitchElevator;
    const double lift = (kMass * kGravity * std::cos(climb) - thrust * std::sin(alpha)) / pressure;
    alpha = std::clamp((lift + kLiftElevator * elevator - kLift0 - kLiftFlaps * a.flaps) / kLiftAlpha, -0.2, 0.27);
    const double drag = dragOf(alpha, lift + kLiftElevator * elevator, a.flaps, 0.0);
    thrust = (drag * pressure + kMass * kGravity * std::sin(climb)) / std::cos(alpha);
  }
  a.power = std::clamp(thrust / thrustOf(1.0, a.airspeed, ratio), kIdle, 1.0);
  out.throttle = static_cast<float>((a.power - kIdle) / (1.0 - kIdle));
  a.angleOfAttack = alpha;
  a.surfaces.elevator = a.trim = elevator;
  a.attitude = attitudeFrom({heading, climb + alpha, 0.0});
  a.heldPitch = climb + alpha;
  a.velocity = a.airspeed *
               glm::dvec3(std::sin(heading) * std::cos(climb), std::cos(heading) * std::cos(climb), std::sin(climb));
  return out;
}

void step(Aircraft& a, const Controls& controls, const Air& air, const SurfaceSource& ground) {
  if (a.crashed) return;
  const Aircraft before = a;
  control(a, controls);
  const double wanted = kIdle + (1.0 - kIdle) * asked(controls.throttle, 0.0, 1.0);
  a.power += (wanted - a.power) * kFlightStep / 0.7;
  a.flaps += std::clamp(asked(controls.flaps, 0.0, 1.0) - a.flaps, -0.25 * kFlightStep, 0.25 * kFlightStep);
  a.propeller = std::fmod(a.propeller + (60.0 + 180.0 * a.power) * kFlightStep, 2.0 * kPi);

  const glm::dmat3 world = glm::mat3_cast(a.attitude), body = glm::transpose(world);
  const glm::dvec3 flow = body * (a.velocity - airOr0(air.wind));
  Forces f = aerodynamics(a, flow, flow - body * airOr0(air.left), flow - body * airOr0(air.right));
  f.force.x += thrustOf(a.power, std::max(flow.x, 0.0), airDensityRatio(a.position.z));
  const Forces touch = contact(a, controls, world, ground);
  f.force += touch.force;
  f.moment += touch.moment;
  if (a.crashed) {
    a.velocity = a.rates = glm::dvec3(0.0);
    return;
  }
  a.velocity += (world * (f.force / kMass) - glm::dvec3(0.0, 0.0, kGravity)) * kFlightStep;
  a.rates += (f.moment - glm::cross(a.rates, kInertia * a.rates)) / kInertia * kFlightStep;
  a.rates = glm::clamp(a.rates, -6.0, 6.0);
  if (const double speed = glm::length(a.velocity); speed > 250.0) a.velocity *= 250.0 / speed;
  a.position += a.velocity * kFlightStep;
  const glm::dquat spin(0.0, a.rates.x, a.rates.y, a.rates.z);
  a.attitude = glm::normalize(a.attitude + a.attitude * spin * (0.5 * kFlightStep));
  const auto finite = [](const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); };
  if (!finite(a.position) || !finite(a.velocity) || !finite(a.rates) || !std::isfinite(a.attitude.w)) {
    a = before;
    a.crashed = true;
  }
}

}  // namespace welkin::viewer
