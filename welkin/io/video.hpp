#pragma once
// Films: numbered PNG pictures made into one file by ffmpeg, a program of its own.
#include <array>
#include <string>
#include <string_view>

#include "welkin/base/fields.hpp"
#include "welkin/base/progress.hpp"

namespace welkin {

// h264: 8 bit 4:2:0, plays everywhere. prores: 10 bit 4:2:2, for editing. gif: a palette of its own, for pages.
enum class VideoFormat { h264, prores, gif };
template <>
struct ChoiceNames<VideoFormat> {
  static constexpr std::array<std::string_view, 3> names{"h264", "prores", "gif"};
};

// Pictures that show what a display shows, 8 or 16 bits a sample, all of one size: FOLDER/frame_000000.png and on.
struct VideoFrames {
  std::string folder;
  int count = 0;
  double framesPerSecond = 25.0;
};
std::string frameName(int number);

// Where ffmpeg is. Throws Error (failed) that says how to get it.
std::string requireFfmpeg();

// Makes the film, whose name says the container: .mp4, .mov or .gif. Its colours are tagged as what they are: Rec.709
// primaries, transfer and matrix, limited range; a GIF's are sRGB. The same frames give the same bytes. What it needs
// besides is written into the frames' folder. Cancelled by `progress`, it leaves no file and throws Cancelled. Throws
// Error (failed) with ffmpeg's own words.
void encodeVideo(const VideoFrames& frames, VideoFormat format, const std::string& path, const Progress& progress);

}  // namespace welkin
