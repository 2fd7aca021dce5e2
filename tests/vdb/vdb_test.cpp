// Volumes survive the way into OpenVDB files and back; files of others are read or refused with a reason.
#include "welkin/io/vdb.hpp"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/io/small_disk.hpp"
#include "tests/vdb/volumes.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/mitsuba_volume.hpp"
#include "welkin/io/nanovdb.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {
namespace {

std::string messageOf(const std::string& path, const std::string& name = "", const IsolationLimits& limits = {}) {
  try {
    loadVdb(path, name, limits);
  } catch (const Error& e) {
    return e.what();
  }
  return "was read";
}

void write(const std::string& path, const openvdb::GridPtrVec& grids) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.write(grids);
  file.close();
}

openvdb::FloatGrid::Ptr oneVoxel(const openvdb::Coord& at, float value) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create();
  grid->setName("density");
  grid->tree().setValue(at, value);
  return grid;
}

void expectSame(const VoxelGrid& read, const VoxelGrid& written, bool half) {
  // What is read is the box of the active voxels of what was written.
  const glm::dvec3 moved = (read.origin() - written.origin()) / written.voxel();
  const glm::ivec3 low(glm::round(moved));
  EXPECT_LT(glm::length(moved - glm::dvec3(low)), 1e-4);
  EXPECT_LT(glm::length(read.voxel() - written.voxel()), 1e-9);
  int active = 0;
  for (int z = 0; z < written.dims().z; ++z)
    for (int y = 0; y < written.dims().y; ++y)
      for (int x = 0; x < written.dims().x; ++x) {
        const float v = written.at({x, y, z});
        ASSERT_EQ(read.at(glm::ivec3(x, y, z) - low), half ? roundedToHalf(v) : v) << x << ' ' << y << ' ' << z;
        active += v > 0.0f;
      }
  EXPECT_GT(active, 100);
}

TEST(Vdb, RoundTripKeepsEveryVoxel) {
  const VoxelGrid ball = test::ball({37, 21, 30}, {-125.0, 400.0, 800.0}, {12.5, 12.5, 12.5});
  const std::string path = test::temporary("round_trip.vdb");
  const VolumeNote notes[] = {
      {"creator_note", std::string("a test")}, {"extinction_per_metre_at_1", 0.0625}, {"seed", std::int64_t{7}}};
  saveVdb(path, ball, notes, VolumePrecision::full);
  const VdbGrid read = loadVdb(path);
  EXPECT_EQ(read.name, "density");
  EXPECT_EQ(read.placement, glm::dmat4(1.0));
  EXPECT_EQ(read.notes.at("creator_note"), "a test");
  EXPECT_EQ(read.notes.at("extinction_per_metre_at_1"), "0.0625");
  EXPECT_EQ(read.notes.at("seed"), "7");
  EXPECT_EQ(read.notes.at("class"), "fog volume");
  expectSame(read.voxels, ball, false);

  saveVdb(path, ball, {}, VolumePrecision::half);
  expectSame(loadVdb(path).voxels, ball, true);
  EXPECT_EQ(loadVdb(path).notes.at("is_saved_as_half_float"), "true");
}

TEST(Vdb, GridsOnOneLatticeShareTheirTransform) {
  const std::string a = test::temporary("lattice_a.vdb"), b = test::temporary("lattice_b.vdb");
  saveVdb(a, test::ball({24, 24, 24}, {-1600.0, 0.0, 800.0}, glm::dvec3(10.0)), {}, VolumePrecision::full);
  saveVdb(b, test::ball({24, 24, 24}, {640.0, 240.0, 80.0}, glm::dvec3(10.0)), {}, VolumePrecision::full);
  openvdb::io::File one(a), other(b);
  one.open(), other.open();
  EXPECT_EQ(one.readGrid("density")->transform(), other.readGrid("density")->transform());
}

