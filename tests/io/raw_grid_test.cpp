// Raw grids: values where they belong, sizes from header or arguments, and everything that does not fit refused.
#include "welkin/io/raw_grid.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/raw_volume.hpp"

namespace welkin {
namespace {

class RawGrid : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "g.f32").string(); }
  void write(const std::vector<float>& values) const {
    writeBytes(path(), {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
  }
  void header(const std::string& text) const { writeBytes(path() + ".json", text); }
  std::string refusal(const RawGridLayout& layout) const {
    try {
      loadRawGrid(path(), layout);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::badInput);
      return e.what();
    }
    return "";
  }
  static constexpr glm::ivec3 kDims{3, 2, 2};
  static constexpr glm::dvec3 kVoxel{10.0, 20.0, 30.0};

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("welkin_raw_" + std::to_string(getpid()));
};

std::vector<float> counting() { return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}; }

TEST_F(RawGrid, XIsFastestAndZIsUp) {
  write(counting());
  const VoxelGrid grid = loadRawGrid(path(), {kDims, kVoxel});
  EXPECT_EQ(grid.dims(), kDims);
  EXPECT_EQ(grid.voxel(), kVoxel);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(grid.at({i % 3, i / 3 % 2, i / 6}), float(i));
}

TEST_F(RawGrid, AHeaderSaysWhatTheArgumentsDoNot) {
  saveRawVolume(path(), 3, 2, 2, 1, counting());
  EXPECT_EQ(loadRawGrid(path(), {std::nullopt, kVoxel}).at({2, 1, 1}), 11.0f);
  EXPECT_NE(refusal({}).find("how large"), std::string::npos);
  header(R"({"width": 3, "height": 2, "depth": 2, "voxel": [1, 2.5, 4]})");
  EXPECT_EQ(loadRawGrid(path(), {}).voxel(), glm::dvec3(1.0, 2.5, 4.0));
  EXPECT_EQ(loadRawGrid(path(), {glm::ivec3(2, 3, 2), std::nullopt}).dims(), glm::ivec3(2, 3, 2));
}

TEST_F(RawGrid, RefusesWhatDoesNotFit) {
  EXPECT_NE(refusal({kDims, kVoxel}), "") << "no file";
  write(counting());
  EXPECT_NE(refusal({}).find("how many"), std::string::npos);
  EXPECT_NE(refusal({glm::ivec3(3, 2, 3), kVoxel}).find("48 bytes"), std::string::npos);
  EXPECT_NE(refusal({glm::ivec3(0, 2, 3), kVoxel}), "");
  EXPECT_NE(refusal({glm::ivec3(1 << 24), kVoxel}), "");
  EXPECT_NE(refusal({kDims, glm::dvec3(0.0)}), "");
  for (const float bad : {-1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    std::vector<float> values = counting();
    values[7] = bad;
    write(values);
    EXPECT_NE(refusal({kDims, kVoxel}).find("(1, 0, 1)"), std::string::npos) << bad;
  }
}

TEST_F(RawGrid, RefusesHeadersThatAreNone) {
  write(counting());
  for (const char* text : {"", "[]", "{", "{\"width\": 3}", R"({"width": 3.5, "height": 2, "depth": 2})",
                           R"({"width": -3, "height": 2, "depth": 2})", R"({"width": "3", "height": 2, "depth": 2})",
                           R"({"width": 1e30, "height": 2, "depth": 2})", R"({"voxel": 3})", R"({"voxel": [1, 2]})",
                           R"({"voxel": [1, 2, "3"]})", R"({"channels": 3})", R"({"type": "float64"})"}) {
    header(text);
    EXPECT_NE(refusal({kDims, kVoxel}).find(".json"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace welkin
