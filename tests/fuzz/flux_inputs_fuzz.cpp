// 10,000 mutations of phase tables and of raw grids' headers: read or refused, without a crash or a hang.
// Deterministic.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "tests/fuzz/mutation.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/raw_grid.hpp"
#include "welkin/trace/phase_table.hpp"

namespace welkin {
namespace {

constexpr int kTexts = 10000;

constexpr std::string_view kPieces[] = {"nan", "inf",       "-1", "1e999", "1e-999", "0",
                                        "180", "\n",        " ",  ",",     "#",      "{",
                                        "[[[", "]",         "}",  "\"",    "\\u",    std::string_view("\0", 1),
                                        ":",   "4294967296"};
const test::Mutation kFluxMutations[] = {test::anotherDigit, test::piece(kPieces)};

// Counts the mutations of a text that `read` does not refuse.
template <class Read>
int countRead(const std::string& text, const Read& read) {
  test::Random random(77);
  int good = 0;
  for (int i = 0; i < kTexts; ++i) {
    std::string mutated = text;
    for (std::size_t k = 1 + random() % 3; k > 0; --k) test::mutate(mutated, random, kFluxMutations);
    try {
      read(mutated);
      ++good;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::badInput) << mutated;
      EXPECT_EQ(std::string(e.what()).rfind("f", 0), 0u) << "says where: " << e.what();
    }
  }
  return good;
}

TEST(FluxInputsFuzz, PhaseTables) {
  std::string text = "# angle value\n";
  for (int degrees = 0; degrees <= 180; degrees += 10)
    text += std::to_string(degrees) + " " + std::to_string(10.0 / (1 + degrees)) + "\n";
  const int good = countRead(text, [](const std::string& mutated) {
    const PhaseTable table = PhaseTable::parse(mutated, "f");
    for (const float u : {0.0f, 0.3f, 0.99999994f}) {
      const PhaseTable::Sample s = table.sample(u);
      ASSERT_TRUE(s.versine >= 0.0f && s.versine <= 2.0f && std::isfinite(s.pdf) && s.pdf >= 0.0f) << mutated;
      ASSERT_TRUE(std::isfinite(table.evaluate(s.versine)) && std::isfinite(table.pdf(s.versine))) << mutated;
    }
    ASSERT_TRUE(std::abs(table.meanCosine()) <= 1.0 + 1e-9) << mutated;
  });
  EXPECT_GT(good, kTexts / 20) << "mutations that leave nothing to read test little";
  EXPECT_LT(good, kTexts);
}

TEST(FluxInputsFuzz, RawGrids) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("welkin_fuzz_raw_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  writeBytes("f.f32", std::string(std::size_t(4 * 5 * 6) * sizeof(float), '\0'));
  int calls = 0;
  const int good = countRead(
      R"({"format": "welkin raw volume 1", "type": "float32 little-endian", "width": 4, "height": 5, "depth": 6,
          "channels": 1, "voxel": [10.0, 20.0, 30.0]})",
      [&](const std::string& mutated) {
        const RawGridLayout layout = parseRawGridHeader(mutated, "f.f32.json");
        if (calls++ % 20 != 0) return;  // files take their time
        writeBytes("f.f32.json", mutated);
        const VoxelGrid grid = loadRawGrid("f.f32", layout);
        ASSERT_EQ(grid.dims().x * grid.dims().y * grid.dims().z, 4 * 5 * 6);
        ASSERT_TRUE(grid.voxel().x > 0.0 && std::isfinite(grid.voxel().z));
      });
  EXPECT_GT(good, kTexts / 20);
  EXPECT_LT(good, kTexts);
  std::filesystem::current_path(testing::TempDir());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace welkin
