#include "welkin/io/raw_volume.hpp"

#include <fmt/format.h>

#include <bit>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

static_assert(std::endian::native == std::endian::little, "raw volumes are written as they lie in memory");

void saveRawVolume(const std::string& path, int width, int height, int depth, int channels,
                   std::span<const float> values) {
  if (width < 1 || height < 1 || depth < 1 || channels < 1 ||
      values.size() != static_cast<std::size_t>(width) * height * depth * channels)
    throw Error(ErrorKind::badInput, path,
                fmt::format("{} x {} x {} voxels of {} channels do not fit {} values", width, height, depth, channels,
                            values.size()));
  const std::string header = fmt::format(
      "{{\n  \"format\": \"welkin raw volume 1\",\n  \"type\": \"float32 little-endian\",\n"
      "  \"order\": \"channel, x, y, z; first fastest\",\n"
      "  \"width\": {},\n  \"height\": {},\n  \"depth\": {},\n  \"channels\": {}\n}}\n",
      width, height, depth, channels);
  writeFileAtomically(path, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  writeFileAtomically(path + ".json", header);
}

}  // namespace welkin
