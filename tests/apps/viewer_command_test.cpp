// Whole sessions of `welkin view`: scripts of input, without a display and under Xvfb.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/apps/command.hpp"
#include "welkin/base/image.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::slurp;

class ViewCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::hasViewer()) GTEST_SKIP() << "built without SDL2 or Dear ImGui";
    folder_ = std::filesystem::temp_directory_path() / ("welkin_view_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Outcome play(const std::string& script, const std::string& options = "", const std::string& before = "") const {
    std::ofstream(path("script.txt")) << script;
    return test::run("view --script " + path("script.txt") +
                         " --size 640x360 --set quality.preset=low --set quality.interleave=2 " +
                         (before.empty() ? "--headless " : "") + options,
                     before);
  }

  std::filesystem::path folder_;
};

TEST_F(ViewCommand, NothingIsDoneWithoutAScript) {
  const Outcome outcome = test::run("view --headless");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--script"), std::string::npos);
  EXPECT_EQ(test::run("view --screenshot a.png").code, 2);
  EXPECT_EQ(test::run("view --size 0x0").code, 2);
}

TEST_F(ViewCommand, AWrongScriptIsRefusedWithItsLine) {
  const Outcome outcome = play("frames 1\nclick @nothing_of_the_kind\n");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("script.txt:2: nothing on the screen is called 'nothing_of_the_kind'"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(test::run("view --headless --script /nowhere/a.txt").code, 3);
}

// Open, change, undo, do again, save, open again: the same picture.
TEST_F(ViewCommand, ASessionEndsWithTheSamePicture) {
  const Outcome outcome = play(
      "frames 2\n"
      "key f9\nsettle\npicture " +
      path("before.png") +
      "\nkey f9\n"
      "key slash\ntype weather.coverage\nframes 2\n"
      "drag @layer.0.weather.coverage:0.42 @layer.0.weather.coverage:0.8\nframes 2\n"
      "key escape\nkey escape\nkey f9\nsettle\npicture " +
      path("changed.png") +
      "\n"
      "do undo\nsettle\npicture " +
      path("undone.png") +
      "\n"
      "do redo\ndo save_as " +
      path("saved.sky.toml") +
      "\n"
      "do undo\nsettle\ndrop " +
      path("saved.sky.toml") + "\nsettle\npicture " + path("opened.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GT(loadSky(path("saved.sky.toml")).layers[0].weather.coverage, 0.6f);
  const Image before = loadPng(path("before.png")), changed = loadPng(path("changed.png"));
  EXPECT_GT(psnr(before, loadPng(path("undone.png"))), 34.0);
  EXPECT_GT(psnr(changed, loadPng(path("opened.png"))), 34.0);
  EXPECT_LT(psnr(before, changed), 28.0);
}

// Weather is painted, undone, done again, saved and opened again: the same sky.
TEST_F(ViewCommand, PaintedWeatherIsSavedBesideTheSky) {
  const std::string settled = "key f9\nsettle\npicture ";
  const Outcome outcome = play("frames 2\n" + settled + path("before.png") +
                               "\nkey f9\ndo weather\nframes 2\n"
                               "click @brush_erase\ndrag @brush_radius:0.3 @brush_radius:0.9\n"
                               "drag @brush_strength:0.5 @brush_strength:0.99\n"
                               "drag @weather_map:0.5:0.3 @weather_map:0.5:0.5\nframes 2\n" +
                               settled + path("painted.png") + "\ndo undo\nsettle\npicture " + path("undone.png") +
                               "\ndo redo\ndo save_as " + path("saved.sky.toml") + "\ndo undo\ndo open " +
                               path("saved.sky.toml") + "\nsettle\npicture " + path("opened.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image before = loadPng(path("before.png")), painted = loadPng(path("painted.png"));
  EXPECT_LT(psnr(before, painted), 28.0);
  EXPECT_GT(psnr(before, loadPng(path("undone.png"))), 34.0);
  EXPECT_GT(psnr(painted, loadPng(path("opened.png"))), 34.0);
  EXPECT_EQ(test::listing(folder_),
            "before.png opened.png painted.png saved.sky.toml saved.weather0.png script.txt undone.png ");
  EXPECT_NE(slurp(path("saved.sky.toml")).find("map = \"saved.weather0.png\""), std::string::npos);
  const Image map = loadPng(path("saved.weather0.png"));
  EXPECT_EQ(map.channels, 4);
  EXPECT_EQ(*std::min_element(map.pixels.begin(), map.pixels.end()), 0.0f);
}

TEST_F(ViewCommand, TheSameScriptDrawsTheSamePicture) {
  const std::string script = "frames 2\nhold w 5\ndrag 450,150 480,170\nframes 4\nscreenshot ";
  ASSERT_EQ(play(script + path("a.png")).code, 0);
  ASSERT_EQ(play(script + path("b.png")).code, 0);
  EXPECT_EQ(slurp(path("a.png")), slurp(path("b.png")));
}

// With a rate to hold the first picture shows coarse light, and the picture at rest is the same as without.
TEST_F(ViewCommand, ARateToHoldDoesNotWaitForLight) {
  for (const std::string rate : {"0", "25"}) {
    const std::string script =
        "frames 1\npicture " + path("early" + rate + ".png") + "\nsettle\npicture " + path("rest" + rate + ".png");
    ASSERT_EQ(play(script, "--rate " + rate).code, 0);
  }
  EXPECT_NE(slurp(path("early0.png")), slurp(path("early25.png")));
  EXPECT_EQ(slurp(path("rest0.png")), slurp(path("rest25.png")));
  EXPECT_EQ(test::run("view --rate -1").code, 2);
}

TEST_F(ViewCommand, WrongFilesAndOddSizesDoNoHarm) {
  std::ofstream(path("wrong.sky.toml")) << "format = 1\n[sun]\nelevaton = 3\n";
  std::ofstream(path("binary.toml"), std::ios::binary) << std::string(1000, '\0');
  const Outcome outcome = play("frames 1\ndrop " + path("wrong.sky.toml") + "\nframes 2\ndrop " + path("binary.toml") +
                               "\nframes 2\ndrop /nowhere\nsize 1 1\nkey f2\nkey f4\nkey f5\nkey f6\nkey f7\nkey "
                               "f8\nkey f11\nsize 40 3000\nframes 2\nsize 640 360\n"
                               "frames 2\nscreenshot " +
                               path("a.png") + "\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(loadPng(path("a.png")).width, 640);
}

// Whatever hands do, and whatever they drop: no crash, and no error of OpenGL, which would end the command.
Outcome playRandomly(const std::filesystem::path& folder, int frames, int seed) {
  std::filesystem::create_directories(folder / "files" / "folder.toml");
  std::ofstream(folder / "files" / "fine.sky.toml") << "format = 1\n[sun]\nelevation = 12\n";
  std::ofstream(folder / "files" / "wrong.sky.toml") << "format = 1\n[sun]\nelevaton = 3\n";
  std::ofstream(folder / "files" / "empty.toml");
  std::ofstream(folder / "files" / "binary.tif", std::ios::binary) << "II*" << std::string(1000, '\0');
  std::ofstream(folder / "files" / "no_map.sky.toml") << "format = 1\n[[layer]]\n[layer.weather]\nmap = \"none.png\"\n";
  std::ofstream(folder / "random.txt") << "random " << frames << " " << seed << " files\nframes 3\nsize 320 180\n"
                                       << "frames 3\nscreenshot end.png\n";
  // What they save goes into the folder.
  return test::run("view --script random.txt --headless --size 640x360 --set quality.preset=low",
                   "cd " + folder.string() + " &&");
}

TEST_F(ViewCommand, AnythingMayBeDone) {
  const Outcome outcome = playRandomly(folder_, 60, 1);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(path("end.png")));
}

// Ten minutes of it on two cores.
class LongView : public ViewCommand {};
TEST_F(LongView, AnythingMayBeDone) {
  const Outcome outcome = playRandomly(folder_, 9000, 2);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

// From above over a map: the picture lies where it should, and clouds are before it.
TEST_F(ViewCommand, ShowsASkyOverAMap) {
  // 4 x 4 fields of 5 km, white but for the south-west one.
  std::vector<std::uint8_t> fields(4 * 4 * 3, 200);
  std::fill_n(fields.begin() + 3 * 12, 3, std::uint8_t{20});
  savePng(path("map.png"), 4, 4, 3, fields);
  const auto from = [&](const std::string& sky, const std::string& name) {
    const Outcome outcome = play("key f9\nsettle\npicture " + path(name) + "\n",
                                 "--map " + path("map.png") + " --map-corners -10000,-10000,10000,10000 " + sky);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return loadPng(path(name));
  };
  const Image clear = from("--set layer.weather.coverage=0", "clear.png"), cloudy = from("", "cloudy.png");
  // The map is as wide as the picture, 32 pixels a kilometre: the field's north edge stands in row 340.
  // Pixels of the map are blended, 160 of the picture's wide: the edge is soft.
  EXPECT_LT(clear.at(80, 350)[1] + 0.03f, clear.at(80, 330)[1]);
  EXPECT_LT(clear.at(80, 350)[1] + 0.1f, clear.at(240, 350)[1]);
  EXPECT_LT(psnr(clear, cloudy), 25.0);
  EXPECT_EQ(test::run("view --headless --script none.txt --map " + path("map.png")).code, 2);  // where is it?
  EXPECT_EQ(test::run("view --headless --script none.txt --map-corners 0,0,1,1").code, 2);
  EXPECT_EQ(test::run("view --headless --script none.txt --map a.tif --map-corners 5,0,1,1").code, 2);
}

TEST_F(ViewCommand, KeyframesPlay) {
  std::ofstream(path("day.sky.toml")) << "format = 1\n[[keyframe]]\ntime = 0\nsun.elevation = 45\ncamera.heading = 0\n"
                                         "[[keyframe]]\ntime = 2\nsun.elevation = 2\ncamera.heading = 90\n";
  const Outcome outcome = play("frames 1\nkey f9\nsettle\npicture " + path("noon.png") +
                                   "\ndo play\nframes 90\ndo play\nsettle\npicture " + path("evening.png") + "\n",
                               path("day.sky.toml"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(psnr(loadPng(path("noon.png")), loadPng(path("evening.png"))), 20.0);
}

TEST_F(ViewCommand, ShowsDensityNoiseAndSamples) {
  const Outcome outcome = play("do inspect\nsettle\nframes 2\nscreenshot " + path("inspect.png") +
                               "\ndo pace\nframes 2\nclick @count_samples\n"
                               "frames 2\nclick @show_samples\nkey f9\nsettle\nscreenshot " +
                               path("samples.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // Counts are shown in false colours: where the march finds clouds it takes more samples than elsewhere.
  const Image samples = loadPng(path("samples.png"));
  std::set<std::array<float, 3>> colours;
  for (int y = 0; y < samples.height; y += 4)
    for (int x = 0; x < samples.width; x += 4)
      colours.insert({samples.at(x, y)[0], samples.at(x, y)[1], samples.at(x, y)[2]});
  EXPECT_GT(colours.size(), 12u);
  // The cut has both cloud and none.
  const Image inspect = loadPng(path("inspect.png"));
  int white = 0, dark = 0;
  for (int y = 60; y < 330; ++y)
    for (int x = 0; x < 200; ++x) {
      white += inspect.at(x, y)[0] > 0.8f;
      dark += inspect.at(x, y)[0] < 0.15f;
    }
  EXPECT_GT(white, 50);
  EXPECT_GT(dark, 500);
}

// The real window, where there is a display server to be had.
TEST_F(ViewCommand, OpensAWindowUnderXvfb) {
  if (std::system("command -v xvfb-run >/dev/null && command -v xauth >/dev/null") != 0) GTEST_SKIP() << "no xvfb-run";
  const Outcome outcome = play("frames 3\nkey f4\nframes 2\nscreenshot " + path("window.png") + "\n", "",
                               "xvfb-run -a -s '-screen 0 800x600x24'");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image window = loadPng(path("window.png"));
  EXPECT_EQ(window.width, 640);
  EXPECT_EQ(window.height, 360);
  // The panel is dark, the sky is not.
  EXPECT_GT(*std::max_element(window.pixels.begin(), window.pixels.end()), 0.6f);
}

}  // namespace
}  // namespace welkin
