// `welkin vdb` writes what it says, in the axes, units and meanings that it is asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/apps/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/nanovdb.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class VdbCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!hasOpenVdb()) GTEST_SKIP() << "built without OpenVDB (Debian: libopenvdb-dev)";
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  // A coarse bake of a small, cloudy box.
  test::Outcome bake(const std::string& arguments, const std::string& before = "") const {
    const bool elsewhere = arguments.find("--region") != std::string::npos;
    return test::run(std::string("vdb stratocumulus -q --set noise.profile.base_size=32 ") +
                         (elsewhere ? "" : "--voxel 50 --region 0,0,2000,1200,600,1800 ") + arguments,
                     before);
  }
  const fs::path folder = fs::temp_directory_path() / ("welkin_vdb_command_" + std::to_string(getpid()));
};

TEST_F(VdbCommand, AxesUnitsAndMeaningsAgree) {
  const test::Outcome plain = bake("--float -o " + path("plain.vdb"));
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_NE(plain.out.find("40 x 24 x 32 voxels of 50 m"), std::string::npos) << plain.out;
  EXPECT_NE(plain.out.find("active voxels"), std::string::npos) << plain.out;
  const VdbGrid read = loadVdb(path("plain.vdb"));
  EXPECT_EQ(read.notes.at("up_axis"), "z");
  EXPECT_EQ(read.notes.at("density_semantics"), "normalized extinction");
  EXPECT_GT(read.voxels.maximum(), 0.2f);
  EXPECT_LE(read.voxels.maximum(), 1.0f);
  const double one = std::stod(read.notes.at("extinction_per_metre_at_1"));
  EXPECT_TRUE(fs::exists(path("plain.usda")));

  ASSERT_EQ(bake("--float --up y --unit cm --density extinction -o " + path("other.vdb")).code, 0);
  const VdbGrid other = loadVdb(path("other.vdb"));
  EXPECT_EQ(other.notes.at("units"), "cm");
  EXPECT_NEAR(other.voxels.voxel().x, 5000.0, 1e-9);
  const auto at = [](const VoxelGrid& grid, const glm::dvec3& p) {
    return grid.at(glm::ivec3(glm::floor((p - grid.origin()) / grid.voxel())));
  };
  int cloud = 0;
  for (double z = 625.0; z < 1800.0; z += 150.0)
    for (double y = 25.0; y < 1200.0; y += 100.0)
      for (double x = 25.0; x < 2000.0; x += 100.0) {
        const double normalized = at(read.voxels, {x, y, z});
        // Anchors of the two bakes differ, which is worth some 1e-6 of the extinction.
        ASSERT_NEAR(at(other.voxels, {100.0 * x, 100.0 * z, -100.0 * y}), one * normalized, 1e-4 * one);
        cloud += normalized > 0.0;
      }
  EXPECT_GT(cloud, 50);

  // Liquid water of 12 um droplets, 2/3 of density times radius for each 1/m: 4 g/m^3.
  ASSERT_EQ(bake("--float --density lwc --set layer.0.droplet_diameter=12 -o " + path("water.vdb")).code, 0);
  EXPECT_NEAR(loadVdb(path("water.vdb")).voxels.maximum(), 4.0 * one * read.voxels.maximum(), 1e-4);
}

// Its copies go on for 60 km: 6 km round the camera are taken, in whole bricks.
TEST_F(VdbCommand, AFieldOfCopiesIsCutOffRoundTheCamera) {
  const test::Outcome baked = test::run("vdb hero_field -q --voxel 200 -o " + path("field.vdb"));
  ASSERT_EQ(baked.code, 0) << baked.err;
  EXPECT_NE(baked.out.find("-9600 m east to -1600 m"), std::string::npos) << baked.out;
  EXPECT_GT(loadVdb(path("field.vdb")).voxels.maximum(), 0.5f);
}

TEST_F(VdbCommand, TilesFitTogether) {
  ASSERT_EQ(bake("--float -o " + path("whole.vdb")).code, 0);
  ASSERT_EQ(bake("--float --tiles 2x3 -o " + path("part.vdb")).code, 0);
  const VdbGrid whole = loadVdb(path("whole.vdb"));
  std::size_t parts = 0, all = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 2; ++i) {
      const std::string file = path("part_" + std::to_string(i) + "_" + std::to_string(j) + ".vdb");
      ASSERT_TRUE(fs::exists(file));
      const VoxelGrid tile = loadVdb(file).voxels;
      const glm::ivec3 low(glm::round((tile.origin() - whole.voxels.origin()) / tile.voxel()));
      for (int z = 0; z < tile.dims().z; ++z)
        for (int y = 0; y < tile.dims().y; ++y)
          for (int x = 0; x < tile.dims().x; ++x) {
            ASSERT_NEAR(tile.at({x, y, z}), whole.voxels.at(low + glm::ivec3(x, y, z)), 1e-4f);
            parts += tile.at({x, y, z}) > 0.0f;
          }
    }
  for (const float v : whole.voxels.values()) all += v > 0.0f;
  // A voxel that is barely cloud may be none from another anchor.
  EXPECT_NEAR(static_cast<double>(parts), static_cast<double>(all), 3.0);
}

