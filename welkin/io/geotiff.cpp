#include "welkin/io/geotiff.hpp"

#include "welkin/base/error.hpp"

#if WELKIN_HAS_TIFF
#include <fmt/format.h>
#include <tiffio.h>

#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace welkin {

namespace {

constexpr std::uint32_t kMostSide = 16384;
constexpr std::uint64_t kMostPixels = 1ull << 26;
constexpr std::uint64_t kMostBytes = kMostPixels * 4;

// Tags and keys of OGC 19-008r4, annexes A and B.
constexpr std::uint32_t kPixelScaleTag = 33550, kTiepointTag = 33922, kTransformationTag = 34264, kKeysTag = 34735;
constexpr std::uint16_t kModelTypeKey = 1024, kProjectedUnitKey = 3076;
constexpr std::uint16_t kGeographic = 2, kMetre = 9001, kFoot = 9002, kSurveyFoot = 9003;
constexpr double kMetresOfLatitude = 111132.0;   // of a degree, at 45 degrees (WGS 84)
constexpr double kMetresOfLongitude = 111320.0;  // of a degree, at the equator

// What libtiff has to say is kept: the first error is the reason.
int keepMessage(TIFF* /*file*/, void* user, const char* /*module*/, const char* format, va_list arguments) {
  auto& message = *static_cast<std::string*>(user);
  if (!message.empty()) return 1;
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  message = text;
  return 1;
}
int dropMessage(TIFF* /*file*/, void* /*user*/, const char* /*module*/, const char* /*format*/, va_list /*arguments*/) {
  return 1;
}

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

class File {
 public:
  explicit File(const std::string& path) : path_(path) {
    const std::unique_ptr<TIFFOpenOptions, Close> options(TIFFOpenOptionsAlloc());
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepMessage, &message_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), dropMessage, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(kMostBytes));
    file_.reset(TIFFOpenExt(path.c_str(), "r", options.get()));
    if (!file_) fail("is not a TIFF that can be read");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::badInput, path_, message_.empty() ? what : fmt::format("{} ({})", what, message_));
  }

  // Values of a tag that libtiff knows by number alone; empty where there is none.
  template <class T>
  std::span<const T> values(std::uint32_t tag) const {
    std::uint32_t count = 0;
    void* data = nullptr;
    if (TIFFGetField(file_.get(), tag, &count, &data) != 1 || !data) return {};
    return {static_cast<const T*>(data), count};
  }

  Image picture() const {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(file_.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(file_.get(), TIFFTAG_IMAGELENGTH, &height);
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide ||
        static_cast<std::uint64_t>(width) * height > kMostPixels)
      fail(fmt::format("is {}x{} pixels; a map has at most {} a side and 2^26 in all", width, height, kMostSide));
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * height);
    if (TIFFReadRGBAImageOriented(file_.get(), width, height, pixels.data(), ORIENTATION_TOPLEFT, 1) != 1)
      fail("has a picture that cannot be read");
    Image image(static_cast<int>(width), static_cast<int>(height), 3);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      image.pixels[3 * i] = static_cast<float>(TIFFGetR(pixels[i])) / 255.0f;
      image.pixels[3 * i + 1] = static_cast<float>(TIFFGetG(pixels[i])) / 255.0f;
      image.pixels[3 * i + 2] = static_cast<float>(TIFFGetB(pixels[i])) / 255.0f;
    }
    return image;
  }

 private:
  std::string path_, message_;
  std::unique_ptr<TIFF, Close> file_;
};

// The value of a key that is kept in the directory itself.
std::optional<std::uint16_t> keyOf(std::span<const std::uint16_t> directory, std::uint16_t key) {
  for (std::size_t i = 4; i + 3 < directory.size(); i += 4)
    if (directory[i] == key && directory[i + 1] == 0) return directory[i + 3];
  return std::nullopt;
}

// The metres that a unit of the picture's grid has, east and north, at a latitude in degrees.
glm::dvec2 metresOf(const File& file, std::span<const std::uint16_t> keys, double latitude) {
  if (keyOf(keys, kModelTypeKey) == kGeographic) {
    if (!(std::abs(latitude) < 89.0)) file.fail("has its middle at a pole, where degrees have no width");
    return {kMetresOfLongitude * std::cos(latitude * std::numbers::pi / 180.0), kMetresOfLatitude};
  }
  switch (keyOf(keys, kProjectedUnitKey).value_or(kMetre)) {
    case kMetre:
      return glm::dvec2(1.0);
    case kFoot:
      return glm::dvec2(0.3048);
    case kSurveyFoot:
      return glm::dvec2(1200.0 / 3937.0);
    default:
      file.fail("is measured in a unit that is neither metre nor foot; reproject it, for example with gdalwarp");
  }
}

}  // namespace

GeoPicture loadGeoTiff(const std::string& path) {
  const File file(path);
  const std::span<const double> scale = file.values<double>(kPixelScaleTag);
  const std::span<const double> tie = file.values<double>(kTiepointTag);
  if (scale.size() < 2 || tie.size() < 6 || !(scale[0] > 0.0) || !(scale[1] > 0.0) || !std::isfinite(scale[0]) ||
      !std::isfinite(scale[1]))
    file.fail(
        file.values<double>(kTransformationTag).empty()
            ? "does not say where on earth it is (no ModelPixelScale and ModelTiepoint): give the corners of its land"
            : "is turned against north: turn it back, for example with gdalwarp, or give the corners of its land");
  GeoPicture geo{.picture = file.picture()};
  const glm::dvec2 pixels(geo.picture.width, geo.picture.height);
  const double latitude = tie[4] - (0.5 * pixels.y - tie[1]) * scale[1];
  geo.size = pixels * glm::dvec2(scale[0], scale[1]) * metresOf(file, file.values<std::uint16_t>(kKeysTag), latitude);
  if (!(geo.size.x >= 1.0 && geo.size.y >= 1.0 && geo.size.x <= 1e8 && geo.size.y <= 1e8))
    file.fail(fmt::format("covers {:g} m by {:g} m, which is no map", geo.size.x, geo.size.y));
  return geo;
}

}  // namespace welkin
#else
namespace welkin {
GeoPicture loadGeoTiff(const std::string& path) {
  throw Error(ErrorKind::failed, path,
              "this welkin was built without GeoTIFF: install libtiff (Debian: apt-get install libtiff-dev) and build "
              "again, or make a PNG of it and give the corners of its land");
}
}  // namespace welkin
#endif
