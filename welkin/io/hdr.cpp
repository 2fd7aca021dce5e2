#include "welkin/io/hdr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

constexpr std::size_t kMaxHdrPixels = std::size_t{1} << 27, kMaxHdrBytes = std::size_t{1} << 31;
constexpr int kMinRun = 8, kMaxRun = 32767;  // widths of rows that may be run-length encoded
constexpr int kBias = 128;
// A byte pair stands for at most 127 bytes; the older scheme repeats a pixel 255 times by four bytes, and 255^2 times
// by eight.
constexpr std::size_t kMaxHdrRatio = 1 << 16;

void encodePixel(const float* colour, int channels, std::uint8_t* rgbe) {
  float most = 0.0f;
  for (int k = 0; k < 3; ++k) most = std::max(most, colour[channels == 1 ? 0 : k]);
  if (most < 1e-38f) {
    std::fill_n(rgbe, 4, std::uint8_t{0});
    return;
  }
  int exponent = 0;
  // A mantissa that would round up to 256 takes the next exponent.
  if (std::frexp(most, &exponent) >= 255.5f / 256.0f) ++exponent;
  for (int k = 0; k < 3; ++k)
    rgbe[k] =
        static_cast<std::uint8_t>(std::lround(std::ldexp(std::max(colour[channels == 1 ? 0 : k], 0.0f), 8 - exponent)));
  rgbe[3] = static_cast<std::uint8_t>(exponent + kBias);
}

void decodePixel(const std::uint8_t* rgbe, float* colour) {
  for (int k = 0; k < 3; ++k)
    colour[k] = rgbe[3] == 0 ? 0.0f : std::ldexp(static_cast<float>(rgbe[k]), rgbe[3] - kBias - 8);
}

// Runs of 4 to 127 equal bytes as (128 + length, byte), everything else as (length, bytes).
void appendRuns(std::string& out, const std::uint8_t* row, int width, int stride) {
  const auto at = [&](int x) { return static_cast<char>(row[static_cast<std::size_t>(x) * stride]); };
  const auto runAt = [&](int x) {
    int end = x + 1;
    while (end < width && end - x < 127 && at(end) == at(x)) ++end;
    return end - x;
  };
  for (int x = 0; x < width;) {
    int begin = x, run = 0;
    while (x < width && x - begin < 128 && (run = runAt(x)) < 4) ++x;
    if (x > begin) {
      out += static_cast<char>(x - begin);
      for (int i = begin; i < x; ++i) out += at(i);
    } else {
      out += static_cast<char>(128 + run);
      out += at(x);
      x += run;
    }
  }
}

// The bytes of a file, one after the other.
struct RgbeReader {
  std::string_view rest;
  const std::string& name;

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::badInput, name, "is not a Radiance picture that can be read: " + why);
  }
  std::string_view take(std::size_t count) {
    if (rest.size() < count) refuse("the file ends too early");
    const std::string_view taken = rest.substr(0, count);
    rest.remove_prefix(count);
    return taken;
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
  std::string_view line() {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) refuse("the file ends too early");
    const std::string_view text = take(end + 1);
    return text.substr(0, end);
  }
};

void readSize(RgbeReader& reader, int& width, int& height) {
  const std::string_view line = reader.line();
  const char *at = line.data(), *end = at + line.size();
  const auto side = [&](std::string_view lead, int& value) {
    if (!std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(lead)) return false;
    const auto [after, error] = std::from_chars(at + lead.size(), end, value);
    at = after;
    return error == std::errc() && value >= 1;
  };
  if (!side("-Y ", height) || !side(" +X ", width) || at != end)
    reader.refuse("its size is not written as \"-Y HEIGHT +X WIDTH\", with rows from the top");
}

