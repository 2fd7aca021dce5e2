// Films are read back by ffprobe and ffmpeg themselves.
#include "welkin/io/video.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "welkin/base/error.hpp"
#include "welkin/base/image.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/process.hpp"

namespace welkin {
namespace {

namespace fs = std::filesystem;
constexpr int kWidth = 64, kHeight = 48, kFrames = 5;

// Four saturated quarters, and a bar that moves: wrong matrices and ranges show in them.
std::vector<std::uint16_t> picture(int frame) {
  constexpr std::uint16_t kColours[4][3] = {
      {52000, 9000, 9000}, {9000, 52000, 9000}, {9000, 9000, 52000}, {60000, 60000, 60000}};
  std::vector<std::uint16_t> samples;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool bar = y >= 40 && x / 8 == frame;
      for (int k = 0; k < 3; ++k)
        samples.push_back(bar ? 20000 : kColours[(x >= kWidth / 2) + 2 * (y >= kHeight / 2)][k]);
    }
  return samples;
}

class Video : public testing::Test {
 protected:
  void SetUp() override {
    if (findProgram("ffprobe").empty()) GTEST_SKIP() << "ffmpeg is not installed";
    fs::create_directories(folder / "100% odd: frames");  // a name that ffmpeg must not read as a pattern
    for (int i = 0; i < kFrames; ++i)
      savePng16((folder / "100% odd: frames" / frameName(i)).string(), kWidth, kHeight, 3, picture(i));
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  VideoFrames frames() const { return {path("100% odd: frames"), kFrames, 12.5}; }

  nlohmann::json probe(const std::string& file) const {
    std::string text;
    const std::vector<std::string> command{
        findProgram("ffprobe"), "-v", "error", "-of", "json", "-show_streams", "-count_frames", "file:" + file};
    const ProcessEnd end = runProcess(command, [&](std::string_view line) { text += line; }, {});
    EXPECT_EQ(end.code, 0) << end.errors;
    return nlohmann::json::parse(text)["streams"][0];
  }
  // The frame with this number as a display would show it by the film's own tags.
  Image shown(const std::string& file, int number) const {
    const std::string out = path("shown.png");
    const std::vector<std::string> command{findProgram("ffmpeg"),
                                           "-v",
                                           "error",
                                           "-y",
                                           "-i",
                                           "file:" + file,
                                           "-vf",
                                           "select=eq(n\\," + std::to_string(number) + "),format=rgb24",
                                           "-frames:v",
                                           "1",
                                           "-update",
                                           "1",
                                           out};
    const ProcessEnd end = runProcess(command, {}, {});
    EXPECT_EQ(end.code, 0) << end.errors;
    return loadPng(out);
  }
  // Away from edges, where 4:2:0 smears: the largest difference of the quarters' middles.
  void expectColours(const std::string& file, double most) const {
    const Image truth = loadPng(path("100% odd: frames/" + frameName(2))), seen = shown(file, 2);
    requireSameShape(truth, seen);
    for (const auto& [x, y] :
         {std::pair(12, 12), std::pair(48, 12), std::pair(12, 34), std::pair(48, 34), std::pair(20, 44)})
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(truth.at(x, y)[k], seen.at(x, y)[k], most) << x << "," << y << " " << k;
  }
  const fs::path folder = fs::temp_directory_path() / ("welkin_video_" + std::to_string(getpid()));
};

void expectTags(const nlohmann::json& stream) {
  EXPECT_EQ(stream.value("color_range", ""), "tv");
  EXPECT_EQ(stream.value("color_space", ""), "bt709");
  EXPECT_EQ(stream.value("color_transfer", ""), "bt709");
  EXPECT_EQ(stream.value("color_primaries", ""), "bt709");
  EXPECT_EQ(stream.value("width", 0), kWidth);
  EXPECT_EQ(stream.value("height", 0), kHeight);
  EXPECT_EQ(stream.value("r_frame_rate", ""), "25/2");
  EXPECT_EQ(stream.value("nb_read_frames", ""), std::to_string(kFrames));
}

TEST_F(Video, H264HasItsTagsAndColours) {
  double last = 0.0;
  encodeVideo(frames(), VideoFormat::h264, path("a.mp4"), [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    return true;
  });
  const nlohmann::json stream = probe(path("a.mp4"));
  EXPECT_EQ(stream.value("codec_name", ""), "h264");
  EXPECT_EQ(stream.value("pix_fmt", ""), "yuv420p");
  expectTags(stream);
  expectColours(path("a.mp4"), 0.03);
  // The same frames, the same bytes.
  encodeVideo(frames(), VideoFormat::h264, path("b.mp4"), {});
  EXPECT_EQ(readFile(path("a.mp4"), 1 << 24), readFile(path("b.mp4"), 1 << 24));
  EXPECT_FALSE(fs::exists(path("100% odd: frames/film.part")));
}

TEST_F(Video, ProResHasTenBits) {
  encodeVideo(frames(), VideoFormat::prores, path("a.mov"), {});
  const nlohmann::json stream = probe(path("a.mov"));
  EXPECT_EQ(stream.value("codec_name", ""), "prores");
  EXPECT_EQ(stream.value("pix_fmt", ""), "yuv422p10le");
  expectTags(stream);
  expectColours(path("a.mov"), 0.02);
}

TEST_F(Video, AGifHasThePicturesColours) {
  encodeVideo(frames(), VideoFormat::gif, path("a.gif"), {});
  const nlohmann::json stream = probe(path("a.gif"));
  EXPECT_EQ(stream.value("codec_name", ""), "gif");
  EXPECT_EQ(stream.value("nb_read_frames", ""), std::to_string(kFrames));
  expectColours(path("a.gif"), 0.02);
  EXPECT_FALSE(fs::exists(path("100% odd: frames/palette.png")));
}

TEST_F(Video, AFailureLeavesTheOldFile) {
  writeFileAtomically(path("a.mp4"), "old");
  fs::remove(path("100% odd: frames/" + frameName(3)));
  try {
    encodeVideo(frames(), VideoFormat::h264, path("a.mp4"), {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::failed);
    EXPECT_NE(std::string(e.what()).find("ffmpeg could read 3 of 5 frames"), std::string::npos) << e.what();
  }
  EXPECT_EQ(readFile(path("a.mp4"), 100), "old");
}

TEST_F(Video, SaysWhatFfmpegSays) {
  VideoFrames none = frames();
  none.folder = path("nothing");
  fs::create_directories(none.folder);
  try {
    encodeVideo(none, VideoFormat::gif, path("a.gif"), {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("could not make the film (exit code 1): "), std::string::npos) << e.what();
  }
}

TEST_F(Video, CanBeCancelled) {
  EXPECT_THROW(encodeVideo(frames(), VideoFormat::h264, path("a.mp4"), [](double) { return false; }), Cancelled);
  EXPECT_FALSE(fs::exists(path("a.mp4")));
}

TEST(Process, LinesCodesAndErrors) {
  std::vector<std::string> lines;
  const std::vector<std::string> command{findProgram("sh"), "-c", "echo one; echo two >&2; echo three; exit 7"};
  const ProcessEnd end = runProcess(command, [&](std::string_view line) { lines.emplace_back(line); }, {});
  EXPECT_EQ(end.code, 7);
  EXPECT_EQ(end.errors, "two\n");
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "three"}));
  const std::vector<std::string> killed{findProgram("sh"), "-c", "kill -9 $$"};
  EXPECT_EQ(runProcess(killed, {}, {}).code, 137);
  const std::vector<std::string> none{"/no/such/program"};
  EXPECT_EQ(runProcess(none, {}, {}).code, 127);
  EXPECT_EQ(findProgram("no such program"), "");
}

}  // namespace
}  // namespace welkin
