// Whole sessions of `welkin view`: scripts of input, without a display and under Xvfb.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/command.hpp"
#include "welkin/base/image.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::slurp;

const bool kHasViewer = test::run("view --headless").err.find("built without a window") == std::string::npos;

class ViewCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!kHasViewer) GTEST_SKIP() << "built without SDL2 or Dear ImGui";
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

TEST_F(ViewCommand, TheSameScriptDrawsTheSamePicture) {
  const std::string script = "frames 2\nhold w 5\ndrag 450,150 480,170\nframes 4\nscreenshot ";
  ASSERT_EQ(play(script + path("a.png")).code, 0);
  ASSERT_EQ(play(script + path("b.png")).code, 0);
  EXPECT_EQ(slurp(path("a.png")), slurp(path("b.png")));
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
