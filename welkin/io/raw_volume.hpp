#pragma once
// A 3D texture as raw floats with a small JSON header beside it, which any program can read.
#include <span>
#include <string>

namespace welkin {

// Writes `path` (little-endian 32-bit floats, x fastest, channels interleaved) and `path`.json ({"format", "type",
// "order", "width", "height", "depth", "channels"}). Throws Error (badInput) when the sizes do not match.
void saveRawVolume(const std::string& path, int width, int height, int depth, int channels,
                   std::span<const float> values);

}  // namespace welkin
