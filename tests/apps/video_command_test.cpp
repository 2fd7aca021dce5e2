// `welkin video`: formats, paths, keyframes, going on after a kill, Ctrl-C, refusals.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/apps/command.hpp"
#include "welkin/base/image.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class VideoCommand : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  // A clear sky of a gradient: quick, and its keyframes show.
  std::string sky(const std::string& more = "") const {
    const std::string file = path("clear.sky.toml");
    std::ofstream(file) << "format = 1\nlayer = []\n[quality]\npreset = \"low\"\n" << more;
    return file;
  }
  test::Outcome video(const std::string& output, const std::string& options, const std::string& before = "") const {
    return test::run("video " + path("clear.sky.toml") + " -q --size 32x18 -o " + path(output) + " " + options, before);
  }
  Image frame(const std::string& name, int number) const {
    char file[64];
    std::snprintf(file, sizeof file, "/frame_%06d.png", number);
    return loadPng(path(name) + file);
  }
  const fs::path folder = fs::temp_directory_path() / ("welkin_video_command_" + std::to_string(getpid()));
};

constexpr const char* kSunset =
    "[[keyframe]]\ntime = 0\nsun.elevation = 30\n[[keyframe]]\ntime = 2\ninterpolation = \"step\"\n"
    "sun.elevation = 2\n";

TEST_F(VideoCommand, MakesAFilmAndLeavesNothingElse) {
  sky();
  ASSERT_EQ(video("a.mp4", "--seconds 0.2").code, 0);
  EXPECT_GT(fs::file_size(path("a.mp4")), 500u);
  EXPECT_EQ(test::listing(folder), "a.mp4 clear.sky.toml ");
}

