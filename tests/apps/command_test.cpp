#include "tests/apps/command.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "welkin/io/file.hpp"
#include "welkin/scene/sections.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;

void expectUsage(const std::string& arguments, const std::string& message) {
  const Outcome o = run(arguments);
  EXPECT_EQ(o.code, 2) << arguments;
  EXPECT_EQ(o.out, "") << arguments;
  EXPECT_EQ(o.err.rfind("welkin: " + message, 0), 0u) << arguments << ": " << o.err;
}

TEST(Command, HelpAndVersionGoToStdout) {
  const Outcome help = run("--help"), version = run("--version"), sub = run("render --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* word : {"  render", "  hdri", "  compare", "  presets", "  fields", "  check", "  info", "  noise",
                           "  weather", "  doctor"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("welkin ", 0), 0u);
  EXPECT_EQ(sub.code, 0);
  EXPECT_NE(sub.out.find("--size"), std::string::npos);
}

TEST(Command, WrongUseEndsWith2) {
  expectUsage("", "A subcommand is required");
  expectUsage("chek default", "'chek' is not a command; did you mean 'check'?");
  expectUsage("check default --sett a=1", "'--sett' is not an option; did you mean '--set'?");
  expectUsage("check", "sky is required");
  expectUsage("check default --seed many", "Could not convert");
  expectUsage("check default --set sun.elevaton=3", "sun.elevaton=3: 'sun.elevaton' is not a parameter; did you mean");
  expectUsage("check default --set layer.weather.coverage=7",
              "layer.weather.coverage=7: layer.0.weather.coverage is 7,");
  expectUsage("render", "--output is required");
  expectUsage("render -o a.jpg", "'a.jpg': a picture's name ends in .png or .exr");
  expectUsage("render -o a.png --size 0x9", "--size 0x9: write WIDTHxHEIGHT");
  expectUsage("render -o a.png --size 10", "--size 10: write WIDTHxHEIGHT");
  expectUsage("render -o a.png --size 10x10x", "--size 10x10x: write WIDTHxHEIGHT");
  expectUsage("render -o a.png --camera 1,2", "--camera 1,2: write east,north,up");
  expectUsage("render -o a.png --camera 'headng=3'",
              "camera.headng=3: 'camera.headng' is not a parameter; did you mean");
  expectUsage("render -o a.png --quality best", "quality.preset=best: quality.preset is \"best\", but must be one of");
  expectUsage("render -o a.png --tone agg", "film.tone=agg:");
}

TEST(Command, BadInputEndsWith3) {
  const std::string file = testing::TempDir() + "welkin_bad.sky.toml";
  writeFileAtomically(file, "format = 1\n[sun]\nelevaton = 3\n");
  const Outcome bad = run("check " + file);
  EXPECT_EQ(bad.code, 3);
  EXPECT_EQ(bad.out, "");
  EXPECT_EQ(bad.err, "welkin: " + file + ":3:1: 'elevaton' is not a parameter of sun; did you mean 'elevation'?\n");
  // Nothing is rendered from a bad file.
  const std::string picture = testing::TempDir() + "welkin_bad.png";
  EXPECT_EQ(run("render " + file + " -o " + picture).code, 3);
  EXPECT_FALSE(std::filesystem::exists(picture));
  EXPECT_EQ(run("check no_such_file.sky.toml").code, 3);
  const Outcome near = run("check defalt");
  EXPECT_EQ(near.code, 3);
  EXPECT_EQ(near.err, "welkin: defalt: is neither a file nor a preset; did you mean 'default'?\n");
  std::filesystem::remove(file);
}

TEST(Command, FailuresEndWith1) {
  const Outcome folder = run("render -o /no/such/folder/a.png --size 8x8");
  EXPECT_EQ(folder.code, 1);
  EXPECT_EQ(folder.err,
            "welkin: /no/such/folder/a.png: cannot be written: No such file or directory; make the folder first\n");
  if (std::filesystem::exists("/dev/full")) {
    const int status = std::system(("'" WELKIN_BINARY_DIR "/bin/welkin' fields >/dev/full 2>/dev/null"));
    EXPECT_EQ(WEXITSTATUS(status), 1);
  }
}

TEST(Command, CheckSaysWhatTheSkyHolds) {
  const Outcome o = run("check default");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(o.out, "default: a sky of 1 layer and 0 sheets\n");
}

TEST(Command, FieldsListEveryParameter) {
  Scene scene;
  scene.sheets.emplace_back();
  scene.grids.emplace_back();
  scene.heroes.emplace_back();
  const json fields = json::parse(run("fields --json").out);
  std::size_t expected = 0;
  for (const Section& s : sectionsOf(scene)) expected += s.fields.size();
  ASSERT_EQ(fields.size(), expected);
  for (const json& f : fields) {
    for (const char* key : {"path", "kind", "unit", "default", "help"}) EXPECT_TRUE(f.contains(key)) << f;
    EXPECT_FALSE(f["default"].is_discarded()) << f;
    const std::string kind = f["kind"];
    EXPECT_EQ(f.contains("range"), kind == "real" || kind == "integer" || kind == "vector") << f;
  }
  const std::string text = run("fields").out;
  EXPECT_NE(text.find("[layer.weather]"), std::string::npos);
  EXPECT_NE(text.find("coverage"), std::string::npos);
}

