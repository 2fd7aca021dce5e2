#include "welkin/io/hdr.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {
namespace {

using namespace std::string_view_literals;

// A file by hand: the header, then `rest`.
std::string radiance(std::string_view rest) {
  std::string bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n");
  return bytes.append(rest);
}

class Hdr : public testing::Test {
 protected:
  std::string file_ =
      testing::TempDir() + "welkin_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".hdr";
  ~Hdr() override { std::filesystem::remove(file_); }
};

TEST_F(Hdr, KeepsEveryValueToAShareOfItsPixelsLargest) {
  std::mt19937 random(7);
  for (const auto& [width, channels] : {std::pair(5, 3), std::pair(301, 3), std::pair(40, 1)}) {
    Image image(width, 4, channels);
    for (float& v : image.pixels)
      v = random() % 9 == 0 ? 0.0f
                            : std::ldexp(static_cast<float>(random() % 4096), static_cast<int>(random() % 60) - 30);
    image.pixels[0] = 255.7f;  // rounds up to the next exponent
    saveHdr(file_, image);
    const Image back = loadHdr(file_);
    ASSERT_EQ(back.width, width);
    ASSERT_EQ(back.height, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < width; ++x) {
        const float* c = image.at(x, y);
        const float most = channels == 1 ? c[0] : std::max({c[0], c[1], c[2]});
        for (int k = 0; k < 3; ++k)
          ASSERT_NEAR(back.at(x, y)[k], c[channels == 1 ? 0 : k], most / 255.0f) << x << " " << y << " " << k;
      }
  }
}

TEST_F(Hdr, RunsMakeFlatRowsShort) {
  Image image(4000, 1, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.5f);
  saveHdr(file_, image);
  EXPECT_LT(readFile(file_, 1 << 20).size(), 4u * 4000 / 127 * 3);
  EXPECT_EQ(loadHdr(file_).pixels, image.pixels);
}

TEST_F(Hdr, RefusesWhatItWouldSpoil) {
  for (const float v : {std::nanf(""), INFINITY, 2e38f}) {
    Image image(2, 2, 3);
    image.pixels[5] = v;
    EXPECT_THROW(saveHdr(file_, image), Error);
  }
  EXPECT_THROW(saveHdr(file_, Image(2, 2, 4)), Error);
  EXPECT_FALSE(std::filesystem::exists(file_));
  Image image(1, 1, 3);
  image.pixels = {-3.0f, 1.0f, 0.0f};
  saveHdr(file_, image);
  EXPECT_EQ(loadHdr(file_).pixels, (std::vector<float>{0.0f, 1.0f, 0.0f}));
}

// Files of others, by hand: 128 at exponent 129 is 1.
TEST_F(Hdr, ReadsFlatPixelsAndTheOlderRuns) {
  const Image flat = parseHdr(radiance("-Y 1 +X 2\n\x80\x40\x00\x81\x00\x00\x00\x00"sv), "a.hdr");
  EXPECT_EQ(flat.pixels, (std::vector<float>{1.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f}));
  const Image runs = parseHdr(radiance("-Y 1 +X 300\n\x80\x80\x80\x81\x01\x01\x01\x2b\x01\x01\x01\x01"sv), "a.hdr");
  for (const float v : runs.pixels) ASSERT_EQ(v, 1.0f);  // 1 + 43 + 256 pixels
}

TEST_F(Hdr, SaysWhatIsWrong) {
  const auto refusal = [](const std::string& bytes) -> std::string {
    try {
      parseHdr(bytes, "x.hdr");
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal("P6\n").find("x.hdr: is not a Radiance picture"), std::string::npos);
  EXPECT_NE(refusal(radiance("+Y 1 +X 2\n")).find("rows from the top"), std::string::npos);
  EXPECT_NE(refusal(radiance("-Y 100000 +X 100000\n")).find("too many"), std::string::npos);
  EXPECT_NE(refusal(radiance("-Y 8192 +X 16384\n")).find("too early"), std::string::npos);
  EXPECT_NE(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n").find("only FORMAT"), std::string::npos);
  EXPECT_NE(refusal(radiance("-Y 1 +X 8\n\x02\x02\x00\x09"sv)).find("another width"), std::string::npos);
  EXPECT_NE(refusal(radiance("-Y 1 +X 8\n\x02\x02\x00\x08\x8a\x01"sv)).find("too long"), std::string::npos);
}

TEST_F(Hdr, EveryTruncationIsRefused) {
  Image image(20, 3, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 7);
  saveHdr(file_, image);
  const std::string whole = readFile(file_, 1 << 20);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(parseHdr(std::string_view(whole).substr(0, length), "cut.hdr"), Error) << length;
  EXPECT_NO_THROW(parseHdr(whole, "whole.hdr"));
}

}  // namespace
}  // namespace welkin
