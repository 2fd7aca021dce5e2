// 10,000 mutations of each kind of picture: read or refused, without a crash, a hang or gigabytes. Deterministic.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <random>

#include "tests/fuzz/mutation.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/hdr.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr int kPictures = 1000;  // it is slow, and there is one thread
#else
constexpr int kPictures = 10000;
#endif

// A number that is too large, or negative.
void extremeNumber(std::string& bytes, std::size_t at, test::Random& random) {
  static constexpr std::uint32_t kNumbers[] = {0x7fffffff, 0xffffffff, 0x80000000, 0x00ffffff, 0xffffff7f, 0};
  if (at + 4 <= bytes.size()) std::memcpy(bytes.data() + at, &kNumbers[random() % 6], 4);
}
const test::Mutation kPictureMutations[] = {extremeNumber};
constexpr std::size_t kHeader = 400;  // bytes, about: half of the mutations go there

void fuzz(const std::vector<std::string>& seeds, const std::function<Image(const std::string&)>& parse) {
  test::Random random(11);
  int refused = 0;
  for (int i = 0; i < kPictures; ++i) {
    std::string bytes = seeds[random() % seeds.size()];
    for (unsigned k = 1 + random() % 3; k > 0; --k)
      test::mutate(bytes, random, kPictureMutations, random() % 2 ? std::string::npos : kHeader);
    try {
      const Image image = parse(bytes);
      ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * image.height * image.channels);
    } catch (const Error& e) {
      ASSERT_EQ(e.kind(), ErrorKind::badInput);
      ++refused;
    }
  }
  EXPECT_GT(refused, kPictures / 4);  // or the mutations test nothing
#ifndef __SANITIZE_ADDRESS__
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 600 * 1024);  // kB: the parsers may fill 4096 times the file before they refuse it
#endif
}

class PictureFuzz : public testing::Test {
 protected:
  std::string file_ =
      testing::TempDir() + "welkin_fuzz_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  ~PictureFuzz() override { std::filesystem::remove(file_); }
  std::string saved(const std::function<void(const std::string&)>& save) const {
    save(file_);
    return readFile(file_, 1 << 24);
  }
};

Image noise(int width, int height, int channels) {
  std::mt19937 random(2);
  Image image(width, height, channels);
  for (float& v : image.pixels) v = static_cast<float>(random() % 64) / 8.0f;
  image.features = "clouds,sheets";
  return image;
}

TEST_F(PictureFuzz, Exr) {
  std::vector<std::string> seeds;
  for (const int channels : {1, 3, 4})
    for (const ExrPrecision precision : {ExrPrecision::half, ExrPrecision::full})
      seeds.push_back(saved([&](const std::string& f) {
        saveExr(f, noise(24, 40, channels), precision,
                {.environment = ExrEnvironment::latlong, .captureDate = "2026:06:21 12:00:00", .placed = true});
      }));
  fuzz(seeds, [](const std::string& bytes) { return parseExr(bytes, "f.exr"); });
}

TEST_F(PictureFuzz, Hdr) {
  std::vector<std::string> seeds;
  for (const int width : {4, 60}) seeds.push_back(saved([&](const std::string& f) { saveHdr(f, noise(width, 9, 3)); }));
  fuzz(seeds, [](const std::string& bytes) { return parseHdr(bytes, "f.hdr"); });
}

TEST_F(PictureFuzz, Png) {
  std::vector<std::string> seeds;
  for (int channels = 1; channels <= 4; ++channels) {
    const std::vector<std::uint8_t> samples(static_cast<std::size_t>(31) * 17 * channels, 77);
    seeds.push_back(saved([&](const std::string& f) { savePng(f, 31, 17, channels, samples, "clouds"); }));
  }
  const std::vector<std::uint16_t> wide(31 * 17, 7777);
  seeds.push_back(saved([&](const std::string& f) { savePng16(f, 31, 17, 1, wide); }));
  fuzz(seeds, [](const std::string& bytes) { return parsePng(bytes, "f.png"); });
}

}  // namespace
}  // namespace welkin
