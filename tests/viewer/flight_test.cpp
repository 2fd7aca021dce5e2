// The aircraft, the land, the pilot, and whole flights without a picture.
#include "apps/viewer/flight/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "welkin/base/angle.hpp"

namespace welkin::viewer {
namespace {

constexpr double kGravity = 9.81;

class Plain final : public SurfaceSource {
 public:
  Surface surface(double /*east*/, double /*north*/) const override { return {.paved = true}; }
};
const Plain kPlain;

void fly(Aircraft& a, const Controls& controls, double seconds,
         const std::function<void(const Aircraft&)>& watch = nullptr) {
  for (int i = 0; i < std::lround(seconds / kFlightStep); ++i) {
    step(a, controls, {}, kPlain);
    if (watch) watch(a);
  }
}

TEST(Aircraft, SteadyFlightIsOne) {
  for (const double speed : {40.0, 60.0, 80.0})
    for (const double climb : {-3.0 * kDegree, 0.0, 4.0 * kDegree}) {
      SteadyFlight s = steadyFlight({0.0, 0.0, 1500.0}, 1.0, speed, climb);
      // Of the start the equations hold to the last digit but for what the control system adds.
      fly(s.aircraft, {.throttle = s.throttle}, 30.0);
      EXPECT_NEAR(s.aircraft.airspeed, speed, 2.0) << speed << " " << climb;
      EXPECT_NEAR(s.aircraft.velocity.z, speed * std::sin(climb), 0.6) << speed << " " << climb;
      EXPECT_NEAR(attitudeOf(s.aircraft).heading, 1.0, 0.01);
      EXPECT_NEAR(s.aircraft.loadFactor, std::cos(climb), 0.03);
    }
}

TEST(Aircraft, AttitudeAndItsInverse) {
  for (const double heading : {0.1, 2.0, 4.0, 6.2})
    for (const double pitch : {-1.2, 0.0, 0.7})
      for (const double bank : {-2.0, 0.0, 1.0}) {
        Aircraft a;
        a.attitude = attitudeFrom({heading, pitch, bank});
        const Attitude back = attitudeOf(a);
        EXPECT_NEAR(back.heading, heading, 1e-9);
        EXPECT_NEAR(back.pitch, pitch, 1e-9);
        EXPECT_NEAR(back.bank, bank, 1e-9);
      }
}

// In a coordinated turn the heading changes by g tan(bank) / v, and the nose stays in the wind.
TEST(Aircraft, TurnsAtTheRateOfItsBank) {
  for (const double bank : {-30.0 * kDegree, 20.0 * kDegree, 45.0 * kDegree}) {
    SteadyFlight s = steadyFlight({0.0, 0.0, 1500.0}, 0.0, 60.0, 0.0);
    Aircraft& a = s.aircraft;
    a.heldBank = bank;
    fly(a, {.throttle = s.throttle}, 8.0);
    const double before = attitudeOf(a).heading;
    double rate = 0.0;
    int steps = 0;
    fly(a, {.throttle = s.throttle}, 10.0, [&](const Aircraft& now) {
      rate += kGravity * std::tan(attitudeOf(now).bank) / now.airspeed;
      ++steps;
      EXPECT_LT(std::abs(now.sideslip), 2.0 * kDegree);
    });
    const double turned = std::remainder(attitudeOf(a).heading - before, 2.0 * kPi);
    EXPECT_NEAR(turned, std::remainder(rate / steps * 10.0, 2.0 * kPi), 0.05 * std::abs(turned)) << bank;
    EXPECT_NEAR(attitudeOf(a).bank, bank, 2.0 * kDegree);
    EXPECT_NEAR(a.loadFactor, 1.0 / std::cos(bank), 0.08);
    EXPECT_NEAR(a.velocity.z, 0.0, 3.0);
  }
}

TEST(Aircraft, StallsWhenHeldAndRecoversWhenLetGo) {
  SteadyFlight s = steadyFlight({0.0, 0.0, 2500.0}, 0.0, 50.0, 0.0);
  Aircraft& a = s.aircraft;
  double slowest = 100.0, steepest = 0.0, stalled = 0.0, sink = 0.0;
  fly(a, {.pitch = 0.5f}, 20.0, [&](const Aircraft& now) {
    if (now.stalled < 0.1 && stalled < 0.1) slowest = std::min(slowest, indicatedAirspeed(now));
    steepest = std::max(steepest, now.angleOfAttack);
    stalled = std::max(stalled, now.stalled);
    sink = std::min(sink, now.velocity.z);
  });
  EXPECT_GT(steepest, 16.0 * kDegree);
  EXPECT_GT(stalled, 0.5);
  EXPECT_LT(sink, -6.0);
  EXPECT_NEAR(slowest, 28.9, 7.0);  // sqrt(2 m g / (density wing 1.54)) at 1 g; slower under less
  a.heldBank = 0.0;
  fly(a, {.throttle = 1.0f}, 15.0);
  EXPECT_LT(a.stalled, 0.05);
  EXPECT_LT(a.angleOfAttack, 12.0 * kDegree);
  EXPECT_GT(a.airspeed, 35.0);
  EXPECT_FALSE(a.crashed);
}

// Flaps let it fly slower.
TEST(Aircraft, FlapsLowerTheAngleOfAttack) {
  const Aircraft clean = steadyFlight({0.0, 0.0, 500.0}, 0.0, 40.0, 0.0, 0.0).aircraft;
  const Aircraft flaps = steadyFlight({0.0, 0.0, 500.0}, 0.0, 40.0, 0.0, 1.0).aircraft;
  EXPECT_LT(flaps.angleOfAttack, clean.angleOfAttack - 5.0 * kDegree);
  EXPECT_GT(flaps.power, clean.power);
}

TEST(Aircraft, TakesOff) {
  Aircraft a = parked({0.0, 0.0, 0.0}, 0.5);
  fly(a, {.brake = 1.0f}, 5.0);
  EXPECT_TRUE(a.onGround);
  EXPECT_LT(glm::length(a.velocity), 0.1);
  EXPECT_NEAR(a.position.z, standingHeight(), 0.15);
  const glm::dvec3 start = a.position;
  double run = -1.0;
  for (int i = 0; i < 40 * 120 && run < 0.0; ++i) {
    step(a, {.pitch = a.airspeed > 33.0 ? 0.5f : 0.0f, .throttle = 1.0f}, {}, kPlain);
    if (a.position.z > 4.0) run = glm::length(glm::dvec2(a.position - start));
  }
  EXPECT_GT(run, 120.0);
  EXPECT_LT(run, 500.0);
  EXPECT_FALSE(a.crashed);
  EXPECT_NEAR(attitudeOf(a).heading, 0.5, 2.0 * kDegree);  // straight ahead
  a.heldPitch = 8.0 * kDegree;
  fly(a, {.throttle = 1.0f}, 30.0);
  EXPECT_GT(a.position.z, 150.0);
  EXPECT_GT(a.velocity.z, 5.0);
}

TEST(Aircraft, LandsSoftlyAndStops) {
  SteadyFlight s = steadyFlight({0.0, 0.0, standingHeight() + 2.0}, 0.0, 34.0, -1.5 * kDegree, 1.0);
  Aircraft& a = s.aircraft;
  fly(a, {.pitch = 0.05f, .flaps = 1.0f}, 6.0);
  EXPECT_TRUE(a.onGround);
  fly(a, {.flaps = 1.0f, .brake = 1.0f}, 25.0);
  EXPECT_FALSE(a.crashed);
  EXPECT_TRUE(a.onGround);
  EXPECT_LT(glm::length(a.velocity), 0.2);
  EXPECT_LT(a.position.y, 700.0);
}

TEST(Aircraft, BreaksWhenItHitsTheGround) {
  SteadyFlight s = steadyFlight({0.0, 0.0, 60.0}, 0.0, 60.0, 0.0);
  s.aircraft.heldPitch = -20.0 * kDegree;
  fly(s.aircraft, {}, 20.0);
  EXPECT_TRUE(s.aircraft.crashed);
  const glm::dvec3 there = s.aircraft.position;
  fly(s.aircraft, {.throttle = 1.0f}, 1.0);
  EXPECT_EQ(s.aircraft.position, there);
}

// Whatever a script, a stick or the weather says.
TEST(Aircraft, StaysFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
  const double wrong[] = {0.0, 1e300, -1e300, static_cast<double>(nan), 70.0, -70.0};
  for (int kind = 0; kind < 24; ++kind) {
    Aircraft a = steadyFlight({0.0, 0.0, 800.0}, 0.3 * kind, 30.0 + 3.0 * kind, 0.0).aircraft;
    unsigned random = 77u + static_cast<unsigned>(kind);
    const auto next = [&] {
      return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) / 8388608.0f - 1;
    };
    for (int i = 0; i < 3000; ++i) {
      Controls c{.pitch = 3 * next(), .bank = 3 * next(), .yaw = 3 * next(), .throttle = 2 * next(), .brake = next()};
      if (kind % 3 == 1) c.pitch = i % 2 ? nan : huge;
      Air air;
      air.wind = {wrong[(i / 50 + kind) % 6], wrong[(i / 70) % 6], wrong[(i / 90) % 6]};
      air.left = air.wind;
      step(a, c, air, kPlain);
      ASSERT_TRUE(std::isfinite(a.position.x + a.position.y + a.position.z + a.velocity.x + a.velocity.z + a.rates.x));
      ASSERT_TRUE(std::isfinite(a.attitude.w + a.attitude.x + a.airspeed + a.loadFactor + a.trim + a.angleOfAttack));
      ASSERT_LT(glm::length(a.velocity), 251.0);
    }
  }
}

TEST(Terrain, TheRunwayIsLevelAndOverTheSea) {
  for (const unsigned seed : {1u, 7u, 11u, 42u}) {
    const Terrain terrain(seed);
    const Runway& runway = terrain.runway();
    for (int i = -10; i <= 10; ++i)
      for (int j = -1; j <= 1; ++j) {
        const glm::dvec2 p = terrain.runwayPlace(0.05 * i * runway.length, 0.5 * j * runway.width);
        const Surface s = terrain.surface(p.x, p.y);
        EXPECT_NEAR(s.height, runway.elevation, 1e-6);
        EXPECT_NEAR(s.normal.z, 1.0, 1e-6);
        EXPECT_FALSE(s.water);
      }
    // Nothing stands in the way of approach and departure: a path of 3 degrees clears the land by far.
    for (int i = 1; i < 60; ++i)
      for (const double side : {-1.0, 1.0}) {
        const double away = 100.0 * i;
        const glm::dvec2 p = terrain.runwayPlace(side * (0.5 * runway.length + away), 0.0);
        EXPECT_LT(terrain.height(p.x, p.y), runway.elevation + 8.0 + 0.05 * away) << seed << " " << away;
      }
  }
}

TEST(Terrain, HasSeaPlainAndMountains) {
  for (const unsigned seed : {1u, 7u, 11u}) {
    const Terrain terrain(seed);
    int sea = 0, high = 0, count = 0;
    double highest = 0.0;
    for (int i = -40; i <= 40; ++i)
      for (int j = -40; j <= 40; ++j) {
        const double h = terrain.height(2000.0 * i + 371.0, 2000.0 * j - 113.0);
        sea += h < 0.0 ? 1 : 0;
        high += h > 700.0 ? 1 : 0;
        highest = std::max(highest, h);
        ++count;
      }
    EXPECT_GT(sea, count / 20) << seed;
    EXPECT_LT(sea, 7 * count / 10) << seed;
    EXPECT_GT(high, count / 200) << seed;
    EXPECT_GT(highest, 900.0) << seed;
    EXPECT_LT(highest, 4000.0) << seed;
  }
}

TEST(Terrain, IsContinuousAndAnswersAnything) {
  const Terrain terrain(3);
  for (int i = 0; i < 4000; ++i) {
    const double x = 37.7 * i - 60000.0, y = 20000.0 * std::sin(0.37 * i);
    EXPECT_LT(std::abs(terrain.height(x + 0.01, y) - terrain.height(x, y)), 0.2) << x << " " << y;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {nan, 1e300, -1e300})
    EXPECT_TRUE(std::isfinite(terrain.height(wrong, 0.0)) && std::isfinite(terrain.surface(0.0, wrong).height));
}

TEST(Pilot, KeysMoveTheStickAndBack) {
  Pilot pilot;
  for (int i = 0; i < 60; ++i) pilot.move({.pitch = 1.0f, .throttle = 1.0f});
  EXPECT_EQ(pilot.controls().pitch, 1.0f);
  EXPECT_NEAR(pilot.controls().throttle, 0.4f, 0.01f);
  for (int i = 0; i < 10; ++i) pilot.move({});
  EXPECT_LT(pilot.controls().pitch, 0.7f);
  EXPECT_GT(pilot.controls().pitch, 0.0f);
  for (int i = 0; i < 60; ++i) pilot.move({});
  EXPECT_EQ(pilot.controls().pitch, 0.0f);
  pilot.move({.stickBank = -0.5f});
  EXPECT_EQ(pilot.controls().bank, -0.5f);
  EXPECT_EQ(pilot.set("throttle=0.8"), "");
  EXPECT_EQ(pilot.set("view=cockpit"), "");
  EXPECT_EQ(pilot.view(), FlightView::cockpit);
  for (const char* wrong :
       {"", "throttle", "throttle=", "throttle=2", "throttle=nan", "pitch=-1.1", "gear=1", "view=up"})
    EXPECT_NE(pilot.set(wrong), "") << wrong;
  EXPECT_EQ(pilot.controls().throttle, 0.8f);
}

Scene cloudyScene() {
  Scene scene;
  scene.seed = 5;
  return scene;
}

// What was flown by hand, with gusts, is flown again to the last bit by its recording.
TEST(Flight, ARecordingIsTheFlight) {
  const Scene scene = cloudyScene();
  Flight hand(scene, FlightStart::inside), again(scene, FlightStart::inside);
  hand.setScene(scene, {}, {});
  again.setScene(scene, {}, {});
  std::vector<glm::dvec3> places;
  for (int i = 0; i < 240; ++i) {
    Hands hands;
    if (i > 20 && i < 80) hands.bank = 1.0f;
    if (i > 60 && i < 90) hands.pitch = -1.0f;
    if (i > 100) hands.throttle = 1.0f;
    if (i == 150) hand.pilot.changeView();
    hand.advance(hands, i / 60.0);
    places.push_back(hand.aircraft().position);
  }
  const std::string text = hand.recording();
  std::size_t frame = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    ASSERT_TRUE(line.starts_with("fly ")) << line;
    std::size_t used = 0;
    const int frames = std::stoi(line.substr(4), &used);
    line = line.substr(4 + used);
    for (std::size_t space = line.find(' '); space != std::string::npos; space = line.find(' ')) {
      line = line.substr(space + 1);
      ASSERT_EQ(again.pilot.set(line.substr(0, line.find(' '))), "") << line;
    }
    for (int i = 0; i < frames; ++i, ++frame) {
      again.advance({}, static_cast<double>(frame) / 60.0);
      ASSERT_EQ(again.aircraft().position, places.at(frame)) << frame;
    }
  }
  EXPECT_EQ(frame, places.size());
  EXPECT_EQ(again.pilot.view(), hand.pilot.view());
  EXPECT_EQ(again.recording(), text);
}