TEST(Vdb, HalvesThatOverflowAreRefused) {
  VoxelGrid grid({8, 8, 8}, {}, glm::dvec3(1.0));
  grid.set({1, 2, 3}, 70000.0f);
  const std::string path = test::temporary("overflow.vdb");
  std::filesystem::remove(path);
  EXPECT_THROW(saveVdb(path, grid, {}, VolumePrecision::half), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
  saveVdb(path, grid, {}, VolumePrecision::full);
  EXPECT_EQ(loadVdb(path).voxels.maximum(), 70000.0f);
}

TEST(Vdb, TurnedAndMirroredGridsKeepTheirPlacement) {
  auto grid = oneVoxel({3, -4, 5}, 0.5f);
  openvdb::Mat4d map = openvdb::Mat4d::identity();
  map.preScale(openvdb::Vec3d(2.0, 3.0, -4.0));
  map.postRotate(openvdb::math::X_AXIS, 0.5);
  map.postTranslate(openvdb::Vec3d(100.0, 200.0, 300.0));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(map));
  const std::string path = test::temporary("turned.vdb");
  write(path, {grid});
  const VdbGrid read = loadVdb(path);
  EXPECT_EQ(read.voxels.dims(), glm::ivec3(1));
  const glm::dvec3 centre = read.voxels.origin() + 0.5 * read.voxels.voxel();
  const glm::dvec3 world = read.placement * glm::dvec4(centre, 1.0);
  const openvdb::Vec3d expected = grid->indexToWorld(openvdb::Vec3d(3.0, -4.0, 5.0));
  EXPECT_NEAR(world.x, expected.x(), 1e-9);
  EXPECT_NEAR(world.y, expected.y(), 1e-9);
  EXPECT_NEAR(world.z, expected.z(), 1e-9);
  EXPECT_NEAR(glm::determinant(glm::dmat3(read.placement)), -1.0, 1e-9);
}

TEST(Vdb, TilesAndBackgroundsAreRead) {
  auto grid = oneVoxel({-20, 0, 0}, -1.0f);  // negative: no cloud
  grid->tree().root().setBackground(9.0f, false);
  grid->tree().addTile(1, {0, 0, 0}, 0.25f, true);           // 8^3
  grid->tree().addTile(2, {128, 0, 0}, 0.75f, true);         // 128^3
  grid->tree().setValueOff(openvdb::Coord(5, 60, 5), 3.0f);  // inactive
  const std::string path = test::temporary("tiles.vdb");
  write(path, {grid});
  const VdbGrid read = loadVdb(path);
  EXPECT_EQ(read.voxels.dims(), glm::ivec3(128 + 128 + 20, 128, 128));
  const auto at = [&](int x, int y, int z) { return read.voxels.at(glm::ivec3(x + 20, y, z)); };
  EXPECT_EQ(at(-20, 0, 0), 0.0f);
  EXPECT_EQ(at(7, 7, 7), 0.25f);
  EXPECT_EQ(at(8, 7, 7), 0.0f);
  EXPECT_EQ(at(255, 127, 127), 0.75f);
  EXPECT_EQ(at(5, 60, 5), 0.0f);
}

TEST(Vdb, ChoosesAmongGrids) {
  auto density = oneVoxel({0, 0, 0}, 1.0f), heat = oneVoxel({9, 0, 0}, 2.0f);
  heat->setName("heat");
  auto ids = openvdb::Int32Grid::create();
  ids->setName("ids");
  ids->tree().setValue({1, 1, 1}, 4);
  const std::string path = test::temporary("several.vdb");
  write(path, {ids, heat, density});
  EXPECT_EQ(loadVdb(path).name, "density");
  EXPECT_EQ(loadVdb(path, "heat").voxels.maximum(), 2.0f);
  EXPECT_NE(messageOf(path, "ids").find("'ids' (not floats)"), std::string::npos) << messageOf(path, "ids");
  write(path, {ids, heat});
  EXPECT_EQ(loadVdb(path).name, "heat");
  write(path, {ids});
  EXPECT_NE(messageOf(path).find("holds no float grid"), std::string::npos) << messageOf(path);
}

