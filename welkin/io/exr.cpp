#include "welkin/io/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <OpenEXRConfig.h>
#include <fmt/format.h>
#include <half.h>

#include <cmath>
#include <limits>
#include <span>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

constexpr const char* kColours[] = {"R", "G", "B", "A"};
constexpr const char* kGrey[] = {"Y"};
constexpr std::size_t kMaxPixels = std::size_t{1} << 28;
constexpr float kLargestHalf = 65504.0f;

std::span<const char* const> channelNames(int channels) {
  return channels == 1 ? std::span<const char* const>(kGrey)
                       : std::span<const char* const>(kColours).first(static_cast<std::size_t>(channels));
}

void requireValues(const std::string& path, const Image& image, ExrPrecision precision) {
  if (image.width < 1 || image.height < 1 || (image.channels != 1 && image.channels != 3 && image.channels != 4))
    throw Error(ErrorKind::badInput, path,
                fmt::format("a picture of {} x {} pixels and {} channels cannot be written", image.width, image.height,
                            image.channels));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float v = image.pixels[i];
    const bool fits = std::isfinite(v) && (precision == ExrPrecision::full || std::abs(v) <= kLargestHalf);
    if (fits) continue;
    const std::size_t pixel = i / image.channels;
    throw Error(ErrorKind::badInput, path,
                fmt::format("the value {} at pixel {}, {} does not fit {}", v, pixel % image.width, pixel / image.width,
                            std::isfinite(v) ? "half precision; write full floats" : "any picture"));
  }
}

template <class T>
void write(const std::string& path, const Image& image, Imf::PixelType type, std::span<const T> values) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());
  Imf::addWhiteLuminance(header, 1000.0f);
  Imf::FrameBuffer buffer;
  const auto names = channelNames(image.channels);
  for (std::size_t c = 0; c < names.size(); ++c) {
    header.channels().insert(names[c], Imf::Channel(type));
    buffer.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(const_cast<T*>(values.data() + c)),
                                       sizeof(T) * image.channels, sizeof(T) * image.channels * image.width));
  }
  Imf::OutputFile file(path.c_str(), header, 1);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

Image read(const std::string& path) {
  Imf::InputFile file(path.c_str(), 1);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > kMaxPixels)
    throw Error(ErrorKind::badInput, path, fmt::format("{} x {} pixels are too many", width, height));
  const auto has = [&](const char* name) { return header.channels().findChannel(name) != nullptr; };
  const bool colour = has("R") && has("G") && has("B");
  if (!colour && !has("Y")) throw Error(ErrorKind::badInput, path, "has neither the channels R, G, B nor Y");
  Image image(static_cast<int>(width), static_cast<int>(height), !colour ? 1 : has("A") ? 4 : 3);
  Imf::FrameBuffer buffer;
  const auto names = channelNames(image.channels);
  const std::size_t step = sizeof(float) * image.channels, row = step * image.width;
  for (std::size_t c = 0; c < names.size(); ++c) {
    // OpenEXR addresses pixels from the origin of the data window's coordinates.
    char* origin = reinterpret_cast<char*>(image.pixels.data() + c) - window.min.x * static_cast<std::ptrdiff_t>(step) -
                   window.min.y * static_cast<std::ptrdiff_t>(row);
    buffer.insert(names[c], Imf::Slice(Imf::FLOAT, origin, step, row));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

void saveExr(const std::string& path, const Image& image, ExrPrecision precision) {
  requireValues(path, image, precision);
  writeFileAtomically(path, [&](const std::string& temporary) {
    try {
      if (precision == ExrPrecision::half) {
        std::vector<half> values(image.pixels.begin(), image.pixels.end());
        write<half>(temporary, image, Imf::HALF, values);
      } else {
        write<float>(temporary, image, Imf::FLOAT, image.pixels);
      }
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      throw Error(ErrorKind::failed, path, std::string("cannot be written as OpenEXR: ") + e.what());
    }
  });
}

std::string exrVersion() { return OPENEXR_VERSION_STRING; }

Image loadExr(const std::string& path) {
  try {
    return read(path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(ErrorKind::badInput, path, std::string("is not an OpenEXR file that can be read: ") + e.what());
  }
}

}  // namespace welkin