TEST_F(VdbCommand, SequencesMove) {
  ASSERT_EQ(bake("--frames 3-4 --fps 0.1 -o " + path("flow.vdb") + " -o " + path("flow.vol")).code, 0);
  EXPECT_TRUE(fs::exists(path("flow.0003.vol")));
  EXPECT_EQ(loadVdb(path("flow.0003.vdb")).notes.at("time"), "30");
  const VoxelGrid a = loadVdb(path("flow.0003.vdb")).voxels, b = loadVdb(path("flow.0004.vdb")).voxels;
  // Ten seconds of wind are two voxels.
  int changed = 0, cloud = 0;
  for (int n = 0; n < 32 * 24 * 40; ++n) {
    const glm::dvec3 p(50.0 * (n % 40) + 25.0, 50.0 * (n / 40 % 24) + 25.0, 50.0 * (n / 960) + 425.0);
    const auto at = [&](const VoxelGrid& g) { return g.at(glm::ivec3(glm::floor((p - g.origin()) / g.voxel()))); };
    cloud += at(a) > 0.0f || at(b) > 0.0f;
    changed += at(a) != at(b);
  }
  EXPECT_GT(cloud, 1000);
  EXPECT_GT(changed, cloud / 2);
  EXPECT_NE(test::slurp(path("flow.usda")).find("4: @./flow.0004.vdb@"), std::string::npos);
}

TEST_F(VdbCommand, SequencesFollowKeyframes) {
  std::ofstream(path("growing.sky.toml"))
      << "format = 1\n[[layer]]\n[[keyframe]]\ntime = 0\nlayer.weather.coverage = 0\n"
         "[[keyframe]]\ntime = 10\nlayer.weather.coverage = 1\n";
  const test::Outcome o = test::run("vdb " + path("growing.sky.toml") +
                                    " -q --set noise.profile.base_size=32 --region -2000,-2000,2000,2000 --voxel 100 " +
                                    "--frames 0-1 --fps 0.1 -o " + path("growing.vdb"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THROW(loadVdb(path("growing.0000.vdb")), Error);  // it is empty
  EXPECT_GT(loadVdb(path("growing.0001.vdb")).voxels.maximum(), 0.5f);
}

TEST_F(VdbCommand, TellsWhatToTypeThere) {
  for (const auto& [target, suffix, words] : {std::tuple("blender", "vdb", "Anisotropy 0.8"),
                                              {"houdini", "vdb", "Density Scale"},
                                              {"unreal", "vdb", "centimetre"},
                                              {"mitsuba", "vol", "gridvolume"},
                                              {"pbrt", "nvdb", "MakeNamedMedium"}}) {
    const test::Outcome o = bake(std::string("--target ") + target + " -o " + path(std::string("t.") + suffix));
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_NE(o.out.find(words), std::string::npos) << o.out;
  }
}

TEST_F(VdbCommand, RefusesWhatItCannotDo) {
  const auto fails = [&](const std::string& arguments, int code, const char* words) {
    const test::Outcome o = bake(arguments);
    EXPECT_EQ(o.code, code) << arguments;
    EXPECT_NE(o.err.find(words), std::string::npos) << o.err;
  };
  const std::string out = " -o " + path("x.vdb");
  fails("-o " + path("x.abc"), 2, "ends in .vdb, .nvdb");
  fails("-o " + path("missing/x.vdb"), 1, "make the folder first");
  fails("--region 1,2,3" + out, 2, "write west,south,east,north");
  fails("--region 0,0,-5,5" + out, 2, "are less than east");
  fails("--tiles 900x900" + out, 2, "smaller than a brick");
  fails("--frames 9-3" + out, 2, "FIRST-LAST");
  fails("--half --float" + out, 2, "not both");
  fails("--target pbrt" + out, 2, "reads .nvdb files");
  fails("--region -60000,-60000,60000,60000 --voxel 2" + out, 3, "--tiles");
  fails("--set layer.0.extinction=0" + out, 3, "nothing to put into a volume");
  EXPECT_FALSE(fs::exists(path("x.vdb")));
}

TEST_F(VdbCommand, AFullDiskLeavesTheOldFiles) {
  for (const std::string name : {"a.vdb", "a.nvdb", "a.vol"}) {
    if (name == "a.nvdb" && !hasNanoVdb()) continue;
    std::ofstream(path(name)) << "old";
    const std::string before = test::listing(folder);
    const test::Outcome o = bake("-o " + path(name), test::fullDisk(16));
    EXPECT_EQ(o.code, 1) << name;
    EXPECT_NE(o.err.find(path(name) + ": cannot be written as "), std::string::npos) << o.err;
    EXPECT_EQ(test::slurp(path(name)), "old");
    EXPECT_EQ(test::listing(folder), before);
  }
}

// Before it bakes, and of a grid in a sky file too; other volumes are written all the same.
TEST(VdbCommandWithoutOpenVdb, SaysWhatIsMissing) {
  if (hasOpenVdb()) GTEST_SKIP() << "built with OpenVDB";
  const fs::path folder = fs::temp_directory_path() / ("welkin_no_vdb_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "cloud.vdb") << "a grid";
  std::ofstream(folder / "grid.sky.toml") << "format = 1\nlayer = []\n[[grid]]\nfile = \"cloud.vdb\"\n";
  const std::string stem = (folder / "cloud").string();
  for (const std::string& arguments : {"vdb -o " + stem + ".vdb", "flux --grid " + stem + ".vdb",
                                       "render " + (folder / "grid.sky.toml").string() + " -o " + stem + ".png"}) {
    const test::Outcome o = test::run(arguments);
    EXPECT_EQ(o.code, 1) << arguments;
    EXPECT_EQ(o.out, "");
    EXPECT_NE(o.err.find("cloud.vdb: needs OpenVDB"), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("install libopenvdb-dev"), std::string::npos) << o.err;
  }
  EXPECT_EQ(test::slurp(folder / "cloud.vdb"), "a grid");
  EXPECT_EQ(test::run("vdb -q --set noise.profile.base_size=32 --voxel 400 -o " + stem + ".vol").code, 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace welkin
