#include "welkin/scene/sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/scene/random_scene.hpp"
#include "welkin/base/error.hpp"

namespace welkin {
namespace {

Scene fullScene() {
  Scene scene;
  scene.layers.resize(2);
  scene.sheets.resize(1);
  scene.heroes.resize(1);
  return scene;
}

TEST(Sections, HaveDistinctPathsFieldsAndObjects) {
  Scene scene = fullScene();
  std::set<std::string> paths;
  std::set<void*> objects;
  for (const Section& s : sectionsOf(scene)) {
    EXPECT_TRUE(paths.insert(s.path).second) << s.path;
    EXPECT_TRUE(objects.insert(s.object).second) << s.path;
    EXPECT_FALSE(s.fields.empty()) << s.path;
    std::set<std::string> names;
    for (const Field& f : s.fields) EXPECT_TRUE(names.insert(f.name).second) << s.path << "." << f.name;
  }
  for (const char* path : {"", "sun", "atmosphere", "wind", "ground", "lighting", "camera", "film", "quality",
                           "layer.0", "layer.1.weather", "layer.1.profile", "layer.0.nubis", "sheet.0"})
    EXPECT_TRUE(paths.count(path)) << path;
}

// What the sky file, the sliders and the docs rely on.
TEST(Sections, EveryFieldIsDescribedBoundedAndStartsInRange) {
  Scene scene = fullScene();
  for (const Section& s : sectionsOf(scene))
    for (const Field& f : s.fields) {
      SCOPED_TRACE(s.path + "." + f.name);
      EXPECT_NE(std::string(f.help), "");
      EXPECT_EQ(std::string(f.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
      FieldValue value = f.defaultValue;
      EXPECT_EQ(checkField(f, value), "");
      if (f.kind == FieldKind::real || f.kind == FieldKind::integer || f.kind == FieldKind::vector) {
        EXPECT_TRUE(std::isfinite(f.hard.low) && std::isfinite(f.hard.high));
        EXPECT_LT(f.hard.low, f.hard.high);
        EXPECT_GE(f.soft.low, f.hard.low);
        EXPECT_LE(f.soft.high, f.hard.high);
      }
    }
}

TEST(Sections, AssignedValuesAreReadBack) {
  Scene scene = fullScene();
  std::mt19937 random(5);
  for (const Section& s : sectionsOf(scene))
    for (const Field& f : s.fields) {
      if (s.path == "quality" && f.name == std::string_view("preset")) continue;
      const FieldValue value = test::randomValue(f, random);
      ASSERT_EQ(assign(scene, s, f, value), "") << s.path << "." << f.name;
      const FieldValue back = f.get(s.object);
      if (!f.singlePrecision) {
        EXPECT_EQ(back, value) << s.path << "." << f.name;
      } else if (const double* real = std::get_if<double>(&value)) {
        EXPECT_NEAR(std::get<double>(back), *real, 1e-6 * std::abs(*real) + 1e-30) << s.path << "." << f.name;
      }
    }
}

TEST(Sections, TableNamesDropTheNumbers) {
  EXPECT_EQ(tableName("layer.10.weather"), "layer.weather");
  EXPECT_EQ(tableName("sheet.0"), "sheet");
  EXPECT_EQ(tableName("noise.base_shape"), "noise.base_shape");
  EXPECT_EQ(tableName(""), "");
}

TEST(Sections, SameSceneSeesEveryField) {
  const Scene scene = fullScene();
  EXPECT_TRUE(sameScene(scene, scene));
  Scene counted = fullScene();
  const std::size_t sections = sectionsOf(counted).size();
  std::mt19937 random(7);
  for (std::size_t i = 0; i < sections; ++i) {
    const auto fields = sectionsOf(counted)[i].fields;
    for (const Field& f : fields) {
      if (f.kind == FieldKind::file) continue;
      Scene other = fullScene();
      const Section s = sectionsOf(other)[i];
      FieldValue value = f.get(s.object);
      while (value == f.get(s.object)) value = test::randomValue(f, random);
      assign(other, s, f, value);
      EXPECT_FALSE(sameScene(scene, other)) << s.path << "." << f.name;
    }
  }
  Scene fewer = scene;
  fewer.sheets.clear();
  EXPECT_FALSE(sameScene(scene, fewer));
}

TEST(Quality, TheDefaultIsHigh) { EXPECT_EQ(Quality{}, qualityPreset(QualityPreset::high)); }

TEST(Quality, APresetSetsTheWholeTable) {
  Scene scene;
  scene.quality.lightSteps = 16;
  setField(scene, "quality.preset=low");
  EXPECT_EQ(scene.quality, qualityPreset(QualityPreset::low));
  EXPECT_NE(scene.quality, qualityPreset(QualityPreset::ultra));
}

std::string refusal(const std::string& assignment) {
  Scene scene = fullScene();
  try {
    setField(scene, assignment);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::badInput);
    return e.what();
  }
  return "accepted";
}

TEST(SetField, ReadsEveryKind) {
  Scene scene = fullScene();
  setField(scene, "layer.1.weather.coverage = 0.25");
  EXPECT_EQ(scene.layers[1].weather.coverage, 0.25f);
  setField(scene, "layer.base=900");
  EXPECT_EQ(scene.layers[0].cloud.base, 900.0f);
  setField(scene, "sheet.kind=cirrostratus");
  EXPECT_EQ(scene.sheets[0].kind, SheetKind::cirrostratus);
  setField(scene, "camera.position=1,-2.5,3e3");
  EXPECT_EQ(scene.camera.position, glm::dvec3(1, -2.5, 3000));
  setField(scene, "camera.position=[4, 5, 6]");
  EXPECT_EQ(scene.camera.position, glm::dvec3(4, 5, 6));
  setField(scene, "quality.jitter=false");
  EXPECT_FALSE(scene.quality.jitter);
  setField(scene, "title=\"two words\"");
  EXPECT_EQ(scene.title, "two words");
  setField(scene, "seed=12");
  EXPECT_EQ(scene.seed, 12);
  setField(scene, "camera.heading=90");
  EXPECT_NEAR(scene.camera.heading, 1.5707963f, 1e-6f);
}

TEST(SetField, SaysWhatIsWrong) {
  EXPECT_EQ(refusal("seed"), "seed: write it as key=value, for example sun.elevation=20");
  EXPECT_EQ(refusal("sun.elevaton=3"),
            "sun.elevaton=3: 'sun.elevaton' is not a parameter; did you mean 'sun.elevation'?");
  EXPECT_EQ(refusal("qqqqqqqqqqqq=3"), "qqqqqqqqqqqq=3: 'qqqqqqqqqqqq' is not a parameter; `welkin fields` lists them");
  EXPECT_EQ(refusal("sun.elevation=high"), "sun.elevation=high: sun.elevation must be a number");
  EXPECT_EQ(refusal("sun.elevation=91"), "sun.elevation=91: sun.elevation is 91, outside -90 to 90 deg");
  EXPECT_EQ(refusal("sun.elevation=nan"), "sun.elevation=nan: sun.elevation is not a finite number");
  EXPECT_EQ(refusal("seed=1.5"), "seed=1.5: seed must be a whole number");
  EXPECT_EQ(refusal("seed=99999999999999999999"), "seed=99999999999999999999: seed must be a whole number");
  EXPECT_EQ(refusal("layer.2.base=3"), "layer.2.base=3: the sky has 2 [[layer]]; they are counted from 0");
  EXPECT_EQ(refusal("camera.position=1,2"), "camera.position=1,2: camera.position must be three numbers, [x, y, z]");
  EXPECT_EQ(refusal("layer.weather.map=no.png"),
            "layer.weather.map=no.png: layer.0.weather.map names the file 'no.png', which does not exist");
  EXPECT_EQ(refusal("sun.elevation=20"), "accepted");
}

TEST(FormatValue, IsTheShortestTextWithTheSameBits) {
  Scene scene;
  const std::vector<Section> all = sectionsOf(scene);
  const auto found = std::find_if(all.begin(), all.end(), [](const Section& s) { return s.path == "film"; });
  ASSERT_NE(found, all.end());
  const Section& film = *found;
  EXPECT_EQ(formatValue(*findField(film, "ev"), 14.6f), "14.6");
  EXPECT_EQ(formatValue(*findField(film, "ev"), 15.0), "15.0");
  EXPECT_EQ(formatValue(*findField(film, "tone"), std::string("agx")), "\"agx\"");
}

}  // namespace
}  // namespace welkin
