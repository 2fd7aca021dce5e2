// welkin flux and welkin validate: what they print, what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;

class FluxCommand : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    writeFloats("slab.f32", {0.002f});
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void writeFloats(const std::string& name, const std::vector<float>& values) const {
    writeBytes(path(name), {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
  }
  // A slab of optical depth 2, photons few.
  std::string slab() const {
    return "flux --raw " + path("slab.f32") + " --dims 1,1,1 --voxel 1000,1000,1000 --periodic xy --photons 20000 ";
  }
  static json parsed(const Outcome& o) {
    EXPECT_EQ(o.code, 0) << o.err;
    return json::parse(o.out);
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("welkin_flux_" + std::to_string(getpid()));
};

// van de Hulst 1980: R .09739, T .66096.
TEST_F(FluxCommand, JsonHoldsTheSlabOfVanDeHulst) {
  const Outcome o = run(slab() + "--albedo 0.9 --phase hg:0.75 --view 0,0 --view 140,30 --json");
  const json all = parsed(o);
  EXPECT_EQ(o.err, "");
  const double expected[] = {0.09739, 0.66096, 1.0 - 0.09739 - 0.66096};
  for (int i = 0; i < 3; ++i) {
    const json& field = all[std::string(1, "RTA"[i])];
    EXPECT_NEAR(field["mean"], expected[i], 4.5 * double(field["se"]));
    EXPECT_GT(field["se"], 0.0);
    EXPECT_LT(field["se"], 0.01);
    ASSERT_EQ(field["columns"].size(), 1u);
    EXPECT_NEAR(field["columns"][0], field["mean"], 1e-12);
  }
  ASSERT_EQ(all["radiance"].size(), 2u);
  EXPECT_EQ(all["radiance"][1]["zenith"], 140.0);
  EXPECT_FALSE(all.contains("faces"));
}

TEST_F(FluxCommand, OpenSidesTellTheFaces) {
  const json all = parsed(run("flux --raw " + path("slab.f32") +
                              " --dims 1,1,1 --voxel 1000,1000,1000 --photons 20000 --sun-zenith 45 --json"));
  double sum = double(all["A"]["mean"]);
  for (const auto& face : all["faces"].items()) sum += double(face.value()["mean"]);
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_NEAR(all["incident"]["top"], 0.5, 1e-9);
  EXPECT_NEAR(all["incident"]["x+"], 0.5, 1e-9) << "azimuth 0: the sun stands toward +x";
}

TEST_F(FluxCommand, ReadsAlbedoAndPhaseFromFiles) {
  writeFloats("albedo.f32", {0.5f});
  writeBytes(path("iso.txt"), "# isotropic\n0 1\n180 1\n");
  const std::string byFile = run(slab() + "--albedo " + path("albedo.f32") + " --json").out;
  EXPECT_EQ(byFile, run(slab() + "--albedo 0.5 --json").out);
  const json table = parsed(run(slab() + "--phase table:" + path("iso.txt") + " --json"));
  const json formula = parsed(run(slab() + "--phase hg:0 --json"));
  EXPECT_NEAR(table["R"]["mean"], formula["R"]["mean"], 5.0 * double(formula["R"]["se"]));
  EXPECT_NE(run(slab() + "--phase draine:10").out.find("R  "), std::string::npos);
}

TEST_F(FluxCommand, ReadsOpenVdb) {
  if (!hasOpenVdb()) GTEST_SKIP() << "built without OpenVDB";
  VoxelGrid grid({2, 1, 1}, {8000.0, 0.0, 0.0}, glm::dvec3(1000.0));
  for (int x = 0; x < 2; ++x) grid.set({x, 0, 0}, 0.5f);
  saveVdb(path("slab.vdb"), grid, std::vector<VolumeNote>{{"extinction_per_metre_at_1", 0.004}}, VolumePrecision::full);
  const json vdb = parsed(run("flux --grid " + path("slab.vdb") + " --periodic xy --photons 20000 --json"));
  const json raw = parsed(run(slab() + "--json"));
  EXPECT_EQ(vdb["dims"], json({2, 1, 1}));
  EXPECT_NEAR(vdb["R"]["mean"], raw["R"]["mean"], 5.0 * double(raw["R"]["se"]));
}

TEST_F(FluxCommand, SameBitsOnAnyNumberOfThreads) {
  if (std::system("taskset -c 0 true 2>/dev/null") != 0) GTEST_SKIP() << "no taskset here";
  const std::string line = slab() + "--view 30,0 --albedo 0.99 --json";
  EXPECT_EQ(run(line).out, run(line, "taskset -c 0").out);
  EXPECT_NE(run(line).out, run(line + " --seed 2").out);
}

TEST_F(FluxCommand, BadOptionsAreUsageErrors) {
  for (const char* option :
       {"--albedo 1.5", "--albedo -0.1", "--albedo nan", "--phase hg:1", "--phase hg:", "--phase mie",
        "--phase draine:99", "--phase table:", "--sun-zenith 90", "--surface-albedo 2", "--photons 1", "--photons 2.5",
        "--photons many", "--view 90,0", "--view 10", "--view 1,2,3", "--periodic z", "--sun moon", "--grid x.vdb"}) {
    const Outcome o = run(slab() + option);
    EXPECT_EQ(o.code, 2) << option << ": " << o.err;
    EXPECT_EQ(o.out, "") << option;
    EXPECT_NE(o.err, "") << option;
  }
  const std::string raw = "flux --raw " + path("slab.f32");
  for (const char* layout : {" --dims 1,1 --voxel 1,1,1", " --dims 0,1,1 --voxel 1,1,1", " --dims 1,1,1 --voxel 1,1,0",
                             " --dims 1.5,1,1 --voxel 1,1,1", " --dims 1,1,1e12 --voxel 1,1,1"})
    EXPECT_EQ(run(raw + layout).code, 2) << layout;
  EXPECT_EQ(run("flux").code, 2);
}

TEST_F(FluxCommand, BadFilesAreBadInput) {
  writeFloats("negative.f32", {-1.0f});
  writeFloats("bright.f32", {1.5f});
  writeBytes(path("bad.txt"), "0 1\n180 x\n");
  const std::string layout = " --dims 1,1,1 --voxel 1,1,1";
  for (const std::string& line :
       {"flux --raw " + path("missing.f32") + layout, "flux --raw " + path("negative.f32") + layout,
        "flux --raw " + path("slab.f32") + " --dims 2,1,1 --voxel 1,1,1", "flux --raw " + path("slab.f32"),
        "flux --grid " + path("slab.f32"), slab() + "--albedo " + path("bright.f32"),
        slab() + "--phase table:" + path("bad.txt"), slab() + "--phase table:" + path("missing.txt")}) {
    const Outcome o = run(line);
    EXPECT_TRUE(o.code == 3 || (!hasOpenVdb() && o.code == 1)) << line << ": " << o.code << " " << o.err;
    EXPECT_NE(o.err.find(path("")), std::string::npos) << "names the file: " << o.err;
  }
}

}  // namespace
}  // namespace welkin