// `render --time` shows the frame of the film at that time; the film ends with its last keyframe.
TEST_F(VideoCommand, RenderShowsTheSameSkyAtATime) {
  // An automatic exposure would be smoothed over the film's frames, and history remember the sun of before.
  sky("[film]\nexposure = \"manual\"\nev = 13\n" + std::string(kSunset));
  const test::Outcome o = video("a.gif", "--quality ultra --fps 2 --frames " + path("f"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(test::listing(path("f")), "film.txt frame_000000.png frame_000001.png frame_000002.png frame_000003.png ");
  const auto render = [&](const std::string& options) {
    EXPECT_EQ(test::run("render " + path("clear.sky.toml") + " -q --quality ultra --size 32x18 -o " + path("r.png") +
                        " " + options)
                  .code,
              0);
    return loadPng(path("r.png"));
  };
  EXPECT_GT(psnr(render("--time 1.5"), frame("f", 3)), 35.0);
  EXPECT_LT(psnr(render("--time 0"), frame("f", 3)), 30.0);
  EXPECT_GT(psnr(render("--time 0"), frame("f", 0)), 35.0);
  // What the command line sets has no keyframes.
  EXPECT_GT(psnr(render("--time 1.5 --set sun.elevation=30"), frame("f", 0)), 35.0);
}

TEST_F(VideoCommand, GoesOnAfterAKill) {
  sky(kSunset);
  const std::string options = "--fps 40 --seconds 2 --set film.exposure=automatic";  // two stretches
  const std::string frames = path("cut.mp4") + ".frames";
  // Killed when the film has a frame of the second stretch, or at the latest after three minutes.
  const std::string line = std::string("sh -c '\"") + WELKIN_BINARY_DIR + "/bin/welkin\" video " +
                           path("clear.sky.toml") + " -q --size 32x18 -o " + path("cut.mp4") + " " + options +
                           " & p=$!; ( i=0; while [ ! -e " + frames + "/frame_000055.png ] && [ $i -lt 3600 ]; do " +
                           "sleep 0.05; i=$((i+1)); done; kill -9 $p ) & wait $p' >/dev/null 2>&1";
  [[maybe_unused]] const int ignored = std::system(line.c_str());
  ASSERT_TRUE(fs::exists(frames + "/frame_000055.png"));
  ASSERT_FALSE(fs::exists(path("cut.mp4")));
  const auto kept = fs::last_write_time(frames + "/frame_000010.png");
  // A frame that is lost from the middle of a stretch is drawn again.
  fs::remove(frames + "/frame_000030.png");
  const test::Outcome seen = video("cut.mp4", options + " --frames " + frames);
  ASSERT_EQ(seen.code, 0) << seen.err;
  EXPECT_EQ(fs::last_write_time(frames + "/frame_000010.png"), kept);
  ASSERT_EQ(video("whole.mp4", options).code, 0);
  EXPECT_TRUE(test::slurp(path("cut.mp4")) == test::slurp(path("whole.mp4")));
}

TEST_F(VideoCommand, InterruptedItKeepsItsFrames) {
  sky();
  // In the foreground: otherwise the signal goes to the process and then to its group, and a second Ctrl-C ends it at
  // once.
  const test::Outcome o = video("a.mp4", "--seconds 400", "timeout --foreground --signal=INT --preserve-status 6");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.err.find("interrupted; "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("the same command goes on from there"), std::string::npos) << o.err;
  EXPECT_EQ(test::listing(folder), "a.mp4.frames clear.sky.toml ");
  // Another film does not take them for its own.
  const test::Outcome other = video("a.mp4", "--seconds 400 --set sun.elevation=5");
  EXPECT_EQ(other.code, 3);
  EXPECT_NE(other.err.find("holds frames of another film"), std::string::npos) << other.err;
}

TEST_F(VideoCommand, TracesEveryFrameWithNoiseOfItsOwn) {
  sky();
  const std::string options = "--renderer path --samples 2 --air tables --seconds 0.08 --frames ";
  ASSERT_EQ(video("a.gif", options + path("a")).code, 0);
  ASSERT_EQ(video("b.gif", options + path("b")).code, 0);
  EXPECT_EQ(test::slurp(path("a.gif")), test::slurp(path("b.gif")));
  EXPECT_TRUE(fs::exists(path("a") + "/frame_000001.png"));
}

TEST_F(VideoCommand, PathsMoveTheCamera) {
  sky("[camera]\npitch = 0\nposition = [0, 0, 500]\n[sun]\nelevation = 10\nazimuth = 0\n");
  std::ofstream(path("camera.toml")) << "format = 1\n[[keyframe]]\ntime = 0\ncamera.heading = 0\n[[keyframe]]\n"
                                        "time = 1\ncamera.heading = 180\n";
  // The sun stands in the north: turned away from it, the picture darkens.
  const auto brightness = [&](int number) {
    double sum = 0.0;
    for (const float v : frame("f", number).pixels) sum += v;
    return sum;
  };
  const std::string paths[] = {"--path turntable --seconds 1 --fps 4",
                               "--seconds 2 --fps 2 --path " + path("camera.toml")};
  for (const std::string& options : paths) {
    ASSERT_EQ(video("a.gif", options + " --frames " + path("f")).code, 0) << options;
    EXPECT_LT(brightness(2), 0.9 * brightness(0)) << options;
    fs::remove_all(path("f"));
  }
  // Six hours on, the sun has set.
  ASSERT_EQ(video("a.gif", "--path timelapse --seconds 1 --fps 2 --time-scale 43200 --frames " + path("f")).code, 0);
  EXPECT_NE(brightness(0), brightness(1));
  fs::remove_all(path("f"));
  ASSERT_EQ(
      video("a.gif", "--path flight --airspeed 10000 --seconds 2 --fps 1 --set camera.pitch=60 --frames " + path("f"))
          .code,
      0);
  EXPECT_LT(brightness(1), brightness(0));  // less air above
}

TEST_F(VideoCommand, RefusesWhatMakesNoFilm) {
  sky();
  const auto refusal = [&](const std::string& output, const std::string& options) {
    const test::Outcome o = video(output, options);
    EXPECT_EQ(o.code, 2) << o.err;
    return o.err;
  };
  EXPECT_NE(refusal("a.avi", "").find("ends in .mp4, .mov or .gif"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--preset prores").find("another ending"), std::string::npos);
  const test::Outcome odd = test::run("video --size 33x18 -o " + path("a.mp4"));
  EXPECT_EQ(odd.code, 2);
  EXPECT_NE(odd.err.find("even sizes"), std::string::npos) << odd.err;
  EXPECT_NE(refusal("a.mp4", "--path no_such").find("neither turntable"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--airspeed 10").find("--path flight"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--orbit 10 --path flight").find("--path turntable"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--samples 4").find("--renderer path"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--draws 4 --renderer path").find("--draws"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--seconds 1e6 --fps 100").find("1000000 frames"), std::string::npos);
  EXPECT_NE(refusal("a.mp4", "--time 9999999").find("the film would end"), std::string::npos);
  std::ofstream(path("bad.toml")) << "format = 1\n[[keyframe]]\ntime = 0\ncamera.headin = 0\n";
  const test::Outcome bad = video("a.mp4", "--path " + path("bad.toml"));
  EXPECT_EQ(bad.code, 3);
  EXPECT_NE(bad.err.find("bad.toml:4:8: 'camera.headin' is not a parameter; did you mean 'camera.heading'?"),
            std::string::npos)
      << bad.err;
  const test::Outcome none = video("a.mp4", "", "PATH=/no/such");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("ffmpeg: was not found in PATH"), std::string::npos) << none.err;
  EXPECT_EQ(test::listing(folder), "bad.toml clear.sky.toml ");
}

}  // namespace
}  // namespace welkin
