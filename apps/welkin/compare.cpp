// welkin compare: how far one picture is from another.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "apps/welkin/command.hpp"
#include "apps/welkin/picture.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/flip.hpp"
#include "welkin/base/law_tone.hpp"
#include "welkin/base/metrics.hpp"
#include "welkin/base/tone.hpp"
#include "welkin/io/png.hpp"

namespace welkin::app {

namespace {

struct CompareArguments {
  std::string reference, test, output;
  std::optional<double> exposure;
  double ppd = kFlipPixelsPerDegree;
};

// Two pictures, as linear light and as a display shows them.
struct Pair {
  Image referenceLight, testLight, referenceShown, testShown;
  std::optional<double> ev;  // of pictures with a high dynamic range
};

struct Difference {
  double psnr = 0.0, relMse = 0.0, flip = 0.0, luminanceRatio = 0.0;
};

std::set<std::string> wordsOf(const std::string& features) {
  std::set<std::string> words;
  for (std::size_t begin = 0; begin < features.size();) {
    const std::size_t end = std::min(features.find(',', begin), features.size());
    words.insert(features.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

// Refuses two pictures that say that one shows what the other lacks.
void requireSameFeatures(const CompareArguments& arguments, const Image& a, const Image& b) {
  if (a.features.empty() || b.features.empty()) return;
  const auto require = [](const Image& has, const std::string& owner, const Image& lacks, const std::string& other) {
    const std::set<std::string> there = wordsOf(lacks.features);
    for (const std::string& word : wordsOf(has.features))
      if (!there.contains(word))
        throw Error(ErrorKind::badInput, other,
                    fmt::format("was rendered without '{0}', which '{1}' shows; render both with it or without it",
                                word, owner));
  };
  require(a, arguments.reference, b, arguments.test);
  require(b, arguments.test, a, arguments.reference);
}

Image load(const std::string& path) {
  Image image = loadPicture(path);
  for (const float v : image.pixels)
    if (!std::isfinite(v)) throw Error(ErrorKind::badInput, path, "holds values that are not finite");
  return image;
}

Image linearFromShown(const Image& shown) {
  Image light = shown;
  for (float& v : light.pixels) v = law::linearFromSrgb(v);
  return light;
}

Pair loadPair(const CompareArguments& arguments) {
  Image a = load(arguments.reference), b = load(arguments.test);
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw Error(ErrorKind::badInput, arguments.test,
                fmt::format("is {} x {} pixels of {} channels, but '{}' is {} x {} of {}", b.width, b.height,
                            b.channels, arguments.reference, a.width, a.height, a.channels));
  requireSameFeatures(arguments, a, b);
  const bool shown = isDisplayPicture(arguments.reference);
  if (shown != isDisplayPicture(arguments.test))
    throw Error(ErrorKind::badInput, arguments.test,
                fmt::format("and '{}': one is linear light, the other is tone-mapped; render both as .exr or both as "
                            ".png",
                            arguments.reference));
  if (shown) {
    if (arguments.exposure) throw UsageError("--exposure: PNG pictures have been exposed already");
    return {linearFromShown(a), linearFromShown(b), a, b, std::nullopt};
  }
  const double ev = arguments.exposure ? *arguments.exposure : automaticEv(a);
  const ToneSettings tone{.ev = static_cast<float>(ev)};
  return {a, b, displayValues(a, tone), displayValues(b, tone), ev};
}

nlohmann::ordered_json numberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

void print(const Difference& d, const Pair& pair, const CompareArguments& arguments, bool json) {
  if (json) {
    nlohmann::ordered_json out{{"width", pair.referenceLight.width},
                               {"height", pair.referenceLight.height},
                               {"identical", pair.referenceLight.pixels == pair.testLight.pixels},
                               {"psnr", numberOrNull(d.psnr)},
                               {"rel_mse", numberOrNull(d.relMse)},
                               {"flip", d.flip},
                               {"ppd", arguments.ppd},
                               {"luminance_ratio", numberOrNull(d.luminanceRatio)}};
    if (pair.ev) out["ev"] = *pair.ev;
    fmt::print("{}\n", out.dump(2));
    return;
  }
  fmt::print("PSNR            {:.2f} dB\n", d.psnr);
  fmt::print("relMSE          {:.4g}\n", d.relMse);
  fmt::print("FLIP            {:.4f}   mean, 0 to 1, at {:g} pixels per degree\n", d.flip, arguments.ppd);
  fmt::print("mean luminance  {:.4f}   of the second over the first\n", d.luminanceRatio);
  if (pair.ev) fmt::print("PSNR and FLIP at EV {:.2f}, tone curve agx\n", *pair.ev);
}

void compare(const CompareArguments& arguments, bool json) {
  if (!arguments.output.empty()) {
    if (!arguments.output.ends_with(".png")) throw UsageError("-o: the picture of the difference is a .png");
    requirePictureFile(arguments.output);
  }
  const Pair pair = loadPair(arguments);
  const Image map = flipMap(pair.referenceShown, pair.testShown, arguments.ppd);
  // PSNR over the colours alone.
  const Difference difference{psnr(withoutAlpha(pair.referenceShown), withoutAlpha(pair.testShown)),
                              relMse(pair.referenceLight, pair.testLight), meanOf(map),
                              meanLuminance(pair.testLight) / meanLuminance(pair.referenceLight)};
  if (!arguments.output.empty()) {
    const Image heat = heatMap(map);
    savePng(arguments.output, heat.width, heat.height, 3, bytesOf(heat));
  }
  print(difference, pair, arguments, json);
}

}  // namespace

void addCompare(CLI::App& app) {
  auto* command = app.add_subcommand("compare", "how far a picture is from a reference: PSNR, relMSE, FLIP");
  auto arguments = std::make_shared<CompareArguments>();
  command->add_option("reference", arguments->reference, "the reference: .png, .exr or .hdr")
      ->type_name("A")
      ->required();
  command->add_option("test", arguments->test, "the picture that is judged, of the same size")
      ->type_name("B")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "the map of FLIP as a picture: black where no difference is seen, through colours to white")
      ->type_name("DIFF.png");
  command
      ->add_option("--exposure", arguments->exposure,
                   "EV at ISO 100 at which .exr and .hdr are shown to PSNR and FLIP; measured from A when not given")
      ->type_name("EV")
      ->check(CLI::Range(-20.0, 30.0));
  command->add_option("--ppd", arguments->ppd, "pixels per degree of sight, for FLIP")
      ->type_name("N")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  const auto json = addJsonFlag(*command);
  command->callback([arguments, json] { compare(*arguments, *json); });
}

}  // namespace welkin::app
