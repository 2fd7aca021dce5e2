#include <fmt/format.h>

#include <charconv>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/animation.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::app {

namespace {

constexpr int kMaxSide = 16384;  // of a picture

// A wrong value on the command line is a wrong use of the command, not a bad file.
void set(Scene& scene, const std::string& assignment) {
  try {
    dropKeyframes(scene, setField(scene, assignment));
  } catch (const Error& e) {
    throw UsageError(e.what());
  }
}

// "east,north,up[,heading[,pitch[,fov[,roll]]]]", or camera parameters "heading=90 pitch=10".
void setCamera(Scene& scene, const std::string& text) {
  if (text.find('=') != std::string::npos) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find_first_of(" ;", begin), text.size());
      if (end > begin) set(scene, "camera." + text.substr(begin, end - begin));
      begin = end + 1;
    }
    return;
  }
  std::vector<std::string> numbers{""};
  for (const char c : text)
    if (c == ',')
      numbers.emplace_back();
    else
      numbers.back() += c;
  if (numbers.size() < 3 || numbers.size() > 7)
    throw UsageError(
        fmt::format("--camera {}: write east,north,up[,heading[,pitch[,fov[,roll]]]] or name=value pairs", text));
  set(scene, fmt::format("camera.position={},{},{}", numbers[0], numbers[1], numbers[2]));
  const char* names[] = {"heading", "pitch", "fov", "roll"};
  for (std::size_t i = 3; i < numbers.size(); ++i) set(scene, fmt::format("camera.{}={}", names[i - 3], numbers[i]));
}

}  // namespace

Size parseSize(const std::string& text) {
  Size size{};
  const char *end = text.data() + text.size(), *rest = text.data();
  const auto readSide = [&](int& side) {
    const auto [after, error] = std::from_chars(rest, end, side);
    rest = after;
    return error == std::errc() && side >= 1 && side <= kMaxSide;
  };
  const bool right = readSide(size.width) && rest != end && *rest++ == 'x' && readSide(size.height) && rest == end;
  if (!right)
    throw UsageError(
        fmt::format("--size {}: write WIDTHxHEIGHT, for example 1280x720, at most {} a side", text, kMaxSide));
  return size;
}

std::shared_ptr<bool> addJsonFlag(CLI::App& command) {
  auto flag = std::make_shared<bool>(false);
  command.add_flag("--json", *flag, "print JSON, for programs");
  return flag;
}

void SkyArguments::addTo(CLI::App& command, Need need) {
  auto* option = command.add_option("sky", sky, "sky file or name of a preset")->type_name("SKY");
  if (need == Need::required) option->required();
  command.add_option("--set", assignments, "set a parameter, e.g. layer.0.weather.coverage=0.5 (see `welkin fields`)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);  // one value each: what follows may be the sky
  command.add_option("--seed", seed, "another seed, another sky")->type_name("N");
  command.add_option("--time", time, "seconds that wind and growth have been at work; keyframes stand on this clock")
      ->type_name("T");
}

void SkyArguments::addPictureOptionsTo(CLI::App& command) {
  command
      .add_option("--camera", camera,
                  "metres and degrees: east,north,up[,heading[,pitch[,fov[,roll]]]], or pairs such as \"heading=90 "
                  "pitch=10\"")
      ->type_name("CAMERA");
  command.add_option("--quality", quality, "low, medium, high or ultra")->type_name("NAME");
  command.add_option("--ev", ev, "exposure value at ISO 100")->type_name("EV");
  command.add_option("--tone", tone, "tone curve: agx, aces, filmic or none")->type_name("NAME");
}

Scene SkyArguments::scene() const {
  const Scene all = animated();
  return sceneAt(all, all.time);
}

Scene SkyArguments::animated() const {
  Scene scene = loadSkyNamed(sky, presetFolder());
  if (!quality.empty()) set(scene, "quality.preset=" + quality);
  if (seed) set(scene, fmt::format("seed={}", *seed));
  if (time) set(scene, fmt::format("time={}", *time));
  if (!camera.empty()) setCamera(scene, camera);
  if (ev) {
    set(scene, "film.exposure=manual");
    set(scene, fmt::format("film.ev={}", *ev));
  }
  if (!tone.empty()) set(scene, "film.tone=" + tone);
  for (const std::string& assignment : assignments) set(scene, assignment);
  return scene;
}

}  // namespace welkin::app
