#include "welkin/io/video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/process.hpp"

namespace welkin {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// ffmpeg takes what stands before a colon for a protocol, and a percent sign for a number.
std::string asFile(const std::string& path) { return "file:" + path; }

std::string asPattern(const std::string& folder) {
  std::string pattern;
  for (const char c : folder) pattern += c == '%' ? "%%" : std::string(1, c);
  return asFile(pattern + "/frame_%06d.png");
}

Words started(const std::string& ffmpeg, const VideoFrames& frames) {
  return {ffmpeg,
          "-nostdin",
          "-y",
          "-loglevel",
          "error",
          "-progress",
          "pipe:1",
          "-nostats",
          "-framerate",
          fmt::format("{}", frames.framesPerSecond),
          "-start_number",
          "0",
          "-i",
          asPattern(frames.folder)};
}

// From the pictures' RGB to Y'CbCr of Rec.709, and the tags that say so.
Words rec709(const char* pixels) {
  return {"-vf",
          fmt::format("scale=out_color_matrix=bt709:out_range=tv:flags=lanczos+accurate_rnd+full_chroma_int+"
                      "full_chroma_inp,format={},setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709:"
                      "range=tv",
                      pixels),
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-colorspace",
          "bt709",
          "-color_range",
          "tv"};
}

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

// The frames done, of a line "frame=12".
int framesDone(std::string_view line) {
  constexpr std::string_view kKey = "frame=";
  int number = 0;
  if (line.starts_with(kKey)) std::from_chars(line.data() + kKey.size(), line.data() + line.size(), number);
  return number;
}

// Returns how many frames were written.
int run(const Words& words, const VideoFrames& frames, const Progress& progress) {
  int done = 0;
  const ProcessEnd end = runProcess(
      words, [&](std::string_view line) { done = std::max(done, framesDone(line)); },
      [&] { return !progress || progress(std::min(static_cast<double>(done) / frames.count, 1.0)); });
  if (end.code == 0) return done;
  const std::size_t last = end.errors.find_last_not_of('\n');
  throw Error(ErrorKind::failed, words.front(),
              fmt::format("could not make the film (exit code {}): {}", end.code,
                          last == std::string::npos ? "it gave no reason" : end.errors.substr(0, last + 1)));
}

}  // namespace

std::string frameName(int number) { return fmt::format("frame_{:06}.png", number); }

std::string requireFfmpeg() {
  std::string path = findProgram("ffmpeg");
  if (path.empty())
    throw Error(ErrorKind::failed, "ffmpeg",
                "was not found in PATH, and films are made by it; install it (Debian: apt-get install ffmpeg)");
  return path;
}

void encodeVideo(const VideoFrames& frames, VideoFormat format, const std::string& path, const Progress& progress) {
  const std::string ffmpeg = requireFfmpeg();
  const fs::path folder = frames.folder;
  const std::string made = (folder / "film.part").string(), palette = (folder / "palette.png").string();
  const Words count{"-frames:v", std::to_string(frames.count), "-map_metadata", "-1"};
  Words words = started(ffmpeg, frames);
  Progress stage = progress;
  switch (format) {
    case VideoFormat::h264:
      append(words, rec709("yuv420p"));
      append(words,
             {"-c:v", "libx264", "-preset", "slow", "-crf", "17", "-profile:v", "high", "-movflags", "+faststart"});
      append(words, count);
      append(words, {"-f", path.ends_with(".mov") ? "mov" : "mp4", asFile(made)});
      break;
    case VideoFormat::prores:
      append(words, rec709("yuv422p10le"));
      append(words, {"-c:v", "prores_ks", "-profile:v", "hq", "-vendor", "apl0"});
      append(words, count);
      append(words, {"-f", "mov", asFile(made)});
      break;
    case VideoFormat::gif: {
      // One palette for the film: what rests keeps its colours. Ordered dither, since the pattern of error diffusion
      // moves with every frame.
      Words first = words;
      append(first, {"-vf", "palettegen=max_colors=256:stats_mode=full:reserve_transparent=0", "-update", "1",
                     asFile(palette)});
      run(first, frames, stageOf(progress, 0.0, 0.4));
      stage = stageOf(progress, 0.4, 1.0);
      append(words, {"-i", asFile(palette), "-lavfi", "paletteuse=dither=bayer:bayer_scale=3:diff_mode=rectangle"});
      append(words, count);
      append(words, {"-loop", "0", "-f", "gif", asFile(made)});
      break;
    }
  }
  if (const int written = run(words, frames, stage); written != frames.count)
    throw Error(ErrorKind::failed, frames.folder,
                fmt::format("ffmpeg could read {} of {} frames; delete those that are damaged and start again", written,
                            frames.count));
  writeFileAtomically(path, [&](const std::string& temporary) {
    std::error_code elsewhere;
    fs::rename(made, temporary, elsewhere);
    if (elsewhere) fs::copy_file(made, temporary, fs::copy_options::overwrite_existing);
  });
  std::error_code ignored;
  for (const std::string& file : {made, palette}) fs::remove(file, ignored);
}

}  // namespace welkin