// Bumpy in cloud, smooth above it.
TEST(Flight, CloudsShakeTheAircraft) {
  Scene scene = cloudyScene();
  scene.layers.front().weather.coverage = 0.9f;
  const auto shaking = [&](FlightStart start) {
    Flight flight(scene, start);
    flight.setScene(scene, {}, {});
    double sum = 0.0;
    for (int i = 0; i < 600; ++i) {
      flight.advance({}, i / 60.0);
      sum += std::pow(flight.aircraft().loadFactor - 1.0, 2);
    }
    EXPECT_FALSE(flight.aircraft().crashed);
    return std::sqrt(sum / 600);
  };
  const double above = shaking(FlightStart::above), inside = shaking(FlightStart::inside);
  EXPECT_LT(above, 0.02);
  EXPECT_GT(inside, 3.0 * above);
  EXPECT_LT(inside, 0.6);
}

TEST(Flight, StartsWhereItIsTold) {
  const Scene scene = cloudyScene();
  for (const FlightStart start :
       {FlightStart::runway, FlightStart::final, FlightStart::below, FlightStart::inside, FlightStart::above}) {
    Flight flight(scene, start);
    flight.setScene(scene, {}, {});
    for (int i = 0; i < 300; ++i) flight.advance({}, i / 60.0);
    EXPECT_FALSE(flight.aircraft().crashed) << static_cast<int>(start);
    EXPECT_EQ(flight.aircraft().onGround, start == FlightStart::runway);
    for (const FlightView view : {FlightView::cockpit, FlightView::chase}) {
      flight.pilot.setView(view);
      const Camera camera = flight.camera(scene.camera, {});
      EXPECT_GT(camera.position.z, flight.terrain().height(camera.position.x, camera.position.y) + 1.0);
      EXPECT_LT(glm::distance(camera.position, flight.aircraft().position), 25.0);
    }
  }
}

}  // namespace
}  // namespace welkin::viewer
