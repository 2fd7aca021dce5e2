#include "welkin/scene/animation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin {
namespace {

Keyframe key(double time, const char* path, FieldValue value, Interpolation how = Interpolation::linear) {
  return {time, how, {{path, std::move(value)}}};
}

double elevation(const Scene& scene, double time) { return sceneAt(scene, time).sun.elevation / kDegree; }
double azimuth(const Scene& scene, double time) { return sceneAt(scene, time).sun.azimuth / kDegree; }

TEST(Animation, LinearHoldsBeforeAndAfter) {
  Scene scene;
  scene.keyframes = {key(20.0, "sun.elevation", 30.0), key(10.0, "sun.elevation", 10.0)};  // in any order
  EXPECT_NEAR(elevation(scene, 0.0), 10.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 10.0), 10.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 12.5), 15.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 20.0), 30.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 1e6), 30.0, 1e-4);
  const Scene at = sceneAt(scene, 12.5);
  EXPECT_TRUE(at.keyframes.empty());
  EXPECT_EQ(at.time, 12.5f);
  // Nothing else has changed.
  Scene same = at;
  same.sun = scene.sun;
  same.time = scene.time;
  same.keyframes = scene.keyframes;
  EXPECT_TRUE(sameScene(same, scene));
}

TEST(Animation, StepStaysUntilTheNext) {
  Scene scene;
  scene.keyframes = {key(0.0, "sun.elevation", 10.0, Interpolation::step), key(5.0, "sun.elevation", 20.0),
                     key(6.0, "sun.elevation", 30.0)};
  EXPECT_NEAR(elevation(scene, 4.999), 10.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 5.0), 20.0, 1e-4);
  EXPECT_NEAR(elevation(scene, 5.5), 25.0, 1e-4);
}

// Two keyframes: the cubic 3 t^2 - 2 t^3. More: continuous speed, and never beyond the values on either side.
TEST(Animation, SmoothIsAMonotoneCubic) {
  Scene scene;
  const auto smooth = Interpolation::smooth;
  scene.keyframes = {key(0.0, "sun.elevation", 0.0, smooth), key(4.0, "sun.elevation", 40.0, smooth)};
  for (const double t : {0.25, 0.5, 0.9}) EXPECT_NEAR(elevation(scene, 4.0 * t), 40.0 * t * t * (3.0 - 2.0 * t), 1e-4);

  scene.keyframes = {key(0.0, "sun.elevation", 0.0, smooth), key(1.0, "sun.elevation", 10.0, smooth),
                     key(3.0, "sun.elevation", 12.0, smooth), key(4.0, "sun.elevation", 5.0, smooth)};
  const double h = 2e-3;
  for (const double at : {1.0, 3.0}) {
    const double before = (elevation(scene, at) - elevation(scene, at - h)) / h;
    const double after = (elevation(scene, at + h) - elevation(scene, at)) / h;
    EXPECT_NEAR(before, after, 0.1) << at;
  }
  EXPECT_GT(elevation(scene, 1.0 + h) - elevation(scene, 1.0), 0.5 * h);  // passes without stopping
  for (double t = 1.0; t <= 3.0; t += 0.05) {
    EXPECT_GE(elevation(scene, t), 10.0 - 1e-4);
    EXPECT_LE(elevation(scene, t), 12.0 + 1e-4);
  }
}

TEST(Animation, AnglesGoTheShortWayRound) {
  Scene scene;
  scene.keyframes = {key(0.0, "sun.azimuth", 350.0), key(2.0, "sun.azimuth", 20.0), key(4.0, "sun.azimuth", 190.0)};
  EXPECT_NEAR(azimuth(scene, 0.5), 357.5, 1e-3);
  EXPECT_NEAR(azimuth(scene, 1.0), 5.0, 1e-3);
  EXPECT_NEAR(azimuth(scene, 3.0), 105.0, 1e-3);
  scene.keyframes = {key(0.0, "night.sidereal_time", 23.0), key(2.0, "night.sidereal_time", 2.0)};
  EXPECT_NEAR(sceneAt(scene, 1.0).night.siderealTime / 3600.0, 0.5, 1e-3);
}

