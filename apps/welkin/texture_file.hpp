#pragma once
// Textures as files: 16-bit pictures for eyes, raw floats for programs.
#include <string>
#include <vector>

#include "welkin/noise/volume.hpp"

namespace welkin::app {

enum class TextureFormat { picture, raw };

// By the file's name: .png is a picture, .f32 raw; `raw` takes any name but .png. Throws UsageError for other names and
// Error (failed) when the file cannot be written.
TextureFormat textureFormat(const std::string& path, bool raw);

// Which numbers become black and white; beyond them they are clipped.
struct GreyScale {
  float black = 0.0f, white = 1.0f;
};

// A PNG of 16 bits a sample of a plane (depth 1) of 1, 3 or 4 channels, the texture's first row at the bottom (south).
void saveTexturePicture(const std::string& path, const Volume& plane, const GreyScale& scale);

// Floats as they are, with a header beside them (io/raw_volume.hpp).
void saveTextureRaw(const std::string& path, const Volume& volume);

// The chosen channels of a volume; an index beyond its own gives zeros.
Volume channelsOf(const Volume& volume, const std::vector<int>& channels);

// Slice `k` of a volume.
Volume sliceOf(const Volume& volume, int k);

// All slices side by side, rows of them from the top, on a grid as square as possible.
Volume atlasOf(const Volume& volume);

}  // namespace welkin::app
