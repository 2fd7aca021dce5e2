#include "welkin/io/sky_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/scene/random_scene.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

std::string refusal(const std::string& text) {
  try {
    parseSky(text, "a.sky.toml");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::badInput);
    return e.what();
  }
  return "accepted";
}

TEST(SkyFile, AnEmptySkyIsTheDefaultOne) {
  EXPECT_TRUE(sameScene(parseSky("format = 1\n", "a"), Scene{}));
  EXPECT_EQ(writeSky(Scene{}), "format = 1\n");
}

TEST(SkyFile, AListReplacesTheDefaultList) {
  EXPECT_EQ(parseSky("format = 1\n[[sheet]]\n", "a").layers.size(), 0u);
  EXPECT_EQ(parseSky("format = 1\n[[sheet]]\n", "a").sheets.size(), 1u);
  EXPECT_EQ(parseSky("format = 1\nlayer = []\n", "a").layers.size(), 0u);
  EXPECT_EQ(parseSky("format = 1\nsheet = []\nlayer = [{}, {base = 3000}]\n", "a").layers.size(), 2u);
  EXPECT_EQ(
      parseSky("format = 1\n[[layer]]\n[layer.weather]\ncoverage = 0.1\n[[layer]]\n", "a").layers[0].weather.coverage,
      0.1f);
}

TEST(SkyFile, ReadsUnits) {
  const Scene s = parseSky("format = 1\n[sun]\nelevation = 90\n[camera]\nposition = [1, 2.5, 3]\n", "a");
  EXPECT_NEAR(s.sun.elevation, 1.5707963f, 1e-6f);
  EXPECT_EQ(s.camera.position, glm::dvec3(1, 2.5, 3));
}

TEST(SkyFile, OtherQualityKeysWinOverThePreset) {
  const Scene s = parseSky("format = 1\n[quality]\nlight_steps = 16\npreset = \"low\"\n", "a");
  Quality expected = qualityPreset(QualityPreset::low);
  expected.lightSteps = 16;
  EXPECT_EQ(s.quality, expected);
}

TEST(SkyFile, OtherHeroKeysWinOverTheSpecies) {
  const Scene s = parseSky(
      "format = 1\n[[hero]]\nextinction = 0.07\nspecies = \"incus\"\n[hero.form]\nanvil = 7000\n[[hero]]\n", "x");
  ASSERT_EQ(s.heroes.size(), 2u);
  EXPECT_EQ(s.heroes[0].cloud.extinction, 0.07f);
  EXPECT_EQ(s.heroes[0].form.anvil, 7000.0f);
  EXPECT_EQ(s.heroes[0].form.height, heroPreset(HeroSpecies::incus).form.height);
  EXPECT_TRUE(s.layers.empty());
  EXPECT_EQ(writeSky(s),
            "format = 1\n\n[[hero]]\nspecies = \"incus\"\nextinction = 0.07\n\n[hero.form]\nanvil = 7000.0\n\n"
            "[[hero]]\n");
}

TEST(SkyFile, ClassicalCloudsHaveATableForEachKind) {
  const char* text =
      "format = 1\n\n[[classical]]\nkind = \"automaton\"\n\n[classical.automaton]\nwidth = 192\n\n[[classical]]\n";
  const Scene s = parseSky(text, "a");
  ASSERT_EQ(s.classical.size(), 2u);
  EXPECT_EQ(s.classical[0].automaton.width, 192);
  EXPECT_TRUE(s.layers.empty());
  EXPECT_EQ(writeSky(s), text);
}

TEST(SkyFile, WritesOnlyWhatDiffers) {
  Scene s;
  s.title = "Evening";
  s.sun.elevation = 0.1f;
  s.layers[0].weather.coverage = 0.7f;
  s.quality = qualityPreset(QualityPreset::medium);
  s.quality.jitter = false;
  EXPECT_EQ(writeSky(s),
            "format = 1\ntitle = \"Evening\"\n\n[sun]\nelevation = 5.729578\n\n[quality]\npreset = \"medium\"\n"
            "jitter = false\n\n[[layer]]\n\n[layer.weather]\ncoverage = 0.7\n");
}