TEST(Command, PresetsAreListedWithGenusAndSentence) {
  const Outcome o = run("presets --json");
  EXPECT_EQ(o.code, 0);
  const json presets = json::parse(o.out);
  ASSERT_TRUE(presets.is_array());
  bool hasDefault = false;
  for (const json& p : presets) {
    for (const char* key : {"name", "genus", "sentence", "file"}) EXPECT_NE(p[key], "") << p;
    EXPECT_EQ(run("check " + p["name"].get<std::string>()).code, 0) << p;
    hasDefault = hasDefault || p["name"] == "default";
  }
  EXPECT_TRUE(hasDefault);
}

TEST(Command, PresetsFolderCanBeChosen) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "welkin_presets";
  std::filesystem::create_directories(folder);
  writeFileAtomically((folder / "mine.sky.toml").string(), "# One sentence\n# on two lines.\nformat = 1\n");
  const json presets = json::parse(run("presets --json", "WELKIN_PRESETS=" + folder.string()).out);
  ASSERT_EQ(presets.size(), 1u);
  EXPECT_EQ(presets[0]["name"], "mine");
  EXPECT_EQ(presets[0]["sentence"], "One sentence on two lines.");
  const Outcome none = run("presets --json", "WELKIN_PRESETS=/no/such");
  EXPECT_EQ(none.out, "[]\n");
  EXPECT_NE(none.err, "");
  std::filesystem::remove_all(folder);
}

TEST(Command, InfoDescribesEveryLayerAndSheet) {
  const std::string file = testing::TempDir() + "welkin_info.sky.toml";
  writeFileAtomically(file, "format = 1\n[[sheet]]\nkind = \"cirrostratus\"\nheight = 8000\n");
  const Outcome o = run("info --json " + file);
  ASSERT_EQ(o.code, 0) << o.err;
  const json report = json::parse(o.out);
  EXPECT_TRUE(report["layers"].empty());
  ASSERT_EQ(report["sheets"].size(), 1u);
  EXPECT_EQ(report["sheets"][0]["genus"], "cirrostratus");
  EXPECT_EQ(report["sheets"][0]["configured_height"], 8000);
  EXPECT_GT(report["sheets"][0]["cover"], 0.0);
  EXPECT_GT(report["sheets"][0]["mean_optical_depth"], 0.0);
  std::filesystem::remove(file);
  const json plain = json::parse(run("info --json").out);
  ASSERT_EQ(plain["layers"].size(), 1u);
  EXPECT_EQ(plain["layers"][0]["genus"], "cumulus");
  const json& layer = plain["layers"][0];
  const double cover = layer["cover"], mean = layer["mean_optical_depth"], cloudy = layer["cloudy_optical_depth"];
  EXPECT_GT(cover, 0.05);
  EXPECT_LT(cover, 0.95);
  // What stands outside the cloudy columns adds at most the threshold.
  EXPECT_NEAR(mean, cover * cloudy, 0.3 + 1e-3 * mean);
  EXPECT_GT(layer["median_optical_depth"], 0.3);
  EXPECT_NEAR(layer["base"], layer["configured_base"], 150.0);
  EXPECT_LT(layer["base"], layer["top"]);
  EXPECT_NE(run("info").out.find("layer 0  cumulus"), std::string::npos);
  const json clear = json::parse(run("info --json --set layer.extinction=0").out);
  EXPECT_EQ(clear["layers"][0]["cover"], 0.0);
}

TEST(Command, DoctorReportsTheDriver) {
  const Outcome o = run("doctor --json");
  const json report = json::parse(o.out);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(report["opengl"]["available"].get<bool>());
  EXPECT_NE(report["opengl"]["renderer"], "");
  EXPECT_FALSE(report["cpu"]["simd"].empty());
  EXPECT_EQ(report["missing"].empty(), hasOpenVdb()) << report;
}

// An EGL without any driver: what a bare container has.
TEST(Command, WithoutOpenGlItEndsWith4) {
  const std::string bare = "__EGL_VENDOR_LIBRARY_FILENAMES=/no/such.json";
  const Outcome doctor = run("doctor --json", bare);
  EXPECT_EQ(doctor.code, 4) << doctor.err;
  EXPECT_FALSE(json::parse(doctor.out)["missing"].empty());
  const std::string picture = testing::TempDir() + "welkin_nogl.png";
  const Outcome render = run("render -o " + picture + " --size 8x8", bare);
  EXPECT_EQ(render.code, 4) << render.err;
  EXPECT_FALSE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace welkin
