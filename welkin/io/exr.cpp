#include "welkin/io/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <OpenEXRConfig.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <ostream>
#include <span>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

constexpr const char* kColours[] = {"R", "G", "B", "A"};
constexpr const char* kGrey[] = {"Y"};
constexpr int kMaxExrSide = 32768, kMaxTile = 4096;
constexpr std::size_t kMaxExrPixels = std::size_t{1} << 27, kMaxExrBytes = std::size_t{1} << 32;
// No compression of OpenEXR makes a picture more than about a thousand times smaller (deflate: 1032).
constexpr std::size_t kMaxExrRatio = 4096;
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

Imf::Header headerOf(const Image& image, const ExrMetadata& metadata) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());
  Imf::addWhiteLuminance(header, 1000.0f);
  if (!image.features.empty()) header.insert(kFeaturesAttribute, Imf::StringAttribute(image.features));
  if (metadata.environment != ExrEnvironment::none)
    Imf::addEnvmap(header, metadata.environment == ExrEnvironment::cube ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
  if (metadata.environment == ExrEnvironment::latlong) Imf::addWrapmodes(header, "periodic,clamp");
  if (!metadata.captureDate.empty()) {
    Imf::addCapDate(header, metadata.captureDate);
    // OpenEXR counts the other way round: universal time = local time + utcOffset.
    Imf::addUtcOffset(header, static_cast<float>(-metadata.utcOffset));
  }
  if (metadata.placed) {
    Imf::addLatitude(header, static_cast<float>(metadata.latitude));
    Imf::addLongitude(header, static_cast<float>(metadata.longitude));
  }
  for (const auto& [name, value] : metadata.numbers)
    header.insert("welkin:" + name, Imf::FloatAttribute(static_cast<float>(value)));
  return header;
}

// OpenEXR's own stream does not notice that its last bytes could not be stored.
class Stream : public Imf::OStream {
 public:
  explicit Stream(std::ostream& to) : Imf::OStream("picture"), to_(to) {}
  void write(const char from[], int count) override { to_.write(from, count); }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(static_cast<std::streamoff>(to_.tellp())); }
  void seekp(std::uint64_t at) override { to_.seekp(static_cast<std::streamoff>(at)); }

 private:
  std::ostream& to_;
};

template <class T>
void write(std::ostream& stream, const Image& image, const ExrMetadata& metadata, Imf::PixelType type,
           std::span<const T> values) {
  Imf::Header header = headerOf(image, metadata);
  Imf::FrameBuffer buffer;
  const auto names = channelNames(image.channels);
  for (std::size_t c = 0; c < names.size(); ++c) {
    header.channels().insert(names[c], Imf::Channel(type));
    buffer.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(const_cast<T*>(values.data() + c)),
                                       sizeof(T) * image.channels, sizeof(T) * image.channels * image.width));
  }
  Stream out(stream);
  Imf::OutputFile file(out, header, 1);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

// A file in memory.
class Bytes : public Imf::IStream {
 public:
  Bytes(std::string_view bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char to[], int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - std::min(at_, bytes_.size()))
      throw std::runtime_error("the file ends too early");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// OpenEXR makes room for an attribute before it reads it: one that claims more than the file holds is refused here.
// After magic number and version a header is a list of name, type, size and value; an empty name ends it.
void requireHeader(std::string_view bytes) {
  constexpr const char* kShort = "the file ends too early";
  const auto text = [&](std::size_t at) {
    const std::size_t end = bytes.find('\0', at);
    if (end == std::string_view::npos) throw std::runtime_error(kShort);
    return end;
  };
  for (std::size_t at = 8;;) {
    const std::size_t name = text(at);
    if (name == at) return;
    const std::size_t size = text(name + 1) + 1;
    if (bytes.size() < size + 4) throw std::runtime_error(kShort);
    std::uint32_t length = 0;
    for (std::size_t i = 4; i-- > 0;) length = length << 8 | static_cast<std::uint8_t>(bytes[size + i]);
    if (length > bytes.size() - size - 4) throw std::runtime_error(kShort);
    at = size + 4 + length;
  }
}

Image read(std::string_view bytes, const std::string& path) {
  requireHeader(bytes);
  static std::once_flag limited;
  std::call_once(limited, [] {
    Imf::Header::setMaxImageSize(kMaxExrSide, kMaxExrSide);
    Imf::Header::setMaxTileSize(kMaxTile, kMaxTile);
  });
  Bytes stream(bytes, path);
  Imf::InputFile file(stream, 1);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > kMaxExrPixels)
    throw Error(ErrorKind::badInput, path, fmt::format("{} x {} pixels are too many", width, height));
  const auto has = [&](const char* name) { return header.channels().findChannel(name) != nullptr; };
  const bool colour = has("R") && has("G") && has("B");
  if (!colour && !has("Y")) throw Error(ErrorKind::badInput, path, "has neither the channels R, G, B nor Y");
  const int channels = !colour ? 1 : has("A") ? 4 : 3;
  if (static_cast<std::size_t>(width * height) * channels * sizeof(float) / kMaxExrRatio > bytes.size())
    throw Error(ErrorKind::badInput, path, fmt::format("is too short for {} x {} pixels", width, height));
  Image image(static_cast<int>(width), static_cast<int>(height), channels);
  if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(kFeaturesAttribute))
    image.features = text->value();
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

void saveExr(const std::string& path, const Image& image, ExrPrecision precision, const ExrMetadata& metadata) {
  requireValues(path, image, precision);
  writeStreamAtomically(path, "OpenEXR", [&](std::ostream& stream) {
    if (precision == ExrPrecision::half) {
      std::vector<half> values(image.pixels.begin(), image.pixels.end());
      write<half>(stream, image, metadata, Imf::HALF, values);
    } else {
      write<float>(stream, image, metadata, Imf::FLOAT, image.pixels);
    }
  });
}

std::string exrVersion() { return OPENEXR_VERSION_STRING; }

Image loadExr(const std::string& path) { return parseExr(readFile(path, kMaxExrBytes), path); }

Image parseExr(std::string_view bytes, const std::string& path) {
  try {
    return read(bytes, path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(ErrorKind::badInput, path, std::string("is not an OpenEXR file that can be read: ") + e.what());
  }
}

}  // namespace welkin
