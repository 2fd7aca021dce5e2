// The weather of a layer from above, and the brush that paints it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"
#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

constexpr int kNewPicture = 512;                           // texels a side of a map that is begun here
constexpr double kNearest = 4000.0, kFarthest = 400000.0;  // m, edge of what is shown

const Volume* mapOf(const Workbench& bench) {
  const std::vector<Volume>& maps = bench.textures.weatherMaps;
  return bench.weather.layer < maps.size() && !maps[bench.weather.layer].texels.empty() ? &maps[bench.weather.layer]
                                                                                        : nullptr;
}

Drift driftOf(const Scene& scene) { return {scene.wind.speed, scene.wind.from, scene.time}; }

// Made anew when something changes that it shows.
void updateImage(Workbench& bench) {
  WeatherDesk& desk = bench.weather;
  const Scene& scene = bench.document.scene();
  const WeatherView& view = desk.view;
  std::string key =
      fmt::format("{} {} {} {} {} {} {} {} {}", bench.document.revision(), bench.texturesNumber, desk.layer,
                  view.centre.x, view.centre.y, view.edge, view.channel, view.clouds, scene.time);
  if (key == desk.imageOf && desk.image) return;
  desk.imageOf = std::move(key);
  // A map that has just been named is read before the next frame.
  const Layer& layer = scene.layers[desk.layer];
  if (!layer.weather.map.empty() && !mapOf(bench)) return;
  desk.image.set(view.size, view.size, weatherImage(layer, mapOf(bench), driftOf(scene), scene.seed, view));
}

// Why the layer cannot be painted, or null.
const char* unpaintable(const Workbench& bench) {
  const Layer& layer = bench.document.scene().layers[bench.weather.layer];
  if (layer.weather.map.empty() || bench.document.weatherPicture(bench.weather.layer)) return nullptr;
  return mapOf(bench) ? "This map is too large to be painted." : "The map's picture cannot be read.";
}

// Paints on to a place of the world.
void paint(Workbench& bench, const glm::dvec2& place) {
  WeatherDesk& desk = bench.weather;
  const Scene& scene = bench.document.scene();
  const WeatherSettings& weather = scene.layers[desk.layer].weather;
  const Document::WeatherPicturePointer now = bench.document.weatherPicture(desk.layer);
  auto next =
      now ? std::make_shared<WeatherPicture>(*now)
          : std::make_shared<WeatherPicture>(kNewPicture, kNewPicture,
                                             glm::vec4(weather.coverage, weather.precipitation, weather.type, 0.0f));
  Brush brush = desk.brush;
  brush.erases ^= ImGui::GetIO().KeyShift;
  if (desk.stroke->follow(*next, brush, static_cast<double>(weather.mapSize), place - driftOffset(driftOf(scene))))
    bench.document.paintWeather(desk.layer, std::move(next));
}

struct MapCanvas {
  ImVec2 corner{};
  float edge = 1.0f;
  ImVec2 pointOf(const WeatherView& view, const glm::dvec2& place) const {
    const glm::vec2 share((place - view.centre) / view.edge);
    return {corner.x + (0.5f + share.x) * edge, corner.y + (0.5f - share.y) * edge};
  }
  glm::dvec2 placeOf(const WeatherView& view, const ImVec2& point) const {
    return view.centre + view.edge * glm::dvec2((point.x - corner.x) / edge - 0.5f, 0.5f - (point.y - corner.y) / edge);
  }
};

// The camera and the way it looks, and the scale.
void drawMarks(const Workbench& bench, const MapCanvas& canvas) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Camera& camera = bench.document.scene().camera;
  const WeatherView& view = bench.weather.view;
  const ImVec2 eye = canvas.pointOf(view, glm::dvec2(camera.position));
  const float reach = 1.6f * ImGui::GetFontSize();
  for (const float side : {-0.5f, 0.5f}) {
    const float heading = camera.heading + side * camera.fov;
    list.AddLine(eye, {eye.x + reach * std::sin(heading), eye.y - reach * std::cos(heading)},
                 IM_COL32(255, 225, 140, 255), 2.0f);
  }
  list.AddCircleFilled(eye, 3.5f, IM_COL32(255, 225, 140, 255));
  // A round length, a fifth to a half of the edge.
  double length = std::pow(10.0, std::floor(std::log10(0.5 * view.edge)));
  if (5.0 * length < 0.5 * view.edge)
    length *= 5.0;
  else if (2.0 * length < 0.5 * view.edge)
    length *= 2.0;
  const float wide = canvas.edge * static_cast<float>(length / view.edge), inset = 0.6f * ImGui::GetFontSize();
  const ImVec2 left{canvas.corner.x + inset, canvas.corner.y + canvas.edge - inset};
  list.AddLine(left, {left.x + wide, left.y}, IM_COL32(255, 255, 255, 230), 2.0f);
  list.AddText({left.x, left.y - 1.4f * ImGui::GetFontSize()}, IM_COL32(255, 255, 255, 230),
               (length < 1000.0 ? fmt::format("{:.0f} m", length) : fmt::format("{:.0f} km", length / 1000.0)).c_str());
  list.AddText({canvas.corner.x + 0.5f * canvas.edge - 5.0f, canvas.corner.y + 2.0f}, IM_COL32(255, 255, 255, 160),
               "N");
}