TEST(SkyFile, RandomScenesComeBackBitForBit) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Scene scene = test::randomAnimation(seed, seed % 2 ? 0.2 : 1.0);
    const std::string text = writeSky(scene);
    const Scene back = parseSky(text, "random");
    ASSERT_TRUE(sameScene(scene, back)) << "seed " << seed << "\n" << text;
    ASSERT_EQ(writeSky(back), text) << seed;
  }
}

TEST(SkyFile, RefusesToWriteMoreThanItReads) {
  Scene scene;
  scene.layers.resize(5);
  EXPECT_THROW(writeSky(scene), Error);
}

TEST(SkyFile, ReadsKeyframes) {
  const Scene s = parseSky(
      "format = 1\n[[keyframe]]\ntime = 0\nsun.elevation = 3\nlayer.weather.coverage = 0.25\n"
      "[[keyframe]]\ntime = 2.5\ninterpolation = \"smooth\"\n[keyframe.camera]\nposition = [1, 2, 3]\n",
      "a");
  ASSERT_EQ(s.keyframes.size(), 2u);
  EXPECT_EQ(s.keyframes[0].time, 0.0);
  EXPECT_EQ(s.keyframes[0].interpolation, Interpolation::linear);
  ASSERT_EQ(s.keyframes[0].values.size(), 2u);
  EXPECT_EQ(s.keyframes[0].values[0].path, "layer.0.weather.coverage");
  EXPECT_EQ(std::get<double>(s.keyframes[0].values[0].value), 0.25);
  EXPECT_EQ(s.keyframes[1].time, 2.5);
  EXPECT_EQ(s.keyframes[1].interpolation, Interpolation::smooth);
  EXPECT_EQ(s.keyframes[1].values[0].value, FieldValue(std::array{1.0, 2.0, 3.0}));
  // They change nothing but with time.
  Scene still = s;
  still.keyframes.clear();
  EXPECT_TRUE(sameScene(still, Scene{}));
  EXPECT_FALSE(sameScene(s, Scene{}));
}

TEST(SkyFile, AFileOfKeyframesHasNothingElse) {
  const std::string path = testing::TempDir() + "welkin_camera.toml";
  const auto refusalOf = [&](const std::string& text) -> std::string {
    writeFileAtomically(path, text);
    try {
      loadKeyframes(path, Scene{});
    } catch (const Error& e) {
      return std::string(e.what()).substr(path.size());
    }
    return "accepted";
  };
  EXPECT_EQ(refusalOf("format = 1\n[[keyframe]]\ntime = 1\ncamera.heading = 4\n"), "accepted");
  EXPECT_EQ(refusalOf("format = 1\n[sun]\nelevation = 3\n"), ":1:1: a file of keyframes has at least one [[keyframe]]");
  EXPECT_EQ(refusalOf("format = 1\n[[keyframe]]\ntime = 1\n[sun]\n"),
            ":4:2: 'sun' does not belong here: this file has [[keyframe]] alone");
  EXPECT_EQ(refusalOf("format = 1\n[[keyframe]]\ntime = 1\ncamera.heading = 400\n"),
            ":4:18: camera.heading is 400, outside -360 to 360 deg");
  std::filesystem::remove(path);
}

