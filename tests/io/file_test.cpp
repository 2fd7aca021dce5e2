#include "welkin/io/file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "tests/io/small_disk.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/hdr.hpp"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Files() override {
    fs::permissions(folder, fs::perms::owner_all);
    fs::remove_all(folder);
  }
  std::string file(const std::string& name) const { return (folder / name).string(); }
  std::size_t count() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }

  fs::path folder = fs::path(testing::TempDir()) /
                    (std::string("welkin_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

// While it lives the superuser, who may write everywhere, is nobody.
class Nobody {
 public:
  Nobody() : root_(geteuid() == 0 && seteuid(65534) == 0) {}
  ~Nobody() {
    if (root_ && seteuid(0) != 0) std::abort();
  }
  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;

 private:
  bool root_;
};

std::string failure(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::failed);
    return e.what();
  }
  return "succeeded";
}

TEST_F(Files, ReplacesAFileAndLeavesNothingElse) {
  writeFileAtomically(file("a"), "one");
  writeFileAtomically(file("a"), "two");
  EXPECT_EQ(readFile(file("a"), 10), "two");
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, AFailingWriterLeavesTheOldFile) {
  writeFileAtomically(file("a"), "old");
  const auto stopHalfway = [](const std::string& temporary) {
    writeBytes(temporary, "half of the n");
    throw std::runtime_error("stop");
  };
  EXPECT_THROW(writeFileAtomically(file("a"), stopHalfway), std::runtime_error);
  EXPECT_EQ(readFile(file("a"), 10), "old");
  EXPECT_EQ(count(), 1u);
}

// Pixels that no compression makes small.
Image noise(int channels) {
  Image image(96, 97, channels);  // the last row of an EXR file is a small block of its own
  std::uint32_t state = 1;
  for (float& v : image.pixels) v = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8);
  return image;
}

TEST_F(Files, AFullDiskLeavesTheOldFile) {
  test::expectOldFileOnFullDisk(file("a"),
                                [](const std::string& path) { writeFileAtomically(path, std::string(30000, 'x')); });
  const test::SmallDisk disk(100);
  EXPECT_EQ(failure([&] { writeFileAtomically(file("a"), std::string(101, 'x')); }),
            file("a") + ": cannot be written: File too large");
}

TEST_F(Files, AFullDiskLeavesTheOldPicture) {
  const Image picture = noise(3);
  test::expectOldFileOnFullDisk(file("a.exr"),
                                [&](const std::string& path) { saveExr(path, picture, ExrPrecision::full); });
  Image halves = picture;
  for (float& v : halves.pixels) v /= 1024.0f;
  test::expectOldFileOnFullDisk(file("a.exr"),
                                [&](const std::string& path) { saveExr(path, halves, ExrPrecision::half); });
  test::expectOldFileOnFullDisk(file("a.hdr"), [&](const std::string& path) { saveHdr(path, picture); });
}

TEST_F(Files, DevicesAreWrittenToNotReplaced) {
  EXPECT_EQ(failure([] { writeFileAtomically("/dev/full", "x"); }),
            "/dev/full: cannot be written: No space left on device; free some space and try again");
  writeFileAtomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, AnUnwritableFolderIsNamed) {
  writeFileAtomically(file("a"), "old");
  fs::permissions(folder, static_cast<fs::perms>(0555));
  const Nobody nobody;
  const std::string expected = ": cannot be written: Permission denied; choose a folder that you may write to";
  EXPECT_EQ(failure([&] { writeFileAtomically(file("a"), "new"); }), file("a") + expected);
  EXPECT_EQ(failure([&] { requireWritable(file("b")); }), file("b") + expected);
  EXPECT_EQ(readFile(file("a"), 10), "old");
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, AMissingFolderIsNamed) {
  const std::string path = file("no/such/a");
  const std::string expected = path + ": cannot be written: No such file or directory; make the folder first";
  EXPECT_EQ(failure([&] { writeFileAtomically(path, "x"); }), expected);
  EXPECT_EQ(failure([&] { requireWritable(path); }), expected);
  EXPECT_NE(failure([&] { writeFileAtomically(folder.string(), "x"); }), "succeeded");
}

TEST_F(Files, ALinkKeepsPointing) {
  writeFileAtomically(file("target"), "old");
  fs::create_symlink("target", file("link"));
  writeFileAtomically(file("link"), "new");
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(readFile(file("target"), 10), "new");
}

TEST_F(Files, ReadingIsBounded) {
  writeFileAtomically(file("a"), "0123456789");
  EXPECT_EQ(readFile(file("a"), 10).size(), 10u);
  EXPECT_THROW(readFile(file("a"), 9), Error);
  EXPECT_THROW(readFile(folder.string(), 9), Error);
}

}  // namespace
}  // namespace welkin
