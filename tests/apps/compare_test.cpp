// `welkin compare`, from outside.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/hdr.hpp"
#include "welkin/io/png.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::run;

class Compare : public testing::Test {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("compare_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  Compare() { std::filesystem::create_directories(folder_); }
  ~Compare() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  nlohmann::json json(const std::string& arguments) const {
    const Outcome o = run("compare --json " + arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? nlohmann::json::parse(o.out) : nlohmann::json();
  }
};

Image ramp(float scale) {
  Image image(48, 32, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x)
      for (int k = 0; k < 3; ++k) image.at(x, y)[k] = scale * static_cast<float>(1 + x + 2 * k) * 0.1f;
  return image;
}

TEST_F(Compare, APictureIsNoFurtherFromItselfThanNothing) {
  saveExr(file("a.exr"), ramp(1.0f), ExrPrecision::full);
  const auto j = json(file("a.exr") + " " + file("a.exr"));
  EXPECT_EQ(j["identical"], true);
  EXPECT_TRUE(j["psnr"].is_null());  // infinite
  EXPECT_EQ(j["rel_mse"], 0.0);
  EXPECT_EQ(j["flip"], 0.0);
  EXPECT_EQ(j["luminance_ratio"], 1.0);
}

TEST_F(Compare, TheSecondIsJudgedByTheFirst) {
  saveExr(file("a.exr"), ramp(1.0f), ExrPrecision::full);
  saveHdr(file("b.hdr"), ramp(2.0f));
  const auto j = json(file("a.exr") + " " + file("b.hdr") + " -o " + file("d.png"));
  EXPECT_NEAR(j["luminance_ratio"].get<double>(), 2.0, 0.01);
  EXPECT_GT(j["rel_mse"].get<double>(), 0.9);  // (2a - a)^2 / (a^2 + epsilon)
  EXPECT_LT(j["rel_mse"].get<double>(), 1.01);
  EXPECT_GT(j["flip"].get<double>(), 0.05);
  EXPECT_LT(j["psnr"].get<double>(), 30.0);
  const Image map = loadPng(file("d.png"));
  EXPECT_EQ(map.width, 48);
  EXPECT_EQ(map.channels, 3);
}

// Two stops brighter, a display shows white and white.
TEST_F(Compare, ExposureDecidesWhatIsSeen) {
  saveExr(file("a.exr"), ramp(1.0f), ExrPrecision::full);
  saveExr(file("b.exr"), ramp(1.2f), ExrPrecision::full);
  const std::string both = file("a.exr") + " " + file("b.exr");
  const auto metered = json(both), white = json(both + " --exposure -10");
  EXPECT_LT(white["flip"].get<double>(), 0.01);
  EXPECT_GT(metered["flip"].get<double>(), 0.02);
  EXPECT_EQ(white["rel_mse"], metered["rel_mse"]);
  EXPECT_EQ(white["ev"], -10.0);
  EXPECT_GT(json(both + " --ppd 20")["flip"].get<double>(), 0.0);
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  saveExr(file("a.exr"), ramp(1.0f), ExrPrecision::full);
  saveExr(file("small.exr"), Image(4, 4, 3), ExrPrecision::full);
  savePng(file("a.png"), 48, 32, 3, std::vector<std::uint8_t>(48 * 32 * 3, 9));
  const auto refused = [&](const std::string& arguments, int code, const std::string& why) {
    const Outcome o = run("compare " + arguments);
    EXPECT_EQ(o.code, code) << arguments;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
  };
  refused(file("a.exr") + " " + file("small.exr"), 3, "is 4 x 4 pixels");
  refused(file("a.exr") + " " + file("a.png"), 3, "tone-mapped");
  refused(file("a.exr") + " " + file("no.exr"), 3, "no.exr");
  refused(file("a.exr") + " " + file("a.tif"), 2, ".png, .exr or .hdr");
  refused(file("a.png") + " " + file("a.png") + " --exposure 3", 2, "exposed already");
  refused(file("a.exr") + " " + file("a.exr") + " -o " + file("d.exr"), 2, "is a .png");
  refused(file("a.exr") + " " + file("a.exr") + " --ppd 0", 2, "--ppd");
}

TEST_F(Compare, NamesWhatOnlyOneOfTheTwoShows) {
  Image a = ramp(1.0f), b = a;
  a.features = "clouds,lightning";
  b.features = "clouds";
  saveExr(file("a.exr"), a, ExrPrecision::full);
  saveExr(file("b.exr"), b, ExrPrecision::full);
  for (const auto& [first, second] : {std::pair("a.exr", "b.exr"), std::pair("b.exr", "a.exr")}) {
    const Outcome o = run("compare " + file(first) + " " + file(second));
    EXPECT_EQ(o.code, 3);
    EXPECT_NE(o.err.find("b.exr: was rendered without 'lightning'"), std::string::npos) << o.err;
  }
  b.features = "";  // a picture of another program says nothing
  saveExr(file("b.exr"), b, ExrPrecision::full);
  EXPECT_EQ(run("compare " + file("a.exr") + " " + file("b.exr")).code, 0);
}

}  // namespace
}  // namespace welkin
