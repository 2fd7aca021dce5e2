// Navigation, actions, simple fields, the command line, the sun's way.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/viewer/model/actions.hpp"
#include "apps/viewer/model/command_line.hpp"
#include "apps/viewer/model/navigation.hpp"
#include "apps/viewer/model/simple_fields.hpp"
#include "apps/viewer/model/sun_path.hpp"
#include "welkin/scene/camera.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::viewer {
namespace {

TEST(Navigation, OrbitingKeepsThePivot) {
  Navigation navigation;
  Camera camera;
  camera.position = {100.0, -50.0, 3000.0};
  camera.pitch = -0.2f;
  const glm::dvec3 pivot = camera.position + cameraAxes(camera)[2] * navigation.pivotDistance;
  navigation.orbit(camera, {0.13f, 0.02f});
  const glm::dvec3 after = camera.position + cameraAxes(camera)[2] * navigation.pivotDistance;
  EXPECT_LT(glm::distance(pivot, after), 0.01);
  EXPECT_GT(glm::distance(camera.position, glm::dvec3(100.0, -50.0, 3000.0)), 100.0);
}

TEST(Navigation, NothingLeavesTheAir) {
  Navigation navigation;
  Camera camera;
  for (int i = 0; i < 200; ++i) {
    navigation.look(camera, {0.3f, 0.4f});
    navigation.fly(camera, {.forward = 6.0f, .up = -1.0f}, 1.0);
    navigation.pan(camera, {0.5f, -0.9f});
    navigation.orbit(camera, {0.2f, -0.7f});
    navigation.dolly(camera, 20.0f);
    ASSERT_GE(camera.position.z, 2.0);
    ASSERT_LE(camera.position.z, 60e3);
    ASSERT_LE(std::abs(camera.pitch), 1.5708f);
    ASSERT_GE(camera.heading, 0.0f);
    ASSERT_LE(camera.heading, 6.2832f);
  }
}

TEST(Navigation, LookingMovesThePictureWithThePointer) {
  Navigation navigation;
  Camera camera;
  camera.heading = 1.0f;
  navigation.look(camera, {0.1f, 0.0f});  // to the right: what was left comes into view
  EXPECT_LT(camera.heading, 1.0f);
}

TEST(Navigation, AJourneyEndsExactlyThereByTheShortWay) {
  Navigation navigation;
  Camera from, to;
  from.heading = 0.1f;
  to.heading = 6.2f;
  to.position = {1000.0, 2000.0, 3000.0};
  navigation.travel(from, to);
  Camera camera = from;
  for (int i = 0; i < 30; ++i) {
    navigation.advance(camera, 1.0 / 60.0);
    EXPECT_TRUE(camera.heading < 0.2f || camera.heading > 6.1f);
  }
  for (int i = 0; i < 60; ++i) navigation.advance(camera, 1.0 / 60.0);
  EXPECT_FALSE(navigation.travelling());
  EXPECT_TRUE(sameFields(camera, to));
}

TEST(Navigation, VantagesStandWhereTheyAreCalled) {
  Scene scene;
  const double base = scene.layers[0].cloud.base, top = base + scene.layers[0].cloud.thickness;
  EXPECT_LT(cameraAt(scene, Vantage::below).position.z, base);
  EXPECT_GT(cameraAt(scene, Vantage::inside).position.z, base);
  EXPECT_LT(cameraAt(scene, Vantage::inside).position.z, top);
  EXPECT_GT(cameraAt(scene, Vantage::above).position.z, top);
  scene.layers.clear();
  EXPECT_GT(cameraAt(scene, Vantage::above).position.z, 2000.0);
}

TEST(Actions, EachHasANameAndAKeyOfItsOwn) {
  std::set<std::string_view> names;
  std::set<std::string> chords;
  for (const ActionInfo& info : actions()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(chords.insert(nameOf(info.chord)).second) << nameOf(info.chord);
    EXPECT_EQ(actionNamed(info.name), info.action);
    EXPECT_EQ(actionOf(info.chord), info.action);
    EXPECT_EQ(infoOf(info.action).name, info.name);
  }
  EXPECT_FALSE(actionNamed("fly_to_the_moon"));
}

// A field that is renamed must not vanish from the simple list unnoticed.
TEST(SimpleFields, AllExist) {
  Scene scene;
  scene.sheets.emplace_back();
  scene.grids.emplace_back();
  scene.heroes.emplace_back();
  std::size_t simple = 0;
  std::set<std::string> seen;
  for (const Section& section : sectionsOf(scene))
    for (const Field& field : section.fields)
      if (isSimple(tableName(section.path), field.name) &&
          seen.insert(tableName(section.path) + "." + field.name).second)
        ++simple;
  EXPECT_EQ(simple, simpleFieldCount());
}

// As a POSIX shell splits a line without variables.
std::vector<std::string> shellWords(const std::string& line) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '\'')
      quoted = !quoted;
    else if (line[i] == '\\' && !quoted)
      words.back() += line[++i];
    else if (line[i] == ' ' && !quoted)
      words.emplace_back();
    else
      words.back() += line[i];
  return words;
}

