#include "welkin/io/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <memory>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

constexpr std::size_t kMaxPngBytes = std::size_t{1} << 30;
constexpr png_uint_32 kMaxPngSide = 16384;
constexpr std::size_t kMaxPngPixels = std::size_t{1} << 26;
constexpr std::size_t kMaxPngRatio = 1032;  // deflate makes data no smaller

// Errors leave libpng's C frames as exceptions; they hold nothing that the structs' owners do not free. This needs
// unwind tables, which GCC and Clang write for C too on x86-64 and AArch64.
struct Failure {
  std::string what;
};
[[noreturn]] void fail(png_structp, png_const_charp message) { throw Failure{message}; }
void ignore(png_structp, png_const_charp) {}

struct PngReader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngReader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
    if (png) info = png_create_info_struct(png);
    if (!info) throw Failure{"out of memory"};
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Writer() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
    if (png) info = png_create_info_struct(png);
    if (!info) throw Failure{"out of memory"};
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

void readSome(png_structp png, png_bytep out, std::size_t count) {
  auto* rest = static_cast<std::string_view*>(png_get_io_ptr(png));
  if (rest->size() < count) throw Failure{"the file ends too early"};
  std::copy_n(rest->data(), count, reinterpret_cast<char*>(out));
  rest->remove_prefix(count);
}

void writeSome(png_structp png, png_bytep data, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}
void flush(png_structp) {}

// libpng makes room for a chunk before it reads it: one that claims more than the file holds is refused here. After the
// signature of 8 bytes come chunks of length, type, data and checksum.
void requireChunks(std::string_view bytes) {
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    if (length > bytes.size() - at - 8) throw Failure{"the file ends too early"};
    at += 12 + std::size_t{length};
  }
}

Image readPng(std::string_view bytes) {
  requireChunks(bytes);
  const std::size_t length = bytes.size();
  PngReader reader;
  png_structp png = reader.png;
  png_set_user_limits(png, kMaxPngSide, kMaxPngSide);
  png_set_chunk_malloc_max(png, 1 << 24);
  png_set_read_fn(png, &bytes, readSome);
  png_read_info(png, reader.info);
  const png_uint_32 width = png_get_image_width(png, reader.info), height = png_get_image_height(png, reader.info);
  if (std::size_t{width} * height > kMaxPngPixels)
    throw Failure{fmt::format("{} x {} pixels are too many", width, height)};
  if (png_get_rowbytes(png, reader.info) * height / kMaxPngRatio > length) throw Failure{"the file ends too early"};

  png_set_expand(png);  // palette to RGB, 1 to 4 bits to 8, transparency to alpha
  if (png_get_bit_depth(png, reader.info) == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
  const int channels = png_get_channels(png, reader.info), bits = png_get_bit_depth(png, reader.info);
  const std::size_t stride = png_get_rowbytes(png, reader.info);

  std::vector<png_byte> samples(stride * height);
  std::vector<png_bytep> rows(height);
  for (png_uint_32 y = 0; y < height; ++y) rows[y] = samples.data() + y * stride;
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);

  Image image(static_cast<int>(width), static_cast<int>(height), channels);
  png_textp texts = nullptr;
  const int textCount = png_get_text(png, reader.info, &texts, nullptr);
  for (int i = 0; i < textCount; ++i)
    if (texts[i].text && std::string_view(texts[i].key) == kFeaturesAttribute) image.features = texts[i].text;
  const std::size_t count = image.pixels.size();
  if (bits == 16) {
    const auto* wide = reinterpret_cast<const std::uint16_t*>(samples.data());
    std::transform(wide, wide + count, image.pixels.begin(),
                   [](std::uint16_t v) { return static_cast<float>(v) / 65535.0f; });
  } else {
    std::transform(samples.begin(), samples.end(), image.pixels.begin(),
                   [](png_byte v) { return static_cast<float>(v) / 255.0f; });
  }
  return image;
}

std::string encode(int width, int height, int channels, int bits, const std::uint8_t* samples,
                   const std::string& features) {
  constexpr int kColourTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                  PNG_COLOR_TYPE_RGB_ALPHA};
  std::string bytes;
  Writer writer;
  png_structp png = writer.png;
  png_set_write_fn(png, &bytes, writeSome, flush);
  png_set_IHDR(png, writer.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
               kColourTypes[channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (bits == 8) png_set_sRGB(png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 6);
  if (!features.empty()) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<png_charp>(kFeaturesAttribute);
    text.text = const_cast<png_charp>(features.c_str());
    text.text_length = features.size();
    png_set_text(png, writer.info, &text, 1);
  }
  png_write_info(png, writer.info);
  if (bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  const std::size_t stride = static_cast<std::size_t>(width) * channels * (bits / 8);
  for (int y = 0; y < height; ++y) png_write_row(png, samples + y * stride);
  png_write_end(png, nullptr);
  return bytes;
}

template <class T>
void save(const std::string& path, int width, int height, int channels, std::span<const T> samples,
          const std::string& features = "") {
  if (width < 1 || height < 1 || channels < 1 || channels > 4 ||
      samples.size() != static_cast<std::size_t>(width) * height * channels)
    throw Error(
        ErrorKind::badInput, path,
        fmt::format("{} x {} pixels of {} channels do not fit {} samples", width, height, channels, samples.size()));
  std::string bytes;
  try {
    bytes =
        encode(width, height, channels, 8 * sizeof(T), reinterpret_cast<const std::uint8_t*>(samples.data()), features);
  } catch (const Failure& failure) {
    throw Error(ErrorKind::failed, path, "cannot be written as PNG: " + failure.what);
  }
  writeFileAtomically(path, bytes);
}

}  // namespace

Image parsePng(std::string_view bytes, const std::string& name) {
  try {
    return readPng(bytes);
  } catch (const Failure& failure) {
    throw Error(ErrorKind::badInput, name, "is not a PNG that can be read: " + failure.what);
  }
}

Image loadPng(const std::string& path) { return parsePng(readFile(path, kMaxPngBytes), path); }

void savePng(const std::string& path, int width, int height, int channels, std::span<const std::uint8_t> samples,
             const std::string& features) {
  save(path, width, height, channels, samples, features);
}

std::string pngVersion() { return png_get_libpng_ver(nullptr); }

void savePng16(const std::string& path, int width, int height, int channels, std::span<const std::uint16_t> samples) {
  save(path, width, height, channels, samples);
}

}  // namespace welkin
