#include "apps/welkin/texture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "apps/welkin/command.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/raw_volume.hpp"

namespace welkin::app {

TextureFormat textureFormat(const std::string& path, bool raw) {
  const bool png = path.ends_with(".png");
  if (raw && png) throw UsageError(fmt::format("'{}': raw floats are not a picture; name the file .f32", path));
  if (!raw && !png && !path.ends_with(".f32"))
    throw UsageError(fmt::format("'{}': name the file .png for a picture or .f32 for raw floats", path));
  requireWritable(path);
  return png ? TextureFormat::picture : TextureFormat::raw;
}

void saveTexturePicture(const std::string& path, const Volume& plane, const GreyScale& scale) {
  std::vector<std::uint16_t> samples;
  samples.reserve(plane.texels.size());
  const std::size_t row = static_cast<std::size_t>(plane.width) * plane.channels;
  for (int y = plane.height - 1; y >= 0; --y)
    for (std::size_t i = 0; i < row; ++i) {
      const float share = (plane.at(0, y, 0)[i] - scale.black) / (scale.white - scale.black);
      samples.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(share, 0.0f, 1.0f))));
    }
  savePng16(path, plane.width, plane.height, plane.channels, samples);
}

void saveTextureRaw(const std::string& path, const Volume& volume) {
  saveRawVolume(path, volume.width, volume.height, volume.depth, volume.channels, volume.texels);
}

Volume channelsOf(const Volume& volume, const std::vector<int>& channels) {
  Volume chosen(volume.width, volume.height, volume.depth, static_cast<int>(channels.size()));
  const auto from = static_cast<std::size_t>(volume.channels);
  for (std::size_t i = 0; i < volume.texels.size() / from; ++i)
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c] < volume.channels)
        chosen.texels[i * channels.size() + c] = volume.texels[i * from + static_cast<std::size_t>(channels[c])];
  return chosen;
}

Volume sliceOf(const Volume& volume, int k) {
  Volume slice(volume.width, volume.height, 1, volume.channels);
  std::copy_n(volume.at(0, 0, k), slice.texels.size(), slice.texels.begin());
  return slice;
}

Volume atlasOf(const Volume& volume) {
  const int across = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(volume.depth))));
  const int rows = (volume.depth + across - 1) / across;
  Volume atlas(across * volume.width, rows * volume.height, 1, volume.channels);
  const std::size_t run = static_cast<std::size_t>(volume.width) * volume.channels;
  for (int k = 0; k < volume.depth; ++k)
    for (int y = 0; y < volume.height; ++y) {
      const std::size_t row = static_cast<std::size_t>(rows - 1 - k / across) * volume.height + y;
      const std::size_t at = (row * across + static_cast<std::size_t>(k % across)) * run;
      std::copy_n(volume.at(0, y, k), run, atlas.texels.begin() + static_cast<std::ptrdiff_t>(at));
    }
  return atlas;
}

}  // namespace welkin::app