TEST(CommandLine, NamesWhatDiffersAndNothingElse) {
  Scene scene;
  EXPECT_EQ(commandLine(scene, Scene{}, ""), "welkin render -o sky.png");
  scene.layers[0].weather.coverage = 0.5f;
  scene.title = "it's late";
  EXPECT_EQ(commandLine(scene, Scene{}, "sunset"),
            "welkin render sunset -o sky.png --set 'title=\"it'\\''s late\"' --set layer.0.weather.coverage=0.5");
}

TEST(CommandLine, SetsReadBackAsTheSameScene) {
  Scene scene;
  scene.camera.position = {1.0, -2.5, 1234.5};
  scene.sun.elevation = 0.1f;
  scene.wind.from = 0.3f;
  Scene read;
  int sets = 0;
  const std::vector<std::string> words = shellWords(commandLine(scene, Scene{}, ""));
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "--set") setField(read, words[i + 1]), ++sets;
  EXPECT_EQ(sets, 3);
  EXPECT_TRUE(sameScene(scene, read));
}

TEST(SunPath, NoonIsHighestAndRiseAndSetLieAboutIt) {
  Sun sun;
  sun.mode = SunMode::place;
  sun.date = "2026-03-20";
  sun.utcOffset = 3600.0f;
  sun.latitude = static_cast<float>(48.0 * kDegree);
  sun.longitude = static_cast<float>(15.0 * kDegree);
  EXPECT_GT(sunAt(sun, 12.1).elevation, sunAt(sun, 9.0).elevation);
  EXPECT_NEAR(sunAt(sun, 12.1).elevation / kDegree, 42.0, 0.5);
  const SunTimes times = sunTimes(sun);
  ASSERT_TRUE(times.rise && times.set);
  // An equinox: half a day between them, but for some minutes.
  EXPECT_NEAR(*times.set - *times.rise, 12.0, 0.15);
  EXPECT_NEAR(sunAt(sun, *times.rise).elevation, 0.0, 1e-5);
  EXPECT_NEAR(hourNearest(sun, sunAt(sun, 15.25)), 15.25, 0.01);
}

TEST(SunPath, PolarDaysHaveNoSunset) {
  Sun sun;
  sun.date = "2026-06-21";
  sun.latitude = static_cast<float>(80.0 * kDegree);
  EXPECT_FALSE(sunTimes(sun).rise);
  EXPECT_FALSE(sunTimes(sun).set);
}

TEST(SunPath, TextsAndNumbersAreInverse) {
  EXPECT_EQ(textFromHour(hourFromText("18:30")), "18:30:00");
  EXPECT_EQ(textFromHour(24.0), "23:59:59");
  EXPECT_EQ(hourFromText("noon"), 12.0);
  EXPECT_EQ(dayOfYear("2024-12-31"), 366);
  EXPECT_EQ(dateOfDay("2024-05-05", 60), "2024-02-29");
  EXPECT_EQ(dateOfDay("2023-05-05", 400), "2023-12-31");
  EXPECT_EQ(daysInYear("nonsense"), 365);
  for (int day = 1; day <= 365; ++day) EXPECT_EQ(dayOfYear(dateOfDay("2026-01-01", day)), day);
}

}  // namespace
}  // namespace welkin::viewer