// Which fields come round again, by name, so that a new one is thought of.
TEST(Animation, FieldsThatComeRoundAgain) {
  Scene scene;
  scene.sheets.emplace_back();
  scene.grids.emplace_back();
  std::set<std::string> found;
  for (const Section& s : sectionsOf(scene))
    for (const Field& f : s.fields)
      if (periodOf(f) > 0.0) found.insert(tableName(s.path) + "." + f.name);
  for (const char* name : {"sun.azimuth", "moon.azimuth", "camera.heading", "camera.roll", "wind.from",
                           "night.sidereal_time", "sun.longitude"})
    EXPECT_EQ(found.count(name), 1u) << name;
  for (const char* name : {"sun.elevation", "camera.pitch", "camera.fov", "sun.latitude", "sun.utc_offset"})
    EXPECT_EQ(found.count(name), 0u) << name;
}

TEST(Animation, VectorsAndWhatIsNoNumber) {
  Scene scene;
  scene.keyframes = {key(0.0, "camera.position", std::array{0.0, 10.0, 100.0}),
                     key(4.0, "camera.position", std::array{100.0, 10.0, 300.0}),
                     key(0.0, "ground.albedo", std::array{0.0, 0.2, 0.4}),
                     key(4.0, "ground.albedo", std::array{1.0, 0.4, 0.4}),
                     key(2.0, "film.tone", std::string("aces")),
                     key(3.0, "quality.jitter", false),
                     key(1.0, "seed", std::int64_t{4}),
                     key(3.0, "seed", std::int64_t{9})};
  const Scene at = sceneAt(scene, 2.0);
  EXPECT_EQ(at.camera.position, glm::dvec3(50.0, 10.0, 200.0));
  EXPECT_NEAR(at.ground.albedo.x, 0.5f, 1e-6f);
  EXPECT_NEAR(at.ground.albedo.y, 0.3f, 1e-6f);
  EXPECT_EQ(at.film.tone, ToneCurve::aces);
  EXPECT_FALSE(at.quality.jitter);  // a single keyframe holds for all time
  EXPECT_EQ(at.seed, 4);
  EXPECT_EQ(sceneAt(scene, 3.0).seed, 9);
}

TEST(Animation, APresetOfQualityComesBeforeItsSwitches) {
  Scene scene;
  scene.keyframes = {
      {0.0, Interpolation::step, {{"quality.light_steps", std::int64_t{16}}, {"quality.preset", std::string("low")}}}};
  Quality expected = qualityPreset(QualityPreset::low);
  expected.lightSteps = 16;
  EXPECT_EQ(sceneAt(scene, 0.0).quality, expected);
}

TEST(Animation, HoursOfTheSun) {
  Scene scene;
  scene.sun.mode = SunMode::place;
  scene.sun.date = "2026-06-21";
  scene.keyframes = {key(0.0, "sun.time", std::string("22:00")), key(8.0, "sun.time", std::string("02:00"))};
  EXPECT_EQ(sceneAt(scene, 2.0).sun.time, "23:00:00.000");
  EXPECT_EQ(sceneAt(scene, 2.0).sun.date, "2026-06-21");
  EXPECT_EQ(sceneAt(scene, 6.0).sun.time, "01:00:00.000");
  EXPECT_EQ(sceneAt(scene, 6.0).sun.date, "2026-06-22");  // past midnight it is the next day
  // The same with dates.
  scene.keyframes[0].values.push_back({"sun.date", std::string("2026-12-31")});
  scene.keyframes[1].values.push_back({"sun.date", std::string("2027-01-01")});
  EXPECT_EQ(sceneAt(scene, 6.0).sun.date, "2027-01-01");
  EXPECT_EQ(sceneAt(scene, 6.0).sun.time, "01:00:00.000");
}

