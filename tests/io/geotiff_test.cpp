#include "welkin/io/geotiff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {
namespace {

// A TIFF by the letter of TIFF 6.0 and OGC 19-008r4, so that libtiff reads what somebody else has written.
struct Tiff {
  struct Tag {
    std::uint16_t tag, type;
    std::uint32_t count;
    std::string bytes;
  };
  std::vector<Tag> tags;

  template <class T>
  void add(std::uint16_t tag, std::uint16_t type, const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    tags.push_back({tag, type, static_cast<std::uint32_t>(values.size()), bytes});
  }
  void shorts(std::uint16_t tag, const std::vector<std::uint16_t>& v) { add(tag, 3, v); }
  void doubles(std::uint16_t tag, const std::vector<double>& v) { add(tag, 12, v); }

  // 4 x 3 pixels: red grows to the east, green to the north.
  std::string file() const {
    std::string pixels;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 4; ++x) pixels += {static_cast<char>(60 * x), static_cast<char>(100 * (2 - y)), 7};
    Tiff all = *this;
    all.shorts(256, {4});
    all.shorts(257, {3});
    all.shorts(258, {8, 8, 8});
    all.shorts(259, {1});
    all.shorts(262, {2});
    all.add<std::uint32_t>(273, 4, {8});
    all.shorts(277, {3});
    all.shorts(278, {3});
    all.add<std::uint32_t>(279, 4, {static_cast<std::uint32_t>(pixels.size())});
    std::sort(all.tags.begin(), all.tags.end(), [](const Tag& a, const Tag& b) { return a.tag < b.tag; });
    const auto put = [](std::string& to, auto value) {
      to.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const auto directory = static_cast<std::uint32_t>(8 + pixels.size());
    std::string out = "II";
    put(out, std::uint16_t{42});
    put(out, directory);
    out += pixels;
    put(out, static_cast<std::uint16_t>(all.tags.size()));
    std::string beyond;
    const std::size_t after = directory + 2 + 12 * all.tags.size() + 4;
    for (const Tag& t : all.tags) {
      put(out, t.tag);
      put(out, t.type);
      put(out, t.count);
      if (t.bytes.size() <= 4) {
        out += t.bytes + std::string(4 - t.bytes.size(), '\0');
      } else {
        put(out, static_cast<std::uint32_t>(after + beyond.size()));
        beyond += t.bytes;
      }
    }
    put(out, std::uint32_t{0});
    return out + beyond;
  }
};

Tiff metres(double across = 50.0, double up = 40.0) {
  Tiff tiff;
  tiff.doubles(33550, {across, up, 0});
  tiff.doubles(33922, {0, 0, 0, 500000, 5400000, 0});
  tiff.shorts(34735, {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001});
  return tiff;
}

class GeoTiff : public testing::Test {
 protected:
  GeoPicture read(const std::string& bytes) {
    writeFileAtomically(path_, bytes);
    return loadGeoTiff(path_);
  }
  std::string refusal(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::badInput);
      return e.what();
    }
    return "";
  }
  void SetUp() override {
    if (refusal("").find("libtiff") != std::string::npos) GTEST_SKIP() << "built without libtiff (Debian: libtiff-dev)";
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_ = testing::TempDir() + "map.tif";
};

TEST_F(GeoTiff, SaysHowLargeItsLandIs) {
  const GeoPicture geo = read(metres().file());
  EXPECT_EQ(geo.picture.width, 4);
  EXPECT_DOUBLE_EQ(geo.size.x, 200.0);
  EXPECT_DOUBLE_EQ(geo.size.y, 120.0);
  EXPECT_FLOAT_EQ(geo.picture.at(3, 0)[0], 180.0f / 255.0f);  // the north-east corner
  EXPECT_FLOAT_EQ(geo.picture.at(3, 0)[1], 200.0f / 255.0f);
  EXPECT_FLOAT_EQ(geo.picture.at(0, 2)[1], 0.0f);
}

TEST_F(GeoTiff, DegreesBecomeMetresAtTheMiddle) {
  Tiff tiff;
  tiff.doubles(33550, {0.01, 0.01, 0});
  tiff.doubles(33922, {0, 0, 0, 11.0, 60.015, 0});  // the middle is at 60 degrees, where longitude is half as wide
  tiff.shorts(34735, {1, 1, 0, 1, 1024, 0, 1, 2});
  const GeoPicture geo = read(tiff.file());
  EXPECT_NEAR(geo.size.x, 0.04 * 111320.0 / 2.0, 0.1);
  EXPECT_NEAR(geo.size.y, 0.03 * 111132.0, 0.1);
}

TEST_F(GeoTiff, RefusesWhatIsNoMap) {
  EXPECT_NE(refusal("no picture").find("is not a TIFF that can be read"), std::string::npos);
  EXPECT_NE(refusal(Tiff{}.file()).find("does not say where on earth it is"), std::string::npos);
  Tiff turned;
  turned.doubles(34264, std::vector<double>(16, 1.0));
  EXPECT_NE(refusal(turned.file()).find("turned against north"), std::string::npos);
  EXPECT_NE(refusal(metres(1e300).file()).find("no map"), std::string::npos);
  EXPECT_NE(refusal(metres(NAN).file()), "");
  EXPECT_NE(refusal(metres(-3.0).file()), "");
  EXPECT_THROW(loadGeoTiff("no/such.tif"), Error);
}

TEST_F(GeoTiff, EveryDamageEndsInAnAnswer) {
  const std::string whole = metres().file();
  for (std::size_t n = 0; n < whole.size(); ++n) refusal(whole.substr(0, n));  // or read, where nothing is lost
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)), "");
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    std::string bytes = whole;
    for (unsigned k = 1 + random() % 4; k > 0; --k) bytes[random() % bytes.size()] = static_cast<char>(random());
    try {
      const GeoPicture geo = read(bytes);
      ASSERT_TRUE(std::isfinite(geo.size.x) && std::isfinite(geo.size.y));
    } catch (const Error& e) {
      ASSERT_EQ(e.kind(), ErrorKind::badInput);
    }
  }
}

}  // namespace
}  // namespace welkin