TEST(Vdb, RefusesWhatIsNoCloud) {
  openvdb::initialize();
  const std::string path = test::temporary("no_cloud.vdb");
  auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0f, openvdb::Vec3f(0.0f), 1.0f);
  write(path, {ball});
  EXPECT_NE(messageOf(path).find("level set"), std::string::npos) << messageOf(path);

  auto frustum = oneVoxel({1, 1, 1}, 1.0f);
  frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(10.0)), 0.5, 10.0));
  write(path, {frustum});
  EXPECT_NE(messageOf(path).find("frustum"), std::string::npos) << messageOf(path);

  write(path, {openvdb::FloatGrid::create()});
  EXPECT_NE(messageOf(path).find("is empty"), std::string::npos) << messageOf(path);
  write(path, {oneVoxel({1, 1, 1}, std::nanf(""))});
  EXPECT_NE(messageOf(path).find("cannot have the value nan"), std::string::npos) << messageOf(path);
  auto wide = oneVoxel({-2000000000, 0, 0}, 1.0f);
  wide->tree().setValue({2000000000, 0, 0}, 1.0f);
  write(path, {wide});
  EXPECT_NE(messageOf(path).find("too large"), std::string::npos) << messageOf(path);
  auto solid = oneVoxel({0, 0, 0}, 1.0f);
  solid->tree().addTile(3, {0, 0, 0}, 1.0f, true);  // 4096^3
  write(path, {solid});
  EXPECT_NE(messageOf(path).find("too large"), std::string::npos) << messageOf(path);
  EXPECT_NE(messageOf(path + ".none").find("no such file"), std::string::npos) << messageOf(path + ".none");
  EXPECT_NE(messageOf(WELKIN_SOURCE_DIR).find("no such file"), std::string::npos);
}

TEST(Vdb, AMarginIsAddedOnEverySide) {
  const std::string path = test::temporary("margin.vdb");
  const VoxelGrid ball = test::ball({20, 14, 9}, {-125.0, 400.0, 800.0}, glm::dvec3(12.5));
  saveVdb(path, ball, {}, VolumePrecision::full);
  const VdbGrid plain = loadVdb(path), wide = loadVdb(path, "", {}, 2);
  EXPECT_EQ(wide.voxels.dims(), plain.voxels.dims() + 4);
  EXPECT_EQ(wide.voxels.at({7, 8, 6}), plain.voxels.at({5, 6, 4}));
  EXPECT_EQ(wide.voxels.interpolate({-10.0, 480.0, 850.0}), plain.voxels.interpolate({-10.0, 480.0, 850.0}));
}

TEST(Vdb, LimitsHold) {
  if (test::kShadowMemory) GTEST_SKIP() << "no limit on address space beside shadow memory";
  const std::string path = test::temporary("limits.vdb");
  saveVdb(path, test::ball({64, 64, 64}, {}, glm::dvec3(10.0)), {}, VolumePrecision::half);
  EXPECT_NE(messageOf(path, "", {.bytes = 1 << 16, .seconds = 60.0}).find("too large"), std::string::npos)
      << messageOf(path, "", {.bytes = 1 << 16, .seconds = 60.0});
}

TEST(Vdb, AFailedWriteLeavesTheOldFile) {
  const std::string path = test::temporary("kept.vdb");
  writeFileAtomically(path, "old");
  VoxelGrid grid({8, 8, 8}, {}, glm::dvec3(1.0));
  grid.set({1, 2, 3}, 70000.0f);
  EXPECT_THROW(saveVdb(path, grid, {}, VolumePrecision::half), Error);
  EXPECT_EQ(readFile(path, 10), "old");
}

TEST(Vdb, AFullDiskLeavesTheOldFile) {
  const VoxelGrid ball = test::ball({40, 32, 24}, {}, glm::dvec3(10.0));
  test::expectOldFileOnFullDisk(test::temporary("full.vdb"),
                                [&](const std::string& path) { saveVdb(path, ball, {}, VolumePrecision::full); });
  test::expectOldFileOnFullDisk(test::temporary("full.vdb"),
                                [&](const std::string& path) { saveVdb(path, ball, {}, VolumePrecision::half); });
  if (hasNanoVdb())
    test::expectOldFileOnFullDisk(test::temporary("full.nvdb"),
                                  [&](const std::string& path) { saveNanoVdb(path, ball); });
  test::expectOldFileOnFullDisk(test::temporary("full.vol"),
                                [&](const std::string& path) { saveMitsubaVolume(path, ball); });
}

}  // namespace
}  // namespace welkin
