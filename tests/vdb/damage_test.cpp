// Damaged files end in an error or in values that are numbers: never in a crash, a hang or gigabytes.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstring>
#include <random>

#include "tests/vdb/volumes.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

constexpr IsolationLimits kLimits{.bytes = std::size_t{512} << 20, .seconds = 20.0};

std::string smallFile(VolumePrecision precision) {
  const std::string path = test::temporary("whole.vdb");
  const VolumeNote notes[] = {{"sky", std::string("test")}, {"extinction_per_metre_at_1", 0.1}};
  saveVdb(path, test::ball({20, 14, 9}, {-125.0, 400.0, 800.0}, glm::dvec3(12.5)), notes, precision);
  return readFile(path, 1 << 20);
}

// True when the bytes are read as a volume.
bool isRead(const std::string& bytes) {
  const std::string path = test::temporary("damaged.vdb");
  writeBytes(path, bytes);
  try {
    const VdbGrid grid = loadVdb(path, "", kLimits);
    EXPECT_TRUE(std::isfinite(grid.voxels.maximum()));
    return true;
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::badInput) << e.what();
    EXPECT_EQ(e.where(), path);
    EXPECT_GT(std::strlen(e.what()), path.size() + 10);
    return false;
  }
}

// Flips bits, writes numbers that lengths and offsets fear, and moves pieces about.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  static constexpr unsigned kFeared[] = {0u, 1u, 0x7Fu, 0xFFu, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu, 0x7F800000u};
  for (std::size_t n = 1 + below(4); n > 0; --n) {
    const std::size_t at = below(bytes.size() - 8);
    switch (below(4)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        std::memcpy(bytes.data() + at, &kFeared[below(std::size(kFeared))], 4);
        break;
      case 2:
        bytes[at] = static_cast<char>(random());
        break;
      default: {
        const std::size_t from = below(bytes.size() - 8),
                          count = std::min(below(64), bytes.size() - std::max(at, from));
        std::memmove(bytes.data() + at, bytes.data() + from, count);
      }
    }
  }
  return bytes;
}

void mutate(int count, unsigned seed) {
  std::mt19937 random(seed);
  const std::string whole[] = {smallFile(VolumePrecision::half), smallFile(VolumePrecision::full)};
  ASSERT_TRUE(isRead(whole[0]));
  int refused = 0;
  for (int i = 0; i < count; ++i) refused += !isRead(mutated(whole[i % 2], random));
  EXPECT_GT(refused, count / 10);
  EXPECT_LT(refused, count);
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  EXPECT_LT(used.ru_maxrss, (512 + 256) << 10) << "KiB of the largest child";
}

TEST(DamagedVdb, EveryTruncationIsRefused) {
  const std::string whole = smallFile(VolumePrecision::half);
  ASSERT_TRUE(isRead(whole));
  const std::size_t step = whole.size() / 400 + 1;
  for (std::size_t size = 0; size < whole.size(); size += size < 400 ? 7 : step)
    ASSERT_FALSE(isRead(whole.substr(0, size))) << size << " of " << whole.size() << " bytes";
}

TEST(DamagedVdb, MutationsDoNoHarm) { mutate(1000, 1); }
TEST(DamagedVdbLong, MutationsDoNoHarm) { mutate(10000, 2); }

}  // namespace
}  // namespace welkin
