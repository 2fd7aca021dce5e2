#include <gtest/gtest.h>

#include <ImfArray.h>
#include <ImfEnvmap.h>
#include <ImfFloatAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "welkin/base/error.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/raw_volume.hpp"
#include "welkin/scene/environment.hpp"

namespace welkin {
namespace {

class Pictures : public testing::Test {
 protected:
  Pictures() { std::filesystem::create_directories(folder_); }
  ~Pictures() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("welkin_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

std::vector<std::uint8_t> bytes(std::size_t count) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> v(count);
  for (auto& b : v) b = static_cast<std::uint8_t>(random());
  return v;
}

TEST_F(Pictures, PngOfEveryChannelCountIsReadByLibpngItself) {
  const png_uint_32 formats[] = {PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
  for (int channels = 1; channels <= 4; ++channels) {
    const auto samples = bytes(static_cast<std::size_t>(7) * 5 * channels);
    savePng(file("a.png"), 7, 5, channels, samples);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&image, file("a.png").c_str()));
    EXPECT_EQ(image.format, formats[channels - 1]);
    ASSERT_EQ(image.width, 7u);
    ASSERT_EQ(image.height, 5u);
    std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(image));
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, back.data(), 0, nullptr));
    EXPECT_EQ(back, samples) << channels;

    const Image ours = loadPng(file("a.png"));
    ASSERT_EQ(ours.channels, channels);
    for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(ours.pixels[i], static_cast<float>(samples[i]) / 255.0f);
  }
}

TEST_F(Pictures, Png16KeepsItsBits) {
  const std::vector<std::uint16_t> samples{0, 1, 256, 257, 65534, 65535};
  savePng16(file("a.png"), 3, 2, 1, samples);
  const Image image = loadPng(file("a.png"));
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_EQ(image.pixels[i], static_cast<float>(samples[i]) / 65535.0f);
}

// Weather maps from paint programs may have a palette.
TEST_F(Pictures, PngPaletteIsExpanded) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = 2;
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = 2;
  const std::uint8_t indices[] = {0, 1, 1, 0}, colours[] = {255, 0, 0, 0, 0, 255};
  ASSERT_TRUE(png_image_write_to_file(&image, file("p.png").c_str(), 0, indices, 0, colours));
  const Image read = loadPng(file("p.png"));
  ASSERT_EQ(read.channels, 3);
  EXPECT_EQ(read.at(0, 0)[0], 1.0f);
  EXPECT_EQ(read.at(1, 0)[2], 1.0f);
}

TEST_F(Pictures, EveryTruncationOfAPngIsRefused) {
  savePng(file("a.png"), 9, 4, 3, bytes(108));
  const std::string whole = readFile(file("a.png"), 1 << 20);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      parsePng(std::string_view(whole).substr(0, length), "cut.png");
      ADD_FAILURE() << "accepted at " << length << " of " << whole.size();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::badInput);
      EXPECT_EQ(std::string(e.what()).rfind("cut.png: is not a PNG that can be read: ", 0), 0u);
    }
  }
  EXPECT_NO_THROW(parsePng(whole, "whole.png"));
}

TEST_F(Pictures, SpoiltPngsAreRefusedOrReadButNeverCrash) {
  savePng(file("a.png"), 9, 4, 3, bytes(108));
  const std::string whole = readFile(file("a.png"), 1 << 20);
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string spoilt = whole;
    for (unsigned k = 1 + random() % 3; k > 0; --k) spoilt[random() % spoilt.size()] = static_cast<char>(random());
    try {
      parsePng(spoilt, "spoilt.png");
    } catch (const Error& e) {
      ASSERT_EQ(e.kind(), ErrorKind::badInput);
      ++refused;
    }
  }
  EXPECT_GT(refused, 2500);
}

TEST_F(Pictures, ExrIsReadByOpenExrItself) {
  Image image(6, 3, 3);
  std::mt19937 random(4);
  for (float& v : image.pixels)
    v = std::ldexp(static_cast<float>(random() % 1024), static_cast<int>(random() % 16) - 12);
  for (const ExrPrecision precision : {ExrPrecision::half, ExrPrecision::full}) {
    saveExr(file("a.exr"), image, precision);
    Imf::RgbaInputFile rgba(file("a.exr").c_str());
    EXPECT_EQ(rgba.compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(Imf::whiteLuminance(rgba.header()), 1000.0f);
    Imf::Array2D<Imf::Rgba> pixels(3, 6);
    rgba.setFrameBuffer(&pixels[0][0], 1, 6);
    rgba.readPixels(0, 2);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 6; ++x) {
        EXPECT_NEAR(static_cast<float>(pixels[y][x].r), image.at(x, y)[0], image.at(x, y)[0] * 1e-3);
        EXPECT_NEAR(static_cast<float>(pixels[y][x].b), image.at(x, y)[2], image.at(x, y)[2] * 1e-3);
      }
  }
  EXPECT_EQ(loadExr(file("a.exr")).pixels, image.pixels);
}

TEST_F(Pictures, ExrKeepsAlphaAndGrey) {
  for (const int channels : {1, 4}) {
    Image image(5, 2, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i) * 1e5f;
    saveExr(file("a.exr"), image, ExrPrecision::full);
    const Image back = loadExr(file("a.exr"));
    EXPECT_EQ(back.channels, channels);
    EXPECT_EQ(back.pixels, image.pixels);
  }
}

