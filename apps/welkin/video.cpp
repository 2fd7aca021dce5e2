// welkin video: a film of a sky.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "apps/welkin/command.hpp"
#include "apps/welkin/film_frames.hpp"
#include "apps/welkin/interrupt.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/video.hpp"

namespace welkin::app {

namespace {

constexpr double kUsualSeconds = 10.0, kTimelapseScale = 300.0;
constexpr int kMostFrames = 1000000;
constexpr double kLatest = 1e7;  // s, of a sky
constexpr std::array<const char*, 3> kPaths{"turntable", "timelapse", "flight"};

struct VideoArguments {
  SkyArguments sky;
  std::string output, size = "1280x720", path, preset, frames;
  double fps = 25.0, airspeed = 150.0, orbit = 0.0;
  std::optional<double> seconds, timeScale;
  int draws = 0;
  bool quiet = false;
  Renderer renderer = Renderer::realtime;
  TraceOptions trace;
  const CLI::Option *airspeedFlag = nullptr, *orbitFlag = nullptr;
};

// By --preset or the film's name, which must agree.
VideoFormat formatOf(const VideoArguments& a) {
  const std::string ending = std::filesystem::path(a.output).extension().string();
  struct Pair {
    const char *preset, *ending;
    VideoFormat format;
  };
  // The first with an ending is what that ending means.
  constexpr Pair kPairs[] = {{"h264", ".mp4", VideoFormat::h264},
                             {"prores", ".mov", VideoFormat::prores},
                             {"gif", ".gif", VideoFormat::gif},
                             {"h264", ".mov", VideoFormat::h264}};
  for (const Pair& pair : kPairs)
    if (ending == pair.ending && (a.preset.empty() || a.preset == pair.preset)) return pair.format;
  if (a.preset.empty()) throw UsageError(fmt::format("'{}': a film's name ends in .mp4, .mov or .gif", a.output));
  throw UsageError(
      fmt::format("--preset {}: '{}' has another ending; h264 goes into .mp4 or .mov, prores into .mov, "
                  "gif into .gif",
                  a.preset, a.output));
}

Size sizeOf(const VideoArguments& a, VideoFormat format) {
  const Size size = parseSize(a.size);
  if (format != VideoFormat::gif && (size.width % 2 != 0 || size.height % 2 != 0))
    throw UsageError(fmt::format("--size {}: {} has colours for every second pixel and takes even sizes alone", a.size,
                                 ChoiceNames<VideoFormat>::names[static_cast<std::size_t>(format)]));
  return size;
}

// Until the last keyframe, if there are any.
double lengthOf(const Shot& shot) {
  double last = shot.scene.time;
  for (const Keyframe& k : shot.scene.keyframes) last = std::max(last, k.time);
  return last > shot.scene.time && shot.timeScale > 0.0 ? (last - shot.scene.time) / shot.timeScale : kUsualSeconds;
}

Shot shotOf(const VideoArguments& a) {
  Shot shot{.scene = a.sky.animated(), .framesPerSecond = a.fps, .orbit = a.orbit, .airspeed = a.airspeed};
  const auto* const named = std::find(kPaths.begin(), kPaths.end(), a.path);
  if (named != kPaths.end()) shot.path = static_cast<ShotPath>(1 + (named - kPaths.begin()));
  if (a.airspeedFlag->count() > 0 && shot.path != ShotPath::flight) throw UsageError("--airspeed is for --path flight");
  if (a.orbitFlag->count() > 0 && shot.path != ShotPath::turntable) throw UsageError("--orbit is for --path turntable");
  shot.timeScale = a.timeScale.value_or(shot.path == ShotPath::timelapse ? kTimelapseScale : 1.0);
  std::error_code ignored;
  if (named == kPaths.end() && !a.path.empty()) {
    if (!std::filesystem::exists(a.path, ignored))
      throw UsageError(fmt::format("--path {}: is neither turntable, timelapse, flight nor a file", a.path));
    followFile(shot, a.path);
  }
  const double seconds = a.seconds.value_or(lengthOf(shot)), frames = std::round(seconds * a.fps);
  if (frames > kMostFrames)
    throw UsageError(
        fmt::format("{:g} s at {:g} frames a second are more than {} frames", seconds, a.fps, kMostFrames));
  if (shot.scene.time + shot.timeScale * seconds > kLatest)
    throw UsageError(fmt::format("the film would end {:g} s after the sky's beginning; {:g} s are the most",
                                 shot.scene.time + shot.timeScale * seconds, kLatest));
  shot.frames = std::max(1, static_cast<int>(frames));
  return shot;
}

std::string identityOf(const VideoArguments& a, const Shot& shot, const FrameOptions& options) {
  std::string text = fmt::format("welkin {} {}x{} {} bits\n", WELKIN_VERSION, options.width, options.height,
                                 options.depth == SampleDepth::bits16 ? 16 : 8);
  if (a.renderer == Renderer::path)
    text += fmt::format("path samples {} noise {} air {} scatterings {} denoise {} lanes {}\n", a.trace.samples,
                        a.trace.noise, a.trace.air, a.trace.scatterings, a.trace.denoise, trace::laneCount());
  else
    text += fmt::format("realtime draws {}\n", drawsOf(shot, options));
  return text + identityOf(shot);
}

void makeFrames(const VideoArguments& a, const Shot& shot, FrameOptions options, FrameFolder& folder,
                const InterruptGuard& interrupt) {
  ProgressDisplay display("rendering", a.quiet ? ProgressStyle::quiet : ProgressStyle::automatic);
  options.progress = [&interrupt, show = display.callback()](double done) { return !interrupt.asked() && show(done); };
  if (a.renderer == Renderer::path)
    traceFrames(shot, options, a.trace, folder);
  else
    drawFrames(shot, options, folder);
}

void makeFilm(const VideoArguments& a, const VideoFrames& frames, VideoFormat format, const InterruptGuard& interrupt) {
  ProgressDisplay display("encoding", a.quiet ? ProgressStyle::quiet : ProgressStyle::automatic);
  encodeVideo(frames, format, a.output,
              [&interrupt, show = display.callback()](double done) { return !interrupt.asked() && show(done); });
}

void video(const VideoArguments& a) {
  const VideoFormat format = formatOf(a);
  const Size size = sizeOf(a, format);
  requireUse(a.trace, a.renderer);
  if (a.renderer == Renderer::path && a.draws > 0)
    throw UsageError("--draws is for the real-time renderer: leave it out, or --renderer path");
  const Shot shot = shotOf(a);
  requireWritable(a.output);
  requireFfmpeg();
  const FrameOptions options{.width = size.width,
                             .height = size.height,
                             .draws = a.draws,
                             .depth = format == VideoFormat::prores ? SampleDepth::bits16 : SampleDepth::bits8};
  FrameFolder folder(a.frames.empty() ? a.output + ".frames" : a.frames,
                     a.frames.empty() ? FolderKind::own : FolderKind::asked, identityOf(a, shot, options), shot.frames);
  const int there = shot.frames - folder.missing();
  if (there > 0 && !a.quiet) fmt::print(stderr, "{} of {} frames are there already\n", there, shot.frames);
  const InterruptGuard interrupt;
  try {
    makeFrames(a, shot, options, folder, interrupt);
    makeFilm(a, {.folder = folder.path(), .count = shot.frames, .framesPerSecond = a.fps}, format, interrupt);
  } catch (const Cancelled&) {
    throw Error(ErrorKind::failed, a.output,
                fmt::format("interrupted; {} of {} frames are kept in {}, and the same command goes on from there",
                            shot.frames - folder.missing(), shot.frames, folder.path()));
  }
  folder.finish();
}

}  // namespace

void addVideo(CLI::App& app) {
  auto* command = app.add_subcommand("video", "a film of a sky: its keyframes, a camera path, or a day in fast motion");
  auto arguments = std::make_shared<VideoArguments>();
  VideoArguments& a = *arguments;
  a.sky.addTo(*command, SkyArguments::Need::optional);
  command->add_option("-o,--output", a.output, "the film: .mp4 (H.264), .mov (ProRes) or .gif")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--path", a.path,
                   "turntable: once round. timelapse: the day in fast motion. flight: forward, where the camera looks. "
                   "FILE: keyframes of the camera (docs/video.md). Without it: the sky's own keyframes and wind")
      ->type_name("PATH");
  command->add_option("--seconds", a.seconds, "length of the film; to its last keyframe if not given, or 10 s")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--fps", a.fps, "frames a second")
      ->type_name("N")
      ->check(CLI::Range(0.1, 240.0))
      ->capture_default_str();
  command->add_option("--time-scale", a.timeScale, "seconds of the sky to one of the film; 1, and 300 for timelapse")
      ->type_name("X")
      ->check(CLI::Range(0.0, 1e5));
  a.airspeedFlag = command->add_option("--airspeed", a.airspeed, "flight: m/s")
                       ->type_name("V")
                       ->check(CLI::Range(0.0, 1e4))
                       ->capture_default_str();
  a.orbitFlag = command
                    ->add_option("--orbit", a.orbit,
                                 "turntable: circles what stands so many metres before the camera, instead of turning "
                                 "on the spot")
                    ->type_name("M")
                    ->check(CLI::Range(1.0, 1e6));
  command->add_option("--size", a.size, "width and height in pixels")->type_name("WxH")->capture_default_str();
  command->add_option("--preset", a.preset, "h264, prores or gif; the film's name says it as well")
      ->check(CLI::IsMember({"h264", "prores", "gif"}))
      ->type_name("NAME");
  command
      ->add_option("--draws", a.draws,
                   "real time: how often each frame is drawn; if not given, until every pixel is new. Fewer are faster "
                   "and coarser where much moves")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--frames", a.frames,
                   "folder for the finished frames, kept when the film is made; if not given, FILE.frames, which goes")
      ->type_name("DIR");
  a.sky.addPictureOptionsTo(*command);
  addRendererOptions(*command, a.renderer, a.trace);
  command->add_flag("-q,--quiet", a.quiet, "no progress");
  command->callback([arguments] { video(*arguments); });
}

}  // namespace welkin::app
