// `welkin render --renderer path`: same bytes, checkpoints that survive a kill, Ctrl-C, layers, refusals.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/apps/command.hpp"
#include "welkin/io/exr.hpp"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class TracedCommand : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  // A sky without clouds: nothing to bake, so that there is something to interrupt at once.
  std::string sky() const {
    const std::string file = path("clear.sky.toml");
    std::ofstream(file) << "format = 1\nlayer = []\n[camera]\nprojection = \"equirectangular\"\n";
    return file;
  }
  test::Outcome render(const std::string& output, const std::string& options, const std::string& before = "") const {
    return test::run("render " + sky() + " -q --renderer path -o " + path(output) + " " + options, before);
  }
  std::string checkpoint() const { return " --checkpoint-every 0 --checkpoint " + path("state"); }
  // Sends the signal to a picture under way when its first checkpoint stands. Its exit code; its messages are a file.
  int signalled(const std::string& signal, const std::string& output, const std::string& options) const {
    const std::string alive = "kill -0 $p 2>/dev/null", stands = "[ -s " + path("state") + " ]";
    const std::string line = std::string("sh -c '\"") + WELKIN_BINARY_DIR + "/bin/welkin\" render " + sky() +
                             " -q --renderer path -o " + path(output) + " " + options + " & p=$!; while " + alive +
                             " && ! " + stands + "; do sleep 0.05; done; kill -" + signal + " $p; wait $p' >" +
                             path("messages") + " 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  const fs::path folder = fs::temp_directory_path() / ("welkin_traced_" + std::to_string(getpid()));
};

TEST_F(TracedCommand, TwoRunsGiveTheSameBytesAndLayers) {
  for (const char* name : {"a.exr", "b.exr"}) ASSERT_EQ(render(name, "--size 48x24 --samples 8 --layers").code, 0);
  EXPECT_EQ(test::slurp(path("a.exr")), test::slurp(path("b.exr")));
  for (const char* layer : {"direct", "multiple", "transmittance", "depth", "samples", "variance"})
    EXPECT_EQ(loadExr(path(std::string("a.") + layer + ".exr")).width, 48) << layer;
  EXPECT_EQ(*loadExr(path("a.samples.exr")).at(5, 5), 8.0f);
}

TEST_F(TracedCommand, GoesOnAfterAKill) {
  const std::string options = "--size 192x96 --samples 40" + checkpoint();
  signalled("KILL", "cut.exr", options);
  ASSERT_TRUE(fs::exists(path("state")));
  ASSERT_FALSE(fs::exists(path("cut.exr")));
  ASSERT_EQ(render("cut.exr", options).code, 0);
  EXPECT_FALSE(fs::exists(path("state")));
  ASSERT_EQ(render("whole.exr", "--size 192x96 --samples 40").code, 0);
  EXPECT_EQ(test::slurp(path("cut.exr")), test::slurp(path("whole.exr")));
}

TEST_F(TracedCommand, InterruptedItWritesThePictureSoFar) {
  EXPECT_EQ(signalled("INT", "part.exr", "--size 512x256 --samples 1000000" + checkpoint()), 0);
  EXPECT_NE(test::slurp(path("messages")).find("interrupted"), std::string::npos) << test::slurp(path("messages"));
  const Image picture = loadExr(path("part.exr"));
  EXPECT_EQ(picture.width, 512);
  double sum = 0.0;
  for (const float v : picture.pixels) sum += v;
  EXPECT_GT(sum, 0.0);
}

TEST_F(TracedCommand, RefusesWhatIsNotACheckpointOfThisPicture) {
  std::ofstream(path("state")) << "something else";
  const test::Outcome foreign = render("a.exr", "--size 16x8 --samples 1 --checkpoint " + path("state"));
  EXPECT_EQ(foreign.code, 3);
  EXPECT_NE(foreign.err.find("checkpoint"), std::string::npos) << foreign.err;
  EXPECT_TRUE(fs::exists(path("state")));
  EXPECT_EQ(render("a.exr", "--noise 7").code, 2);
  EXPECT_EQ(render("a.exr", "--air thick").code, 2);
}

TEST_F(TracedCommand, RefusesOptionsOfTheOtherRenderer) {
  for (const char* options : {"--samples 4", "--layers", "--denoise", "--checkpoint x", "--scatterings 2"}) {
    const test::Outcome outcome = test::run("render " + sky() + " -q -o " + path("a.exr") + " " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_NE(outcome.err.find("--renderer path"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(render("a.exr", "--frames 4").code, 2);
  EXPECT_FALSE(fs::exists(path("a.exr")));
}

TEST_F(TracedCommand, AFullDiskLeavesTheOldFiles) {
  sky();
  for (const char* name : {"a.exr", "a.png"}) {
    std::ofstream(path(name)) << "old";
    const std::string before = test::listing(folder);
    const test::Outcome o = render(name, "--size 96x48 --samples 1", test::fullDisk(1));
    EXPECT_EQ(o.code, 1) << name;
    EXPECT_NE(o.err.find(path(name) + ": cannot be written"), std::string::npos) << o.err;
    EXPECT_EQ(test::slurp(path(name)), "old");
    EXPECT_EQ(test::listing(folder), before);
  }
}

// The checkpoint that stands stays good: with room on the disk the picture goes on from it.
TEST_F(TracedCommand, AFullDiskLeavesTheOldCheckpoint) {
  const std::string options = "--size 96x48 --samples 4 --checkpoint-every 0 --checkpoint " + path("state");
  const test::Outcome none = render("a.exr", options, test::fullDisk(16));
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find(path("state") + ": cannot be written: "), std::string::npos) << none.err;
  EXPECT_EQ(test::listing(folder), "clear.sky.toml ");

  // Interrupted at once it leaves a state behind.
  const std::string longer = "--size 96x48 --samples 100000 --checkpoint-every 0 --checkpoint " + path("state");
  ASSERT_EQ(render("a.exr", longer, "timeout --foreground --signal=INT --preserve-status 5").code, 0);
  const std::string old = test::slurp(path("state"));
  ASSERT_GT(old.size(), 8192u);
  EXPECT_EQ(render("b.exr", longer, test::fullDisk(16)).code, 1);
  EXPECT_TRUE(test::slurp(path("state")) == old);
  EXPECT_EQ(test::listing(folder), "a.exr clear.sky.toml state ");
}

}  // namespace
}  // namespace welkin