TEST(Animation, DatesWithoutHoursGoByWholeDays) {
  Scene scene;
  scene.sun.time = "06:30";
  scene.keyframes = {key(0.0, "sun.date", std::string("2026-02-27")), key(4.0, "sun.date", std::string("2026-03-03"))};
  const char* dates[] = {"2026-02-27", "2026-02-28", "2026-03-01", "2026-03-02", "2026-03-03"};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(sceneAt(scene, i).sun.date, dates[i]);
    EXPECT_EQ(sceneAt(scene, i + 0.9).sun.date, dates[i]);
    EXPECT_EQ(sceneAt(scene, i).sun.time, "06:30");
  }
}

TEST(Animation, RefusesWhatCannotBeSet) {
  const auto refusal = [](Keyframe keyframe) -> std::string {
    Scene scene;
    scene.keyframes = {std::move(keyframe)};
    try {
      sceneAt(scene, 0.0);
    } catch (const Error& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(key(0.0, "sun.elevatoin", 1.0)),
            "keyframe: 'sun.elevatoin' is not a parameter; did you mean 'sun.elevation'?");
  EXPECT_EQ(refusal(key(0.0, "sun.elevation", 100.0)), "keyframe: sun.elevation is 100, outside -90 to 90 deg");
  EXPECT_EQ(refusal(key(0.0, "sun.elevation", true)), "keyframe: sun.elevation must be a number");
  EXPECT_EQ(refusal(key(0.0, "layer.3.base", 100.0)), "keyframe: the sky has 1 [[layer]]; they are counted from 0");
}

TEST(Animation, KeyframesCanBeTakenOut) {
  Scene scene;
  scene.keyframes = {{0.0, Interpolation::linear, {{"sun.elevation", 1.0}, {"camera.heading", 2.0}}},
                     key(1.0, "quality.jitter", false)};
  EXPECT_TRUE(hasKeyframes(scene, "sun."));
  dropKeyframes(scene, "sun.elevation");
  EXPECT_FALSE(hasKeyframes(scene, "sun."));
  EXPECT_TRUE(hasKeyframes(scene, "camera.heading"));
  EXPECT_FALSE(hasKeyframes(scene, "camera.head")) << "another parameter";
  dropKeyframes(scene, "quality.preset");
  EXPECT_EQ(scene.keyframes.size(), 1u);
}

// The day that passes by angles goes the way of the sun that date and place give.
TEST(Animation, TheDayPassesAsTheSunGoes) {
  Scene place;
  place.sun.mode = SunMode::place;
  place.sun.time = "09:00";
  const double days = daysFromDateTime(place.sun.date, place.sun.time);
  const SolarPosition begin = solarPosition(days, place.sun.latitude, place.sun.longitude);
  Scene angles;
  angles.sun.elevation = static_cast<float>(begin.elevation);
  angles.sun.azimuth = static_cast<float>(begin.azimuth);
  angles.sun.latitude = place.sun.latitude;
  for (const double hours : {1.0, 4.0, 8.0}) {
    Scene a = angles, b = place;
    passDay(a, 3600.0 * hours);
    passDay(b, 3600.0 * hours);
    EXPECT_EQ(b.sun.time, hours == 1.0 ? "10:00:00.000" : hours == 4.0 ? "13:00:00.000" : "17:00:00.000");
    EXPECT_GT(glm::dot(sunDirection(a.sun), sunDirection(b.sun)), std::cos(0.2 * kDegree)) << hours;
  }
  Scene round = angles;
  passDay(round, 86400.0);
  EXPECT_NEAR(round.sun.azimuth, angles.sun.azimuth, 1e-4f);
  EXPECT_NEAR(round.sun.elevation, angles.sun.elevation, 1e-4f);
  EXPECT_NEAR(round.night.siderealTime - angles.night.siderealTime, 236.6f, 1.0f);
}

}  // namespace
}  // namespace welkin
