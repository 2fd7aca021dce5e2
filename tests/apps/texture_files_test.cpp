// welkin noise and welkin weather: pictures and raw volumes hold what the library bakes.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/io/png.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;

class TextureFiles : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<float> floats(const std::string& name) const {
    const std::string bytes = test::slurp(path(name));
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
  }
  void expectUsage(const std::string& arguments, const std::string& message) const {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_NE(o.err.find(message), std::string::npos) << arguments << ": " << o.err;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("welkin_textures_" + std::to_string(getpid()));
};

TEST_F(TextureFiles, NoiseAsRawFloats) {
  const Outcome o = run("noise detail -o " + path("d.f32"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out.rfind("detail: 32 x 32 x 32, 3 channels\n", 0), 0u) << o.out;
  const json header = json::parse(test::slurp(path("d.f32.json")));
  EXPECT_EQ(header["width"], 32);
  EXPECT_EQ(header["depth"], 32);
  EXPECT_EQ(header["channels"], 3);
  EXPECT_EQ(floats("d.f32"), bakeDetail({}).texels);
}

TEST_F(TextureFiles, BothRoutesAgree) {
  for (const char* texture : {"base_shape", "detail", "curl", "profile_base", "profile_detail", "profile_warp"}) {
    const std::string line = std::string("noise ") + texture +
                             " --set noise.base_shape.size=16 --set noise.profile.base_size=16 "
                             "--set noise.profile.detail_size=16 --raw -o ";
    ASSERT_EQ(run(line + path("cpu.bin")).code, 0) << texture;
    ASSERT_EQ(run(line + path("gpu.bin") + " --route gpu").code, 0) << texture;
    const std::vector<float> cpu = floats("cpu.bin"), gpu = floats("gpu.bin");
    ASSERT_EQ(cpu.size(), gpu.size()) << texture;
    for (std::size_t i = 0; i < cpu.size(); ++i) ASSERT_NEAR(cpu[i], gpu[i], 1.5e-3f) << texture;
  }
}

TEST_F(TextureFiles, NoiseAsPictures) {
  const Volume detail = bakeDetail({});
  ASSERT_EQ(run("noise detail --slice 5 --channel g -o " + path("s.png")).code, 0);
  const Image slice = loadPng(path("s.png"));
  ASSERT_EQ(slice.width, 32);
  ASSERT_EQ(slice.channels, 1);
  EXPECT_NEAR(*slice.at(7, 31 - 9), detail.at(7, 9, 5)[1], 2e-5f);

  ASSERT_EQ(run("noise detail --atlas -o " + path("a.png")).code, 0);
  const Image atlas = loadPng(path("a.png"));
  ASSERT_EQ(atlas.width, 6 * 32);
  ASSERT_EQ(atlas.height, 6 * 32);
  ASSERT_EQ(atlas.channels, 3);
  EXPECT_NEAR(atlas.at(1 * 32 + 7, 1 * 32 + 31 - 9)[2], detail.at(7, 9, 7)[2], 2e-5f);

  ASSERT_EQ(run("noise curl -o " + path("c.png")).code, 0);
  const Image curl = loadPng(path("c.png"));
  EXPECT_NEAR(curl.at(3, 127)[0], std::clamp(0.5f + 0.5f * bakeCurl({}).at(3, 0, 0)[0], 0.0f, 1.0f), 2e-5f);
}

TEST_F(TextureFiles, NoiseIsThatOfTheSky) {
  ASSERT_EQ(run("noise detail cumulus --set noise.detail.seed=9 --set noise.detail.size=16 -o " + path("d.f32")).code,
            0);
  EXPECT_EQ(floats("d.f32"), bakeDetail({.size = 16, .seed = 9}).texels);
}

TEST_F(TextureFiles, WeatherAsRawFloats) {
  const Outcome o = run("weather -o " + path("w.f32") +
                        " --edge 9000 --size 40 --centre 1500,-700 --time 60 --seed 4 --set wind.speed=10 --set "
                        "wind.from=90");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("225 m a texel"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("channels height, shift, anvil, precipitation"), std::string::npos) << o.out;
  const json header = json::parse(test::slurp(path("w.f32.json")));
  EXPECT_EQ(header["width"], 40);
  EXPECT_EQ(header["height"], 40);
  EXPECT_EQ(header["channels"], 4);
  const float east = static_cast<float>(90.0 * (3.14159265358979323846 / 180.0));
  EXPECT_EQ(floats("w.f32"), bakeWeather(Layer{}, {1500.0, -700.0}, 9000.0, 40, {10.0f, east, 60.0}, 4).texels);
}

TEST_F(TextureFiles, WeatherAsPictures) {
  const Outcome o = run("weather -o " + path("w.png") + " --size 50");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("height: black is 0 m, white "), std::string::npos) << o.out;
  const Image picture = loadPng(path("w.png"));
  ASSERT_EQ(picture.width, 50);
  ASSERT_EQ(picture.channels, 1);
  const Layer layer;
  const Volume weather = bakeWeather(layer, {0.0, 0.0}, 60000.0, 50, {8.0f, 4.7124f, 0.0}, 1);
  float highest = 0.0f;
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) {
      const float share = weather.at(x, 49 - y, 0)[0] / (shellOf(layer).top - layer.cloud.base);
      EXPECT_NEAR(*picture.at(x, y), std::min(share, 1.0f), 1e-4f);
      highest = std::max(highest, share);
    }
  EXPECT_GT(highest, 0.1f);
  const Outcome nubis = run("weather -o " + path("n.png") + " --size 20 --channel type --set layer.shape=nubis");
  EXPECT_EQ(nubis.code, 0) << nubis.err;
  EXPECT_NE(nubis.out.find("type: black is 0, white 1"), std::string::npos) << nubis.out;
}