void drawMap(Workbench& bench) {
  WeatherDesk& desk = bench.weather;
  // As high as the controls below leave room for.
  const ImVec2 room = ImGui::GetContentRegionAvail();
  MapCanvas canvas;
  canvas.edge =
      std::max(std::min(room.x, room.y - 13.0f * ImGui::GetFrameHeightWithSpacing()), 4.0f * ImGui::GetFontSize());
  canvas.corner = ImGui::GetCursorScreenPos();
  canvas.corner.x += std::max(0.5f * (room.x - canvas.edge), 0.0f);
  ImGui::SetCursorScreenPos(canvas.corner);
  ImGui::InvisibleButton("weather map", {canvas.edge, canvas.edge});
  bench.interface.items.mark("weather map");
  const bool over = ImGui::IsItemHovered(), down = ImGui::IsItemActive();
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  if (over && ImGui::GetIO().MouseWheel != 0.0f)
    desk.view.edge = std::clamp(desk.view.edge * std::exp(-0.15 * static_cast<double>(ImGui::GetIO().MouseWheel)),
                                kNearest, kFarthest);
  // The map lies still while it is painted.
  if (!down) desk.view.centre = glm::dvec2(bench.document.scene().camera.position);
  const char* trouble = unpaintable(bench);
  if (ImGui::IsItemActivated() && !trouble) {
    bench.document.beginGesture();
    desk.stroke.emplace();
  }
  if (down && desk.stroke) paint(bench, canvas.placeOf(desk.view, pointer));
  if (ImGui::IsItemDeactivated() && desk.stroke) {
    desk.stroke.reset();
    bench.document.endGesture();
  }
  updateImage(bench);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{canvas.corner.x + canvas.edge, canvas.corner.y + canvas.edge};
  list.PushClipRect(canvas.corner, end, true);
  if (desk.image) list.AddImage(desk.image.texture(), canvas.corner, end);
  drawMarks(bench, canvas);
  if (over || down)
    list.AddCircle(pointer, canvas.edge * desk.brush.radius / static_cast<float>(desk.view.edge),
                   IM_COL32(255, 255, 255, 220), 48, 1.5f);
  list.PopClipRect();
  if (trouble) ImGui::TextColored({1.0f, 0.55f, 0.45f, 1.0f}, "%s", trouble);
}

void drawBrush(Workbench& bench) {
  WeatherDesk& desk = bench.weather;
  for (std::size_t i = 0; i < kWeatherChannels.size(); ++i) {
    const int channel = static_cast<int>(i);
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(kWeatherChannels[i], desk.brush.channel == channel)) desk.brush.channel = channel;
    bench.interface.items.mark(std::string("brush ") + kWeatherChannels[i]);
  }
  desk.view.channel = desk.brush.channel;
  if (ImGui::RadioButton("add", !desk.brush.erases)) desk.brush.erases = false;
  bench.interface.items.mark("brush add");
  ImGui::SameLine();
  if (ImGui::RadioButton("erase", desk.brush.erases)) desk.brush.erases = true;
  bench.interface.items.mark("brush erase");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("or Shift while painting");
  ImGui::SameLine();
  ImGui::Checkbox("show clouds", &desk.view.clouds);
  bench.interface.items.mark("weather clouds");
  const float label = -5.0f * ImGui::GetFontSize();
  float kilometres = desk.brush.radius / 1000.0f;
  ImGui::SetNextItemWidth(label);
  if (ImGui::SliderFloat("radius", &kilometres, 0.1f, 50.0f, "%.1f km", ImGuiSliderFlags_Logarithmic))
    desk.brush.radius = 1000.0f * std::clamp(kilometres, 0.01f, 1000.0f);
  bench.interface.items.mark("brush radius");
  ImGui::SetNextItemWidth(label);
  if (ImGui::SliderFloat("strength", &desk.brush.strength, 0.02f, 1.0f, "%.2f"))
    desk.brush.strength = std::clamp(desk.brush.strength, 0.0f, 1.0f);
  bench.interface.items.mark("brush strength");
}

void chooseLayer(Workbench& bench, std::size_t layers) {
  for (std::size_t i = 0; i < layers; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(fmt::format("layer {}", i).c_str(), bench.weather.layer == i)) bench.weather.layer = i;
    bench.interface.items.mark(fmt::format("weather layer {}", i));
  }
}

}  // namespace

void drawWeather(Workbench& bench) {
  const std::size_t layers = bench.document.scene().layers.size();
  if (layers == 0) {
    ImGui::TextWrapped("This sky has no layer whose weather could be painted; + layer under Sky adds one.");
    return;
  }
  bench.weather.layer = std::min(bench.weather.layer, layers - 1);
  ImGui::BeginChild("##weather");
  if (layers > 1) chooseLayer(bench, layers);
  drawMap(bench);
  drawBrush(bench);
  ImGui::Separator();
  const std::string path = fmt::format("layer.{}.weather", bench.weather.layer);
  for (const Section& section : bench.document.sections())
    if (section.path == path)
      for (const char* name : {"map", "map_size", "map_base_range", "coverage"})
        drawField(bench, section, *findField(section, name));
  ImGui::EndChild();
}

}  // namespace welkin::viewer
