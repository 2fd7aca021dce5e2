// Other people's programs read what we write, and agree on it.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "tests/vdb/volumes.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/mitsuba_volume.hpp"
#include "welkin/io/nanovdb.hpp"
#include "welkin/io/usd_volume.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

struct Answer {
  int status = -1;
  std::string text;
};

Answer run(const std::string& command) {
  Answer answer;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return answer;
  char block[4096];
  while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) answer.text.append(block, got);
  answer.status = ::pclose(pipe);
  return answer;
}

bool has(const std::string& program) { return run("command -v " + program).status == 0; }

// 40 x 24 x 32 voxels of 12.5 m from (-200, 400, 800).
VoxelGrid cloud() { return test::ball({40, 24, 32}, {-200.0, 400.0, 800.0}, glm::dvec3(12.5)); }

int activeVoxels(const VoxelGrid& grid) {
  int count = 0;
  for (const float v : grid.values()) count += v > 0.0f;
  return count;
}

#define EXPECT_HAS(answer, part) EXPECT_NE((answer).text.find(part), std::string::npos) << (answer).text

TEST(Readers, VdbPrint) {
  if (!has("vdb_print")) GTEST_SKIP() << "vdb_print is not installed (Debian: libopenvdb-tools)";
  const std::string path = test::temporary("for_vdb_print.vdb");
  const VolumeNote notes[] = {{"up_axis", std::string("z")}, {"extinction_per_metre_at_1", 0.25}};
  saveVdb(path, cloud(), notes, VolumePrecision::half);
  const Answer answer = run("vdb_print -m " + path);
  EXPECT_EQ(answer.status, 0);
  EXPECT_HAS(answer, "float (-16,32,64)->(23,55,95) ");
  EXPECT_HAS(answer, "40x24x32");
  EXPECT_HAS(answer, "voxel size: 12.5");
  EXPECT_HAS(answer, "[6.25, 6.25, 6.25, 1]");
  EXPECT_HAS(answer, "class: fog volume");
  EXPECT_HAS(answer, "is_saved_as_half_float: true");
  EXPECT_HAS(answer, "up_axis: z");
  EXPECT_HAS(answer, "extinction_per_metre_at_1: 0.25");
  EXPECT_HAS(answer, "file_voxel_count: " + std::to_string(activeVoxels(cloud())));
}

TEST(Readers, PythonOpenVdb) {
  if (run("/usr/bin/python3 -c 'import pyopenvdb'").status != 0)
    GTEST_SKIP() << "pyopenvdb is not installed (Debian: python3-openvdb)";
  const std::string path = test::temporary("for_python.vdb");
  const VoxelGrid grid = cloud();
  saveVdb(path, grid, {}, VolumePrecision::full);
  const Answer answer =
      run("/usr/bin/python3 -c \"import pyopenvdb as v\n"
          "g = v.read('" +
          path +
          "', 'density')\n"
          "print(g.name, g.activeVoxelCount(), g.getConstAccessor().getValue((-16+20, 32+12, 64+16)))\n"
          "print(g.transform.indexToWorld((4, 44, 80)))\"");
  EXPECT_EQ(answer.status, 0) << answer.text;
  double value = 0.0;
  int count = 0;
  ASSERT_EQ(std::sscanf(answer.text.c_str(), "density %d %lf", &count, &value), 2) << answer.text;
  EXPECT_EQ(count, activeVoxels(grid));
  EXPECT_EQ(static_cast<float>(value), grid.at({20, 12, 16}));
  EXPECT_HAS(answer, "(56.25, 556.25, 1006.25)");
}

TEST(Readers, NanoVdbTools) {
  if (!hasNanoVdb()) GTEST_SKIP() << "built without NanoVDB (Debian: libnanovdb-dev)";
  const std::string path = test::temporary("for_nanovdb.nvdb");
  saveNanoVdb(path, cloud());
  if (!has("nanovdb_validate")) GTEST_SKIP() << "nanovdb_validate is not installed (Debian: libnanovdb-tools)";
  const Answer valid = run("nanovdb_validate -v " + path), table = run("nanovdb_print " + path);
  EXPECT_EQ(valid.status, 0);
  EXPECT_HAS(valid, "\"density\": passed");
  EXPECT_HAS(table, "FOG");
  EXPECT_HAS(table, "(12.5,12.5,12.5)");
  EXPECT_HAS(table, "40 x 24 x 32");
  EXPECT_HAS(table, std::to_string(activeVoxels(cloud())));
  // Its converter turns it back into an OpenVDB file with the same voxels.
  const std::string back = test::temporary("from_nanovdb.vdb");
  if (!hasOpenVdb() || run("nanovdb_convert -f " + path + " " + back).status != 0) return;
  const VdbGrid read = loadVdb(back);
  EXPECT_EQ(read.voxels.at({20, 12, 16}), cloud().at({20, 12, 16}));
  EXPECT_LT(glm::length(read.voxels.origin() - cloud().origin()), 1e-3);
}

// The layout that Mitsuba 3's src/volumes/grid.cpp reads.
TEST(Readers, MitsubaVolumeIsLaidOutAsMitsubaReadsIt) {
  const std::string path = test::temporary("for_mitsuba.vol");
  const VoxelGrid grid = cloud();
  saveMitsubaVolume(path, grid);
  const std::string bytes = readFile(path, 1 << 20);
  ASSERT_EQ(bytes.size(), 48u + 4u * 40 * 24 * 32);
  EXPECT_EQ(bytes.substr(0, 3), "VOL");
  EXPECT_EQ(bytes[3], 3);
  std::array<std::int32_t, 5> counts{};
  std::array<float, 6> box{};
  std::memcpy(counts.data(), bytes.data() + 4, sizeof counts);
  std::memcpy(box.data(), bytes.data() + 24, sizeof box);
  EXPECT_EQ(counts, (std::array<std::int32_t, 5>{1, 40, 24, 32, 1}));
  EXPECT_EQ(box, (std::array<float, 6>{-200.0f, 400.0f, 800.0f, 300.0f, 700.0f, 1200.0f}));
  float value = 0.0f;
  std::memcpy(&value, bytes.data() + 48 + 4 * ((16 * 24 + 12) * 40 + 20), sizeof value);
  EXPECT_EQ(value, grid.at({20, 12, 16}));
}

TEST(Readers, UsdStage) {
  const UsdVolume volumes[] = {{{"a.0007.vdb", "a.0008.vdb"}, glm::dvec3(0.0), glm::dvec3(10.0, 20.0, 30.0)}};
  const std::string text = usdStage({.title = "a \"quoted\" sky", .metresPerUnit = 0.01, .firstFrame = 7}, volumes);
  for (const char* part :
       {"#usda 1.0\n", "doc = \"a \\\"quoted\\\" sky\"", "metersPerUnit = 0.01", "upAxis = \"Z\"", "startTimeCode = 7",
        "endTimeCode = 8", "7: @./a.0007.vdb@,", "8: @./a.0008.vdb@,", "rel field:density = </Clouds/Volume_0/density>",
        "token fieldName = \"density\"", "float3[] extent = [(0, 0, 0), (10, 20, 30)]"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
}

}  // namespace
}  // namespace welkin
