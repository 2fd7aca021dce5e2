// Whole flights of `welkin fly`, by scripts and without a display.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/apps/command.hpp"
#include "welkin/base/image.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::slurp;

class FlyCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::hasViewer()) GTEST_SKIP() << "built without SDL2 or Dear ImGui";
    folder_ = std::filesystem::temp_directory_path() / ("welkin_fly_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Outcome play(const std::string& script, const std::string& options) const {
    std::ofstream(path("script.txt")) << script;
    return test::run("fly --headless --size 96x54 --set quality.preset=low --script " + path("script.txt") + " " +
                     options);
  }
  std::vector<std::string> framesIn(const std::string& name) const {
    std::vector<std::string> frames;
    for (const auto& entry : std::filesystem::directory_iterator(path(name))) frames.push_back(entry.path());
    std::sort(frames.begin(), frames.end());
    return frames;
  }

  std::filesystem::path folder_;
};

TEST_F(FlyCommand, WrongArgumentsAndStepsAreRefused) {
  EXPECT_EQ(test::run("fly --headless").code, 2);
  EXPECT_EQ(test::run("fly --out frames").code, 2);
  EXPECT_EQ(test::run("fly --start moon").code, 2);
  EXPECT_EQ(test::run("fly --every 0").code, 2);
  const Outcome step = play("fly 2\nfly 2 gear=1\n", "");
  EXPECT_EQ(step.code, 3);
  EXPECT_NE(step.err.find("script.txt:2: 'gear=1'"), std::string::npos) << step.err;
  EXPECT_EQ(play("fly 0\n", "").code, 3);
  std::ofstream(path("view.txt")) << "fly 2 throttle=1\n";
  const Outcome view = test::run("view --headless --script " + path("view.txt"));
  EXPECT_EQ(view.code, 3);
  EXPECT_NE(view.err.find("welkin fly"), std::string::npos) << view.err;
  // Nothing can be put where a file stands.
  std::ofstream(path("file")) << "x";
  EXPECT_NE(play("fly 1\n", "-o " + path("file/frames")).code, 0);
}

// Keys, controls, another view, other weather: the same input gives the same frames, and the recording of it flies the
// same flight.
TEST_F(FlyCommand, TheSameInputGivesTheSameFrames) {
  const std::string script = "fly 20 throttle=1\nhold down 30\nkey c\nfly 20 bank=0.5 pitch=0\nkey f\nframes 10\n";
  const std::string options = "--start inside --every 15 -o ";
  ASSERT_EQ(play(script, options + path("a") + " --record " + path("flown.txt")).code, 0);
  ASSERT_EQ(play(script, options + path("b")).code, 0);
  const std::vector<std::string> a = framesIn("a"), b = framesIn("b");
  ASSERT_GE(a.size(), 5u);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(slurp(a[i]), slurp(b[i])) << i;
  EXPECT_NE(slurp(a.front()), slurp(a.back()));
  EXPECT_EQ(loadPng(a.front()).width, 96);
  // The recording again, recorded.
  const std::string flown = slurp(path("flown.txt"));
  EXPECT_NE(flown.find("view=cockpit"), std::string::npos) << flown;
  ASSERT_EQ(play(flown, "--start inside --every 600 --record " + path("again.txt")).code, 0);
  EXPECT_EQ(slurp(path("again.txt")), flown);
}

// Under way the sky can be another one, and a pause lets the picture come to rest.
TEST_F(FlyCommand, WeatherChangesUnderWay) {
  const Outcome outcome = play("fly 3 throttle=0.6\nkey space\nsettle\npicture " + path("before.png") + "\ndo open " +
                                   (std::filesystem::path(WELKIN_SOURCE_DIR) / "presets/overcast.sky.toml").string() +
                                   "\nsettle\npicture " + path("after.png") + "\nkey space\nfly 3\n",
                               "fair_weather --start below --set quality.interleave=1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(psnr(loadPng(path("before.png")), loadPng(path("after.png"))), 30.0);
}

}  // namespace
}  // namespace welkin
