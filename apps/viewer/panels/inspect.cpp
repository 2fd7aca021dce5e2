// What clouds are made of: the noise textures, and cuts through the density.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"
#include "welkin/gl/state.hpp"
#include "welkin/realtime/noise_textures.hpp"

namespace welkin::viewer {

namespace {

struct Recipe {
  const char* name;
  int channels;
  float black, white;
  gl::Texture (*make)(const gl::Api& gl, const NoiseSettings& noise);
};
constexpr Recipe kRecipes[] = {
    {"profile base", 2, 0, 1,
     [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateProfileBase(gl, n.profile); }},
    {"profile detail", 2, 0, 1,
     [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateProfileDetail(gl, n.profile); }},
    {"profile warp", 2, 0, 1,
     [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateProfileWarp(gl, n.profile); }},
    {"base shape", 4, 0, 1,
     [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateBaseShape(gl, n.baseShape); }},
    {"detail", 3, 0, 1,
     [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateDetail(gl, n.detail); }},
    {"curl", 2, -1, 1, [](const gl::Api& gl, const NoiseSettings& n) { return realtime::generateCurl(gl, n.curl); }}};

bool sameNoise(const NoiseSettings& a, const NoiseSettings& b) {
  return sameFields(a.profile, b.profile) && sameFields(a.baseShape, b.baseShape) && sameFields(a.detail, b.detail) &&
         sameFields(a.curl, b.curl);
}

void makeNoise(Workbench& bench) {
  NoiseDesk& desk = bench.noise;
  const NoiseSettings& now = bench.document.scene().noise;
  if (desk.made == desk.texture && sameNoise(desk.madeWith, now)) return;
  const gl::StateGuard guard(desk.gl);
  for (const GLenum off : {GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST}) desk.gl.Disable(off);
  const Recipe& recipe = kRecipes[desk.texture];
  desk.volume = realtime::volumeFromTexture(desk.gl, recipe.make(desk.gl, now), recipe.channels);
  desk.made = desk.texture;
  desk.madeWith = now;
  desk.shown = -1;
}

// A slice of one channel, grey; the first row is that of v = 0, which is drawn below.
void showNoise(NoiseDesk& desk) {
  const Recipe& recipe = kRecipes[desk.texture];
  desk.channel = std::clamp(desk.channel, 0, recipe.channels - 1);
  const int slice =
      std::clamp(static_cast<int>(desk.depth * static_cast<float>(desk.volume.depth)), 0, desk.volume.depth - 1);
  const int key = slice * 4 + desk.channel;
  if (desk.shown == key) return;
  desk.shown = key;
  const Volume& v = desk.volume;
  std::vector<std::uint8_t> rgba;
  rgba.reserve(static_cast<std::size_t>(v.width) * v.height * 4);
  for (int y = v.height - 1; y >= 0; --y)
    for (int x = 0; x < v.width; ++x) {
      const float share = (v.at(x, y, slice)[desk.channel] - recipe.black) / (recipe.white - recipe.black);
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
      rgba.insert(rgba.end(), {grey, grey, grey, 255});
    }
  desk.image.set(v.width, v.height, rgba);
}

void drawNoise(Workbench& bench) {
  NoiseDesk& desk = bench.noise;
  const float label = -5.0f * ImGui::GetFontSize();
  ImGui::SetNextItemWidth(label);
  if (ImGui::BeginCombo("texture", kRecipes[desk.texture].name)) {
    for (int i = 0; i < static_cast<int>(std::size(kRecipes)); ++i) {
      if (ImGui::Selectable(kRecipes[i].name, i == desk.texture)) desk.texture = i;
      bench.interface.items.mark(std::string("noise=") + kRecipes[i].name);
    }
    ImGui::EndCombo();
  }
  bench.interface.items.mark("noise");
  makeNoise(bench);
  for (int i = 0; i < kRecipes[desk.texture].channels; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(std::string(1, "rgba"[i]).c_str(), desk.channel == i)) desk.channel = i;
    bench.interface.items.mark(std::string("noise channel ") + "rgba"[i]);
  }
  if (desk.volume.depth > 1) {
    ImGui::SetNextItemWidth(label);
    ImGui::SliderFloat("depth", &desk.depth, 0.0f, 1.0f, "%.2f");
    bench.interface.items.mark("noise depth");
  }
  showNoise(desk);
  const float edge = std::max(std::min(ImGui::GetContentRegionAvail().x, 18.0f * ImGui::GetFontSize()), 1.0f);
  ImGui::Image(desk.image.texture(), {edge, edge});
  bench.interface.items.mark("noise image");
  ImGui::TextDisabled("%dx%dx%d, %g is black, %g white; it repeats", desk.volume.width, desk.volume.height,
                      desk.volume.depth, static_cast<double>(kRecipes[desk.texture].black),
                      static_cast<double>(kRecipes[desk.texture].white));
}

// As much of the sky as a cut depends on, and the plane.
std::string keyOf(const Workbench& bench) {
  const Scene& scene = bench.document.scene();
  const Camera& camera = scene.camera;
  const SlicePlane& p = bench.slice.plane;
  return fmt::format("{} {} {} {} {} {} {} {} {} {}", bench.document.revision(), bench.texturesNumber,
                     camera.position.x, camera.position.y, p.upright ? camera.heading : 0.0f, scene.time, p.upright,
                     p.edge, p.altitude, p.top);
}

void drawSlice(Workbench& bench) {
  SliceDesk& desk = bench.slice;
  if (ImGui::RadioButton("upright, where the camera looks", desk.plane.upright)) desk.plane.upright = true;
  bench.interface.items.mark("slice upright");
  ImGui::SameLine();
  if (ImGui::RadioButton("level", !desk.plane.upright)) desk.plane.upright = false;
  bench.interface.items.mark("slice level");
  const auto slider = [&](const char* name, double& metres, float low, float high) {
    auto kilometres = static_cast<float>(metres / 1000.0);
    ImGui::SetNextItemWidth(-5.0f * ImGui::GetFontSize());
    if (ImGui::SliderFloat(name, &kilometres, low, high, "%.2f km", ImGuiSliderFlags_Logarithmic))
      metres = 1000.0 * static_cast<double>(std::clamp(kilometres, low, high));
    bench.interface.items.mark(std::string("slice ") + name);
  };
  slider("width", desk.plane.edge, 0.5f, 200.0f);
  if (desk.plane.upright)
    slider("top", desk.plane.top, 0.2f, 20.0f);
  else
    slider("altitude", desk.plane.altitude, 0.01f, 20.0f);
  if (std::string key = keyOf(bench); key != desk.askedFor) {
    desk.askedFor = std::move(key);
    desk.slice.ask(bench.document.scene(), bench.textures, desk.plane);
  }
  const SlicePicture& picture = desk.slice.picture();
  if (!picture.trouble.empty()) return ImGui::TextWrapped("%s", picture.trouble.c_str());
  if (!desk.image) return ImGui::TextDisabled("cutting ...");
  const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
  ImGui::Image(desk.image.texture(),
               {width, width * static_cast<float>(picture.height) / static_cast<float>(picture.width)});
  bench.interface.items.mark("slice image");
  ImGui::TextDisabled("black no cloud, white %.3f 1/m; not true to scale upright", static_cast<double>(picture.most));
}

}  // namespace

void drawInspect(Workbench& bench) {
  ImGui::BeginChild("##inspect");
  if (ImGui::CollapsingHeader("density", ImGuiTreeNodeFlags_DefaultOpen)) drawSlice(bench);
  bench.interface.items.mark("section slice");
  if (ImGui::CollapsingHeader("noise textures", ImGuiTreeNodeFlags_DefaultOpen)) drawNoise(bench);
  bench.interface.items.mark("section noise textures");
  ImGui::EndChild();
}

}  // namespace welkin::viewer