TEST_F(Pictures, FeaturesGoWithThePicture) {
  Image image(4, 2, 3);
  saveExr(file("a.exr"), image, ExrPrecision::half);
  EXPECT_EQ(loadExr(file("a.exr")).features, "");
  image.features = "clouds,lightning";
  saveExr(file("a.exr"), image, ExrPrecision::half);
  EXPECT_EQ(loadExr(file("a.exr")).features, "clouds,lightning");
  savePng(file("a.png"), 4, 2, 3, bytes(24), image.features);
  EXPECT_EQ(loadPng(file("a.png")).features, "clouds,lightning");
}

TEST_F(Pictures, ExrStatesWhereAndWhen) {
  saveExr(file("a.exr"), Image(4, 2, 3), ExrPrecision::half,
          {.environment = ExrEnvironment::latlong,
           .captureDate = "2026:06:21 12:00:00",
           .utcOffset = 7200.0,
           .placed = true,
           .latitude = 48.5,
           .longitude = -9.25,
           .numbers = {{"centerHeading", 90.0}}});
  const Imf::RgbaInputFile exr(file("a.exr").c_str());
  EXPECT_EQ(Imf::envmap(exr.header()), Imf::ENVMAP_LATLONG);
  EXPECT_EQ(Imf::capDate(exr.header()), "2026:06:21 12:00:00");
  EXPECT_EQ(Imf::utcOffset(exr.header()), -7200.0f);  // local time + utcOffset = universal time
  EXPECT_EQ(Imf::latitude(exr.header()), 48.5f);
  EXPECT_EQ(Imf::longitude(exr.header()), -9.25f);
  EXPECT_EQ(Imf::wrapmodes(exr.header()), "periodic,clamp");
  EXPECT_EQ(exr.header().typedAttribute<Imf::FloatAttribute>("welkin:centerHeading").value(), 90.0f);
}

// OpenEXR's own map of an environment's pixels, whose outermost ones lie on the very edge of the picture or face. Its
// axes in ours: +Z the centre's heading, here north, +X west, +Y up.
TEST_F(Pictures, EnvironmentsLieAsOpenExrReadsThem) {
  const auto world = [](const Imath::V3f& d) { return glm::dvec3(-d.x, d.z, d.y) / static_cast<double>(d.length()); };
  constexpr int kSide = 9;
  const EnvironmentPixels cube(environmentCameras(Camera{}, EnvironmentLayout::cube, 0.0), kSide);
  const Imath::Box2i faces(Imath::V2i(0, 0), Imath::V2i(kSide - 1, 6 * kSide - 1));
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const auto f = static_cast<Imf::CubeMapFace>(face);
        const Imath::V2f in(static_cast<float>(i), static_cast<float>(j));
        const Imath::V2f at = Imf::CubeMap::pixelPosition(f, faces, in);
        const glm::dvec3 theirs = world(Imf::CubeMap::direction(f, faces, in));
        // From pixel centres on the edges to pixel centres half a pixel inside.
        const double x = static_cast<double>(at.x) / (kSide - 1) * kSide;
        const double y = (static_cast<double>(at.y) - face * kSide) / (kSide - 1);
        const glm::dvec3 ours = cube.direction(x, face * kSide + std::clamp(y, 1e-6, 1.0 - 1e-6) * kSide);
        ASSERT_LT(glm::distance(ours, theirs), 1e-5) << face << " " << i << " " << j;
      }
  const EnvironmentPixels latlong(environmentCameras(Camera{}, EnvironmentLayout::latlong, 0.0), 20);
  const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(20, 10));
  for (float y = 0; y <= 10; ++y)
    for (float x = 0; x <= 20; ++x)
      ASSERT_LT(glm::distance(latlong.direction(x, y), world(Imf::LatLongMap::direction(window, {x, y}))), 1e-5);
}

// A sun does not fit in half precision; it must not turn into infinity unnoticed.
TEST_F(Pictures, ExrRefusesWhatItWouldSpoil) {
  Image image(2, 1, 3);
  image.pixels[4] = 1.6e6f;
  EXPECT_THROW(saveExr(file("a.exr"), image, ExrPrecision::half), Error);
  EXPECT_NO_THROW(saveExr(file("a.exr"), image, ExrPrecision::full));
  image.pixels[4] = std::nanf("");
  try {
    saveExr(file("b.exr"), image, ExrPrecision::full);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("pixel 1, 0"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(std::filesystem::exists(file("b.exr")));
}

TEST_F(Pictures, EveryTruncationOfAnExrIsRefused) {
  saveExr(file("a.exr"), Image(8, 40, 3), ExrPrecision::half);
  const std::string whole = readFile(file("a.exr"), 1 << 20);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeBytes(file("cut.exr"), std::string_view(whole).substr(0, length));
    try {
      loadExr(file("cut.exr"));
      ADD_FAILURE() << "accepted at " << length << " of " << whole.size();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::badInput);
    }
  }
}

TEST_F(Pictures, RawVolumesSayWhatTheyHold) {
  const std::vector<float> values{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  saveRawVolume(file("v.f32"), 2, 3, 1, 2, values);
  const std::string raw = readFile(file("v.f32"), 1 << 20);
  ASSERT_EQ(raw.size(), 48u);
  EXPECT_EQ(std::memcmp(raw.data(), values.data(), 48), 0);
  const auto header = nlohmann::json::parse(readFile(file("v.f32.json"), 1 << 20));
  EXPECT_EQ(header["width"], 2);
  EXPECT_EQ(header["height"], 3);
  EXPECT_EQ(header["depth"], 1);
  EXPECT_EQ(header["channels"], 2);
  EXPECT_THROW(saveRawVolume(file("w.f32"), 2, 3, 1, 1, values), Error);
}

}  // namespace
}  // namespace welkin