// A picture that the sky names is what the weather shows.
TEST_F(TextureFiles, WeatherFollowsAPicture) {
  const std::vector<std::uint16_t> samples{0, 65535, 0, 65535};  // cloud in the east
  savePng16(path("map.png"), 2, 2, 1, samples);
  const std::string line =
      "weather --size 64 --edge 40000 --set layer.shape=nubis --set layer.weather.map_size=40000 "
      "--set layer.weather.map=" +
      path("map.png") + " -o " + path("w.png");
  const Outcome o = run(line);
  ASSERT_EQ(o.code, 0) << o.err;
  const Image picture = loadPng(path("w.png"));
  EXPECT_LT(*picture.at(16, 32), 0.05f);
  EXPECT_GT(*picture.at(48, 32), 0.95f);
}

TEST_F(TextureFiles, WrongUseEndsWith2) {
  expectUsage("noise", "texture is required");
  expectUsage("noise nosuch -o " + path("a.png"), "nosuch");
  expectUsage("noise detail", "--output is required");
  expectUsage("noise detail -o " + path("a.jpg"), "name the file .png for a picture or .f32 for raw floats");
  expectUsage("noise detail --raw -o " + path("a.png"), "raw floats are not a picture");
  expectUsage("noise detail --slice 32 -o " + path("a.png"), "--slice 32: detail has slices 0 to 31");
  expectUsage("noise detail --slice 3 --atlas -o " + path("a.png"), "excludes");
  expectUsage("noise detail --channel a -o " + path("a.png"), "--channel a: detail has 3 channels");
  expectUsage("noise detail --channel r -o " + path("a.f32"), "raw files hold the whole texture");
  expectUsage("noise detail --route tpu -o " + path("a.png"), "tpu");
  expectUsage("weather --layer 3 -o " + path("a.png"), "--layer 3: this sky has layers 0 to 0");
  expectUsage("weather --centre 3 -o " + path("a.png"), "--centre 3: write east,north");
  expectUsage("weather --channel coverage -o " + path("a.png"), "this layer's weather has height, shift");
  expectUsage("weather --size 0 -o " + path("a.png"), "--size");
  expectUsage("weather cirrus -o " + path("a.png"), "this sky has no layers");
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(TextureFiles, BadInputEndsWith3AndNoOpenGlWith4) {
  EXPECT_EQ(run("noise detail no_such.sky.toml -o " + path("a.png")).code, 3);
  EXPECT_EQ(run("weather no_such.sky.toml -o " + path("a.png")).code, 3);
  std::ofstream(path("mine.sky.toml")) << "format = 1\n[[layer]]\n[layer.weather]\nmap = \"no_such.png\"\n";
  EXPECT_EQ(run("weather " + path("mine.sky.toml") + " -o " + path("a.png")).code, 3);
  EXPECT_EQ(run("noise detail -o /no/such/folder/a.png").code, 1);
  const std::string bare = "__EGL_VENDOR_LIBRARY_FILENAMES=/no/such.json";
  EXPECT_EQ(run("noise detail --route gpu -o " + path("a.png"), bare).code, 4);
  EXPECT_EQ(run("noise detail -o " + path("a.png"), bare).code, 0);
}

}  // namespace
}  // namespace welkin
