// `welkin hdri`, from outside: small pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/atmosphere/tables.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/hdr.hpp"
#include "welkin/io/vdb.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/scene/environment.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::run;

// A sun that no cloud hides, away from every target's centre.
constexpr const char* kSun = " --set sun.elevation=30 --set sun.azimuth=130";
constexpr double kSunHeading = 130.0, kSunElevation = 30.0;

class Hdri : public testing::Test {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("hdri_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  Hdri() { std::filesystem::create_directories(folder_); }
  ~Hdri() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void render(const std::string& name, const std::string& arguments) const {
    const Outcome o = run("hdri -q --frames 1 -o " + file(name) + kSun + " " + arguments);
    ASSERT_EQ(o.code, 0) << o.err;
    ASSERT_TRUE(std::filesystem::exists(file(name)));
  }
  nlohmann::json sidecar(const std::string& name) const {
    return nlohmann::json::parse(test::slurp(file(name) + ".json"));
  }
};

EnvironmentPixels pixelsOf(const Image& image, EnvironmentLayout layout, double centerDegrees) {
  return {environmentCameras(Camera{}, layout, centerDegrees * kPi / 180.0), image.width};
}

double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// klx on a plane facing up: the map's and the sidecar's.
double upward(const Image& image, EnvironmentLayout layout, double center, const nlohmann::json& side) {
  double sum = luminance(upwardIrradiance(image, pixelsOf(image, layout, center)));
  for (const auto& light : side["lights"])
    sum += light["illuminance"].get<double>() / 1000.0 * std::sin(light["elevation"].get<double>() * kPi / 180.0);
  return sum;
}

// Where the sun's pixel must be: centre headings after the documentation of each program (docs/hdri.md).
TEST_F(Hdri, EveryTargetHasTheSunWhereItExpectsIt) {
  for (const auto& [target, center] :
       {std::pair("", 0.0), std::pair("--target blender", 90.0), std::pair("--target usd", 180.0),
        std::pair("--target three", 90.0), std::pair("--target unreal", 0.0),
        std::pair("--target usd --center-heading 45", 45.0)}) {
    render("a.exr", std::string("--no-clouds --size 256 ") + target);
    const Image image = loadExr(file("a.exr"));
    ASSERT_EQ(image.width, 256);
    ASSERT_EQ(image.height, 128);
    const auto at =
        static_cast<int>(std::max_element(image.pixels.begin(), image.pixels.end()) - image.pixels.begin()) / 3;
    double u = std::fmod(0.5 + (kSunHeading - center) / 360.0 + 1.0, 1.0);
    EXPECT_NEAR(at % 256 + 0.5, u * 256, 1.01) << target;
    EXPECT_NEAR(at / 256 + 0.5, (0.5 - kSunElevation / 180.0) * 128, 1.01) << target;
    EXPECT_EQ(sidecar("a.exr")["center_heading"], center);
  }
}

// The sidecar's directions are in the target's axes: toward the sun, east is 130 degrees' sine.
TEST_F(Hdri, LightsAreGivenInTheTargetsAxes) {
  const double e = kSunElevation * kPi / 180, h = kSunHeading * kPi / 180;
  const double east = std::sin(h) * std::cos(e), north = std::cos(h) * std::cos(e), up = std::sin(e);
  const std::vector<std::pair<std::string, std::array<double, 3>>> cases{{"blender", {east, north, up}},
                                                                         {"usd", {east, up, -north}},
                                                                         {"three", {east, up, -north}},
                                                                         {"unreal", {east, -north, up}}};
  for (const auto& [target, direction] : cases) {
    render("a.hdr", "--no-clouds --size 64 --sun none --target " + target);
    const auto light = sidecar("a.hdr")["lights"].at(0);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(light["direction"][k].get<double>(), direction[k], 1e-5) << target;
    EXPECT_NEAR(light["angular_diameter"].get<double>(), 0.533, 1e-6);
    EXPECT_NEAR(light["azimuth"].get<double>(), kSunHeading, 1e-3);
  }
}

// Against the sky's radiance by 500 steps a ray and the sun's light, without any picture.
TEST_F(Hdri, ClearSkyAndSunLightAPlaneAsTheAtmosphereDoes) {
  Scene scene;
  scene.sun.elevation = static_cast<float>(kSunElevation * kPi / 180);
  scene.sun.azimuth = static_cast<float>(kSunHeading * kPi / 180);
  const SkyTablesCpu sky = bakeSky(scene.atmosphere, scene.sun, scene.camera.position.z, scene.ground.albedo);
  glm::dvec3 direct = glm::dvec3(sky.light.sunIrradiance) * std::sin(kSunElevation * kPi / 180);
  const EnvironmentPixels fine(environmentCameras(scene.camera, EnvironmentLayout::latlong, 0.0), 128);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 128; ++x) {
      const glm::dvec3 d = fine.direction(x + 0.5, y + 0.5);
      direct += glm::dvec3(computeSkyRadiance(sky.params, sky.air, glm::vec3(d))) * (d.z * fine.solidAngle(x, y));
    }
  for (const std::string style : {"full", "soft", "clamp=30", "none"}) {
    render("a.exr", "--no-clouds --size 512 --sun " + style);
    const double map = upward(loadExr(file("a.exr")), EnvironmentLayout::latlong, 0.0, sidecar("a.exr"));
    EXPECT_NEAR(map / luminance(direct), 1.0, 0.01) << style;
    EXPECT_NEAR(sidecar("a.exr")["upward_illuminance"].get<double>() / (1000.0 * map), 1.0, 1e-3) << style;
  }
}

