// welkin noise: the noise textures as pictures and raw volumes.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "apps/welkin/command.hpp"
#include "apps/welkin/texture_file.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/noise/textures.hpp"
#include "welkin/realtime/noise_textures.hpp"

namespace welkin::app {

namespace {

struct Recipe {
  const char* name;
  int channels;
  GreyScale scale;
  std::function<Volume(const NoiseSettings&)> cpu;
  std::function<gl::Texture(const gl::Api&, const NoiseSettings&)> gpu;
};

const std::vector<Recipe>& recipes() {
  using N = NoiseSettings;
  using A = gl::Api;
  static const std::vector<Recipe> kRecipes{
      {"base_shape",
       4,
       {},
       [](const N& n) { return bakeBaseShape(n.baseShape); },
       [](const A& a, const N& n) { return realtime::generateBaseShape(a, n.baseShape); }},
      {"detail",
       3,
       {},
       [](const N& n) { return bakeDetail(n.detail); },
       [](const A& a, const N& n) { return realtime::generateDetail(a, n.detail); }},
      {"curl",
       2,
       {-1.0f, 1.0f},
       [](const N& n) { return bakeCurl(n.curl); },
       [](const A& a, const N& n) { return realtime::generateCurl(a, n.curl); }},
      {"profile_base",
       2,
       {},
       [](const N& n) { return bakeProfileBase(n.profile); },
       [](const A& a, const N& n) { return realtime::generateProfileBase(a, n.profile); }},
      {"profile_detail",
       2,
       {},
       [](const N& n) { return bakeProfileDetail(n.profile); },
       [](const A& a, const N& n) { return realtime::generateProfileDetail(a, n.profile); }},
      {"profile_warp",
       2,
       {},
       [](const N& n) { return bakeProfileWarp(n.profile); },
       [](const A& a, const N& n) { return realtime::generateProfileWarp(a, n.profile); }},
  };
  return kRecipes;
}

struct NoiseArguments {
  SkyArguments sky;
  std::string texture, output, route = "cpu", channel;
  std::optional<int> slice;
  bool atlas = false, raw = false;
};

Volume generate(const Recipe& recipe, const NoiseSettings& settings, const std::string& route) {
  if (route == "cpu") return recipe.cpu(settings);
  const gl::Context context;
  const gl::Api gl = gl::loadApi(context.loader());
  return realtime::volumeFromTexture(gl, recipe.gpu(gl, settings), recipe.channels);
}

std::vector<int> channelsNamed(const std::string& letters, const Recipe& recipe) {
  std::vector<int> channels;
  for (const char c : letters) channels.push_back(static_cast<int>(std::string("rgba").find(c)));
  if (letters != "rgb" && channels.back() >= recipe.channels)
    throw UsageError(fmt::format("--channel {}: {} has {} channels", letters, recipe.name, recipe.channels));
  return channels;
}

void printSummary(const Recipe& recipe, const Volume& v) {
  fmt::print("{}: {} x {} x {}, {} channels\n", recipe.name, v.width, v.height, v.depth, v.channels);
  for (int c = 0; c < v.channels; ++c) {
    const Volume one = channelsOf(v, {c});
    const auto [low, high] = std::minmax_element(one.texels.begin(), one.texels.end());
    double sum = 0.0;
    for (const float t : one.texels) sum += t;
    fmt::print("  {}  {:.4f} to {:.4f}, mean {:.4f}\n", "rgba"[c], *low, *high,
               sum / static_cast<double>(one.texels.size()));
  }
}

void writeNoise(const NoiseArguments& arguments) {
  const Recipe& recipe =
      *std::find_if(recipes().begin(), recipes().end(), [&](const Recipe& r) { return r.name == arguments.texture; });
  const TextureFormat format = textureFormat(arguments.output, arguments.raw);
  const bool chosen = arguments.slice || arguments.atlas || !arguments.channel.empty();
  if (format == TextureFormat::raw && chosen)
    throw UsageError("raw files hold the whole texture: leave out --slice, --atlas and --channel");
  const std::vector<int> channels = channelsNamed(arguments.channel.empty() ? "rgb" : arguments.channel, recipe);
  const Volume volume = generate(recipe, arguments.sky.scene().noise, arguments.route);
  const int slice = arguments.slice.value_or(0);
  if (slice >= volume.depth)
    throw UsageError(fmt::format("--slice {}: {} has slices 0 to {}", slice, recipe.name, volume.depth - 1));
  if (format == TextureFormat::raw) {
    saveTextureRaw(arguments.output, volume);
  } else {
    const Volume shown = channelsOf(volume, channels);
    saveTexturePicture(arguments.output, arguments.atlas ? atlasOf(shown) : sliceOf(shown, slice), recipe.scale);
  }
  printSummary(recipe, volume);
  if (format == TextureFormat::picture)
    fmt::print("black is {:g}, white {:g}\n", recipe.scale.black, recipe.scale.white);
}

}  // namespace

void addNoise(CLI::App& app) {
  auto* command = app.add_subcommand("noise", "a noise texture as a picture or as raw floats");
  auto arguments = std::make_shared<NoiseArguments>();
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) names.emplace_back(recipe.name);
  command->add_option("texture", arguments->texture, "which texture")
      ->type_name("TEXTURE")
      ->required()
      ->check(CLI::IsMember(names));
  arguments->sky.addTo(*command, SkyArguments::Need::optional);
  command
      ->add_option("-o,--output", arguments->output,
                   "a 16-bit picture (.png) or raw floats (.f32, with a .f32.json header beside it)")
      ->type_name("FILE")
      ->required();
  auto* slice =
      command->add_option("--slice", arguments->slice, "which slice of the volume the picture shows; 0 if not given")
          ->type_name("K")
          ->check(CLI::Range(0, 4096));
  command->add_flag("--atlas", arguments->atlas, "all slices side by side")->excludes(slice);
  command->add_option("--channel", arguments->channel, "which channels the picture shows: rgb, rgba, or one in grey")
      ->type_name("NAME")
      ->check(CLI::IsMember({"rgb", "rgba", "r", "g", "b", "a"}));
  command->add_flag("--raw", arguments->raw, "raw floats, whatever the file is called");
  command->add_option("--route", arguments->route, "what generates it: cpu, or gpu as half floats")
      ->type_name("NAME")
      ->check(CLI::IsMember({"cpu", "gpu"}))
      ->capture_default_str();
  command->callback([arguments] { writeNoise(*arguments); });
}

}  // namespace welkin::app