struct Refused {
  const char *text, *message;
};
class SkyFileErrors : public testing::TestWithParam<Refused> {};
TEST_P(SkyFileErrors, NameFileLineAndColumn) { EXPECT_EQ(refusal(GetParam().text), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    All, SkyFileErrors,
    testing::Values(
        Refused{"", "a.sky.toml:1:1: a sky file says 'format = 1' in its first lines"},
        Refused{"format = 2\n", "a.sky.toml:1:10: format must be 1, the only one that this version reads"},
        Refused{"format = \"1\"\n", "a.sky.toml:1:10: format must be 1, the only one that this version reads"},
        Refused{"format = 1\n[[layer]]\n  [layer.weather]\n    coverge = 0.5\n",
                "a.sky.toml:4:5: 'coverge' is not a parameter of layer.weather; did you mean 'coverage'?"},
        Refused{"format = 1\ntitel = \"x\"\n",
                "a.sky.toml:2:1: 'titel' is not a parameter of a sky; did you mean 'title'?"},
        Refused{"format = 1\n[layr]\n", "a.sky.toml:2:2: 'layr' is not a parameter of a sky; did you mean 'layer'?"},
        Refused{"format = 1\n[[layer]]\n[layer.wether]\n",
                "a.sky.toml:3:8: 'wether' is not a parameter of layer; did you mean 'weather'?"},
        Refused{"format = 1\nzzzzzzzzzzz = 1\n",
                "a.sky.toml:2:1: 'zzzzzzzzzzz' is not a parameter of a sky; `welkin fields` lists them"},
        Refused{"format = 1\n[sun]\nelevation = \"high\"\n", "a.sky.toml:3:13: sun.elevation must be a number"},
        Refused{"format = 1\n[sun]\nelevation = 2020-01-01\n", "a.sky.toml:3:13: sun.elevation must be a number"},
        Refused{"format = 1\nseed = 1.5\n", "a.sky.toml:2:8: seed must be a whole number"},
        Refused{"format = 1\ntitle = 3\n", "a.sky.toml:2:9: title must be a text in quotes"},
        Refused{"format = 1\n[quality]\njitter = 1\n", "a.sky.toml:3:10: quality.jitter must be true or false"},
        Refused{"format = 1\n[camera]\nposition = [1, 2]\n",
                "a.sky.toml:3:12: camera.position must be three numbers, [x, y, z]"},
        Refused{"format = 1\n[camera]\nposition = [1, 2, \"3\"]\n",
                "a.sky.toml:3:12: camera.position must be three numbers, [x, y, z]"},
        Refused{"format = 1\n[film]\ntone = \"agg\"\n",
                "a.sky.toml:3:8: film.tone is \"agg\", but must be one of \"agx\", \"aces\", \"filmic\", \"none\""},
        Refused{"format = 1\n[quality]\ninterleave = 3\n",
                "a.sky.toml:3:14: quality.interleave is 3, but must be one of 1, 2, 4"},
        Refused{"format = 1\n[[layer]]\n[layer.weather]\ncoverage = 1.5\n",
                "a.sky.toml:4:12: layer.weather.coverage is 1.5, outside 0 to 1"},
        Refused{"format = 1\ntime = nan\n", "a.sky.toml:2:8: time is not a finite number"},
        Refused{"format = 1\ntime = inf\n", "a.sky.toml:2:8: time is not a finite number"},
        Refused{"format = 1\nseed = 9223372036854775807\n",
                "a.sky.toml:2:8: seed is 9.22337e+18, outside 0 to 2.14748e+09"},
        Refused{"format = 1\n[[layer]]\n[layer.weather]\nmap = \"no.png\"\n",
                "a.sky.toml:4:7: layer.weather.map names the file 'no.png', which does not exist"},
        Refused{"format = 1\n[[grid]]\nfile = \"no.vdb\"\n",
                "a.sky.toml:3:8: grid.file names the file 'no.vdb', which does not exist"},
        Refused{"format = 1\n[[grid]]\nvalues = \"lwc\"\n",
                "a.sky.toml:3:10: grid.values is \"lwc\", but must be one of \"file\", \"normalized\", \"extinction\", "
                "\"water\""},
        Refused{"format = 1\n[sun]\ndate = \"2026-02-30\"\n",
                "a.sky.toml:3:8: sun.date is \"2026-02-30\", but that month has days 1 to 28"},
        Refused{"format = 1\n[layer]\nbase = 1\n", "a.sky.toml:2:1: 'layer' is a list of tables; write [[layer]]"},
        Refused{"format = 1\nlayer = [1]\n", "a.sky.toml:2:9: 'layer' is a list of tables; write [[layer]]"},
        Refused{"format = 1\nsun = 3\n", "a.sky.toml:2:7: 'sun' is a table; write [sun]"},
        Refused{"format = 1\n[[sun]]\n", "a.sky.toml:2:1: 'sun' is a table; write [sun]"},
        Refused{"format = 1\n[[sheet]]\n[[sheet]]\n[[sheet]]\n[[sheet]]\n[[sheet]]\n",
                "a.sky.toml:6:1: a sky has at most 4 [[sheet]]"},
        Refused{"format = 1\n[[keyframe]]\nsun.elevation = 3\n",
                "a.sky.toml:2:1: a keyframe says when it is: time = 10"},
        Refused{"format = 1\n[[keyframe]]\ntime = -1\n", "a.sky.toml:3:8: keyframe.time is -1, outside 0 to 1e+07 s"},
        Refused{"format = 1\n[[keyframe]]\ntime = nan\n", "a.sky.toml:3:8: keyframe.time is nan, outside 0 to 1e+07 s"},
        Refused{"format = 1\n[[keyframe]]\ntime = \"1\"\n", "a.sky.toml:3:8: keyframe.time must be a number"},
        Refused{"format = 1\n[[keyframe]]\ntime = 1\ninterpolation = \"spline\"\n",
                "a.sky.toml:4:17: keyframe.interpolation must be one of \"linear\", \"smooth\", \"step\""},
        Refused{"format = 1\n[[keyframe]]\ntime = 1\nsun.elevatoin = 4\n",
                "a.sky.toml:4:5: 'sun.elevatoin' is not a parameter; did you mean 'sun.elevation'?"},
        Refused{"format = 1\n[[keyframe]]\ntime = 1\n[keyframe.sun]\nelevation = 400\n",
                "a.sky.toml:5:13: sun.elevation is 400, outside -90 to 90 deg"},
        Refused{"format = 1\n[[keyframe]]\ntime = 1\nlayer.1.base = 400\n",
                "a.sky.toml:4:9: the sky has 1 [[layer]]; they are counted from 0"},
        Refused{
            "format = 1\n[[keyframe]]\ntime = 1\nsun.time = \"25:00\"\n",
            "a.sky.toml:4:12: sun.time is \"25:00\", but a day has hours 0 to 24, minutes 0 to 59 and seconds below "
            "60"},
        Refused{"format = 1\n[[keyframe]]\ntime = 1\nlayer.base = 4\nlayer.0.base = 5\n",
                "a.sky.toml:2:1: layer.0.base has two values at 1 s"},
        Refused{"format = 1\nkeyframe = 1\n", "a.sky.toml:2:12: 'keyframe' is a list of tables; write [[keyframe]]"},
        // Of two mistakes, the one that comes first in the file.
        Refused{"format = 1\n[[classical]]\n[classical.automaton]\nwidth = 100\n",
                "a.sky.toml:4:9: classical.automaton.width is 100, but must be one of 64, 128, 192, 256, 320, 384, "
                "448, 512"},
        Refused{"format = 1\n[[classical]]\nkind = \"metabals\"\n",
                "a.sky.toml:3:8: classical.kind is \"metabals\", but must be one of \"height_map\", \"perlin\", "
                "\"metaballs\", "
                "\"ellipsoids\", \"particles\", \"automaton\""},
        Refused{"format = 1\n[sun]\nelevation = 200\n[camera]\nfov = 0\n",
                "a.sky.toml:3:13: sun.elevation is 200, outside -90 to 90 deg"}));

// The parser's own words may change; the position may not.
TEST(SkyFile, SyntaxErrorsHaveAPosition) {
  EXPECT_EQ(refusal("format = 1\nseed = 3\nseed = 4\n").rfind("a.sky.toml:3:", 0), 0u);
  EXPECT_EQ(refusal("format = 1\n[sun\n").rfind("a.sky.toml:2:", 0), 0u);
  EXPECT_EQ(refusal("format = 1\nseed = 99999999999999999999\n").rfind("a.sky.toml:2:", 0), 0u);
  EXPECT_EQ(refusal("format = 1\ntitle = \"\xff\"\n").rfind("a.sky.toml:2:", 0), 0u);
}

TEST(SkyFile, RefusesHugeAndDeepFiles) {
  EXPECT_EQ(refusal("format = 1\n#" + std::string(1 << 20, 'x')), "a.sky.toml:1:1: a sky file is at most 1 MiB long");
  std::string key = "a";
  for (int i = 0; i < 100000; ++i) key += ".a";
  EXPECT_EQ(refusal("format = 1\n" + key + " = 1\n"), "a.sky.toml:2:66: this key has too many parts");
  EXPECT_EQ(refusal("format = 1\n[" + key + "]\n"), "a.sky.toml:2:67: this key has too many parts");
  std::string quoted = "\"=\"";
  for (int i = 0; i < 100000; ++i) quoted += ".\"=\"";
  EXPECT_NE(refusal("format = 1\n" + quoted + " = 1\n").find("too many parts"), std::string::npos);
  EXPECT_EQ(refusal("format = 1\nx = " + std::string(100000, '[')).rfind("a.sky.toml:2:", 0), 0u);
  EXPECT_EQ(refusal("format = 1\ntitle = \"" + std::string(100, '.') + "\"\n"), "accepted");
}

TEST(SkyFile, FindsPicturesBesideTheFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "welkin_sky_file";
  std::filesystem::create_directories(folder);
  const std::uint8_t grey[] = {128};
  savePng((folder / "map.png").string(), 1, 1, 1, grey);
  writeFileAtomically((folder / "b.sky.toml").string(), "format = 1\n[[layer]]\n[layer.weather]\nmap = \"map.png\"\n");
  EXPECT_EQ(loadSky((folder / "b.sky.toml").string()).layers[0].weather.map, (folder / "map.png").string());
  // And saved from where they are, wherever to.
  std::filesystem::create_directories(folder / "skies");
  Scene scene = loadSky((folder / "b.sky.toml").string());
  scene.keyframes = {{.time = 1.0, .values = {{"layer.0.weather.map", (folder / "map.png").string()}}}};
  const std::string saved = (folder / "skies" / "c.sky.toml").string();
  saveSky(scene, saved);
  EXPECT_NE(readFile(saved, 1 << 20).find("map = \"../map.png\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::equivalent(loadSky(saved).layers[0].weather.map, folder / "map.png"));
  EXPECT_TRUE(std::filesystem::equivalent(std::get<std::string>(loadSky(saved).keyframes[0].values[0].value),
                                          folder / "map.png"));
  std::filesystem::remove_all(folder);
}

TEST(SkyFile, TheExampleOfTheDocsIsRight) {
  const std::string page = readFile(WELKIN_SOURCE_DIR "/docs/sky_file.md", 1 << 20);
  const std::size_t begin = page.find("```toml\n") + 8;
  std::string text = page.substr(begin, page.find("```", begin) - begin);
  for (const char* line : {"  map = ", "file = "}) {  // its picture and its volume are not in the docs
    const std::size_t at = text.find(line);
    ASSERT_NE(at, std::string::npos);
    text.erase(at, text.find('\n', at) - at);
  }
  const Scene scene = parseSky(text, "docs");
  EXPECT_EQ(scene.quality.interleave, 4);
  EXPECT_EQ(scene.layers.at(0).profile.erosion, 0.9f);
  EXPECT_EQ(scene.sheets.size(), 1u);
  EXPECT_EQ(scene.grids.size(), 1u);
  ASSERT_EQ(scene.classical.size(), 1u);
  EXPECT_EQ(scene.classical[0].metaballs.count, 20);
  ASSERT_EQ(scene.heroes.size(), 1u);
  EXPECT_EQ(scene.heroes[0].surface.edge, 20.0f);
}

TEST(SkyFile, AMissingFileIsBadInput) {
  try {
    loadSky("no/such.sky.toml");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::badInput);
    EXPECT_STREQ(e.what(), "no/such.sky.toml: cannot be read: No such file or directory");
  }
}

}  // namespace
}  // namespace welkin