// With clouds: the six perspective pictures of a cube hold the same light as the equirectangular one.
TEST_F(Hdri, CubeAndLatlongLightAPlaneAlike) {
  const std::string sky = "fair_weather --set camera.position=0,0,3500 --quality low --sun soft ";
  render("a.exr", sky + "--size 256");
  render("b.exr", sky + "--size 256 --faces cube");
  const Image cube = loadExr(file("b.exr"));
  ASSERT_EQ(cube.width, 64);
  ASSERT_EQ(cube.height, 6 * 64);
  const double a = upward(loadExr(file("a.exr")), EnvironmentLayout::latlong, 0.0, sidecar("a.exr"));
  const double b = upward(cube, EnvironmentLayout::cube, 0.0, sidecar("b.exr"));
  EXPECT_NEAR(a / b, 1.0, 0.01);
}

TEST_F(Hdri, TwoRunsGiveTheSameBytes) {
  for (const std::string name : {"a.exr", "a.hdr"}) {
    render(name, "--size 64 --quality low");
    const std::string picture = test::slurp(file(name)), beside = test::slurp(file(name) + ".json");
    render(name, "--size 64 --quality low");
    EXPECT_EQ(test::slurp(file(name)), picture);
    EXPECT_EQ(test::slurp(file(name) + ".json"), beside);
  }
}

TEST_F(Hdri, HalfFloatsNeverOverflow) {
  for (const std::string style : {"soft", "clamp=60000", "none"}) {
    render("a.exr", "--no-clouds --size 128 --sun " + style);
    for (const float v : loadExr(file("a.exr")).pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 65504.0f);
  }
  render("a.exr", "--no-clouds --size 2048");
  const Image full = loadExr(file("a.exr"));
  EXPECT_GT(*std::max_element(full.pixels.begin(), full.pixels.end()), 65504.0f);
}

TEST_F(Hdri, WrongUseIsExplained) {
  const auto refused = [](const std::string& arguments, const std::string& why) {
    const Outcome o = run("hdri " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
  };
  refused("", "--output is required");
  refused("-o a.png", "ends in .exr or .hdr");
  refused("-o a.exr --format hdr", "has another ending");
  refused("-o a.exr --size 1001", "multiple of 4");
  refused("-o a.exr --sun clamp", "write full, soft, none or clamp=V");
  refused("-o a.exr --sun clamp=-1", "write full, soft, none or clamp=V");
  refused("-o a.exr --target maya", "--target");
  EXPECT_EQ(run("hdri -o /nowhere/a.exr").code, 1);
}

// Layers, sheets and voxel grids: what is left is the sky that never had any, in both renderers.
TEST_F(Hdri, NoCloudsLeavesTheClearSky) {
  if (!hasOpenVdb()) GTEST_SKIP() << "built without OpenVDB (Debian: libopenvdb-dev)";
  // A slab all over the sky, 1 to 2 km up.
  VoxelGrid slab({8, 8, 2}, {-20000.0, -20000.0, 1000.0}, {5000.0, 5000.0, 500.0});
  for (int i = 0; i < 128; ++i) slab.set({i % 8, i / 8 % 8, i / 64}, 1.0f);
  saveVdb(file("slab.vdb"), slab, {}, VolumePrecision::full);
  const std::string grid = "[[grid]]\nfile = \"slab.vdb\"\nextinction = 0.01\n";
  std::ofstream(file("clear.sky.toml")) << "format = 1\nlayer = []\n";
  std::ofstream(file("grid.sky.toml")) << "format = 1\nlayer = []\n" << grid;
  std::ofstream(file("all.sky.toml")) << "format = 1\n[[layer]]\n[[sheet]]\n" << grid;
  for (const std::string renderer : {"realtime", "path --samples 4 --air tables"}) {
    const auto picture = [&](const std::string& sky, const std::string& options) {
      render("a.exr", file(sky + ".sky.toml") + " --size 64 --renderer " + renderer + options);
      return test::slurp(file("a.exr"));
    };
    const std::string clear = picture("clear", "");
    EXPECT_FALSE(picture("grid", "") == clear) << renderer << ": the slab does not show, so this tests nothing";
    EXPECT_TRUE(picture("grid", " --no-clouds") == clear) << renderer;
    EXPECT_TRUE(picture("all", " --no-clouds") == clear) << renderer;
  }
}

}  // namespace
}  // namespace welkin
