// welkin weather: the weather of a layer as a picture and as raw floats.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>

#include "apps/welkin/command.hpp"
#include "apps/welkin/picture.hpp"
#include "apps/welkin/texture_file.hpp"
#include "welkin/density/weather_map.hpp"

namespace welkin::app {

namespace {

struct Channel {
  std::string name, unit;
  GreyScale scale;
};

// What a texel of the layer's weather holds, with the greatest range that each number can have.
std::array<Channel, 4> channelsOf(const Layer& layer) {
  const float range = layer.weather.mapBaseRange;
  if (layer.cloud.shape == LayerShape::nubis)
    return {Channel{"coverage", "", {}},
            {"type", "", {}},
            {"precipitation", "", {}},
            {"shift", " m", {0.0f, std::max(range, 1.0f)}}};
  const float vary = layer.profile.baseVariation, top = shellOf(layer).top - layer.cloud.base;
  return {Channel{"height", " m", {0.0f, top}},
          {"shift", " m", {-vary, std::max(vary + range, -vary + 1.0f)}},
          {"anvil", "", {}},
          {"precipitation", "", {}}};
}

struct WeatherArguments {
  SkyArguments sky;
  std::string output, centre, channel;
  std::size_t layer = 0;
  double edge = 60000.0;
  int size = 1024;
  bool raw = false;
};

glm::dvec2 parseCentre(const std::string& text) {
  glm::dvec2 centre;
  const char* end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, centre.x);
  bool right = first == std::errc() && comma != end && *comma == ',';
  if (right) {
    const auto [rest, second] = std::from_chars(comma + 1, end, centre.y);
    right = second == std::errc() && rest == end;
  }
  if (!right || !(std::max(std::abs(centre.x), std::abs(centre.y)) <= 1e7))
    throw UsageError(fmt::format("--centre {}: write east,north in metres, for example 2500,-800", text));
  return centre;
}

std::size_t channelNamed(const std::string& name, const std::array<Channel, 4>& channels) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (name.empty() || channels[i].name == name) return i;
    names.push_back(channels[i].name);
  }
  throw UsageError(fmt::format("--channel {}: this layer's weather has {}", name, fmt::join(names, ", ")));
}

void writeWeather(const WeatherArguments& arguments) {
  const TextureFormat format = textureFormat(arguments.output, arguments.raw);
  if (format == TextureFormat::raw && !arguments.channel.empty())
    throw UsageError("raw files hold all channels: leave out --channel");
  const Scene scene = arguments.sky.scene();
  if (arguments.layer >= scene.layers.size())
    throw UsageError(scene.layers.empty() ? std::string("this sky has no layers")
                                          : fmt::format("--layer {}: this sky has layers 0 to {}", arguments.layer,
                                                        scene.layers.size() - 1));
  const Layer& layer = scene.layers[arguments.layer];
  const std::array<Channel, 4> channels = channelsOf(layer);
  const std::size_t channel = channelNamed(arguments.channel, channels);
  const glm::dvec2 centre =
      arguments.centre.empty() ? glm::dvec2(scene.camera.position) : parseCentre(arguments.centre);
  const std::vector<Volume> maps = weatherMaps(scene);
  const Drift drift{scene.wind.speed, scene.wind.from, scene.time};
  const Volume weather =
      bakeWeather(layer, centre, arguments.edge, arguments.size, drift, scene.seed, &maps[arguments.layer]);
  fmt::print("layer {}: {:g} m round {:g} m east, {:g} m north, {:.4g} m a texel, north up\n", arguments.layer,
             arguments.edge, centre.x, centre.y, arguments.edge / arguments.size);
  if (format == TextureFormat::raw) {
    saveTextureRaw(arguments.output, weather);
    fmt::print("channels {}, south row first\n",
               fmt::join(std::vector{channels[0].name, channels[1].name, channels[2].name, channels[3].name}, ", "));
    return;
  }
  const Channel& shown = channels[channel];
  saveTexturePicture(arguments.output, app::channelsOf(weather, {static_cast<int>(channel)}), shown.scale);
  fmt::print("{}: black is {:g}{}, white {:g}{}\n", shown.name, shown.scale.black, shown.unit, shown.scale.white,
             shown.unit);
}

}  // namespace

void addWeather(CLI::App& app) {
  auto* command = app.add_subcommand("weather", "a layer's weather, seen from above, as a picture or as raw floats");
  auto arguments = std::make_shared<WeatherArguments>();
  arguments->sky.addTo(*command, SkyArguments::Need::optional);
  command
      ->add_option("-o,--output", arguments->output,
                   "a 16-bit picture (.png) or raw floats of all channels (.f32, with a .f32.json header beside it)")
      ->type_name("FILE")
      ->required();
  command->add_option("--layer", arguments->layer, "which layer of the sky")->type_name("N")->capture_default_str();
  command->add_option("--edge", arguments->edge, "edge of the square in metres")
      ->type_name("M")
      ->check(CLI::Range(1.0, 1e7))
      ->capture_default_str();
  command->add_option("--size", arguments->size, "texels along it")
      ->type_name("N")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  command->add_option("--centre", arguments->centre, "its middle, east and north in metres; the camera if not given")
      ->type_name("E,N");
  command
      ->add_option("--channel", arguments->channel,
                   "what the picture shows: height, shift (of the base), anvil or precipitation; of nubis layers "
                   "coverage, type, precipitation or shift; the first if not given")
      ->type_name("NAME");
  command->add_flag("--raw", arguments->raw, "raw floats, whatever the file is called");
  command->callback([arguments] { writeWeather(*arguments); });
}

}  // namespace welkin::app