void readPlanes(RgbeReader& reader, std::uint8_t* row, int width) {
  for (int k = 0; k < 4; ++k)
    for (int x = 0; x < width;) {
      const int count = reader.byte(), length = count > 128 ? count - 128 : count;
      if (length == 0 || x + length > width) reader.refuse("a row is too long");
      const std::string_view bytes = reader.take(count > 128 ? 1 : static_cast<std::size_t>(length));
      for (int i = 0; i < length; ++i, ++x) row[x * 4 + k] = static_cast<std::uint8_t>(bytes[count > 128 ? 0 : i]);
    }
}

// Flat pixels, and the older runs: (1, 1, 1, n) repeats the pixel before n times, n * 256 times after another such.
void readPixels(RgbeReader& reader, std::uint8_t* row, int width) {
  for (int x = 0, shift = 0; x < width;) {
    const std::string_view bytes = reader.take(4);
    std::copy_n(bytes.data(), 4, reinterpret_cast<char*>(row) + static_cast<std::size_t>(x) * 4);
    std::uint8_t* p = row + static_cast<std::size_t>(x) * 4;
    if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
      ++x;
      shift = 0;
      continue;
    }
    const int count = p[3] << shift;
    if (x == 0 || shift > 16 || count > width - x) reader.refuse("a run is too long");
    for (int i = 0; i < count; ++i, ++x) std::copy_n(p - 4, 4, row + static_cast<std::size_t>(x) * 4);
    shift += 8;
  }
}

}  // namespace

void saveHdr(const std::string& path, const Image& image) {
  if (image.width < 1 || image.height < 1 || (image.channels != 1 && image.channels != 3))
    throw Error(ErrorKind::badInput, path,
                fmt::format("a picture of {} x {} pixels and {} channels cannot be written", image.width, image.height,
                            image.channels));
  for (const float v : image.pixels)
    if (!(v <= 1e38f && v >= -1e38f))
      throw Error(ErrorKind::badInput, path, fmt::format("the value {} does not fit any picture", v));
  std::string bytes =
      fmt::format("#?RADIANCE\n# 1 is 1000 cd/m^2\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 4);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      encodePixel(image.at(x, y), image.channels, row.data() + static_cast<std::size_t>(x) * 4);
    if (image.width < kMinRun || image.width > kMaxRun) {
      bytes.append(reinterpret_cast<const char*>(row.data()), row.size());
      continue;
    }
    bytes += {2, 2, static_cast<char>(image.width >> 8), static_cast<char>(image.width & 255)};
    for (int k = 0; k < 4; ++k) appendRuns(bytes, row.data() + k, image.width, 4);
  }
  writeFileAtomically(path, bytes);
}

Image parseHdr(std::string_view bytes, const std::string& name) {
  RgbeReader reader{bytes, name};
  if (!bytes.starts_with("#?")) reader.refuse("it does not begin with \"#?\"");
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line())
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      reader.refuse("only FORMAT=32-bit_rle_rgbe is known");
  int width = 0, height = 0;
  readSize(reader, width, height);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (count > kMaxHdrPixels) reader.refuse(fmt::format("{} x {} pixels are too many", width, height));
  if (count * 4 / kMaxHdrRatio > bytes.size()) reader.refuse("the file ends too early");
  Image image(width, height, 3);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(width) * 4);
  for (int y = 0; y < height; ++y) {
    const std::string_view head = reader.rest.substr(0, 4);
    const bool planes = width >= kMinRun && width <= kMaxRun && head.size() == 4 && head[0] == 2 && head[1] == 2 &&
                        static_cast<std::uint8_t>(head[2]) < 128;
    if (planes) {
      reader.take(4);
      if ((static_cast<std::uint8_t>(head[2]) << 8 | static_cast<std::uint8_t>(head[3])) != width)
        reader.refuse("a row has another width than the picture");
      readPlanes(reader, row.data(), width);
    } else {
      readPixels(reader, row.data(), width);
    }
    for (int x = 0; x < width; ++x) decodePixel(row.data() + static_cast<std::size_t>(x) * 4, image.at(x, y));
  }
  return image;
}

Image loadHdr(const std::string& path) { return parseHdr(readFile(path, kMaxHdrBytes), path); }

}  // namespace welkin
