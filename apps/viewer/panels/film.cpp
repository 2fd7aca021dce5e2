// From light to a picture: exposure, white balance, tone curve, and what the picture holds.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"
#include "welkin/base/tone.hpp"

namespace welkin::viewer {

namespace {

constexpr float kStops = 8.0f;  // to each side of middle grey
constexpr int kBins = 64;

// How many pixels are how bright, in stops from middle grey; the largest is 1.
std::array<float, kBins> histogramOf(const Image& light, double ev) {
  const double grey = 0.18 * 1.2 * std::exp2(ev) / 1000.0;  // kcd/m^2
  std::array<float, kBins> bins{};
  for (std::size_t i = 0; i + 2 < light.pixels.size(); i += 3) {
    const float y = law::luminanceOf({light.pixels[i], light.pixels[i + 1], light.pixels[i + 2]});
    if (!(y > 0.0f)) continue;
    const double stops = std::log2(y / grey);
    const double at = (stops + kStops) / (2.0 * kStops) * kBins;
    ++bins[static_cast<std::size_t>(std::clamp(at, 0.0, kBins - 1.0))];
  }
  const float most = *std::max_element(bins.begin(), bins.end());
  for (float& b : bins) b = most > 0.0f ? b / most : 0.0f;
  return bins;
}

// The curve of greys: stops of light from left to right, what the screen shows upward.
void drawCurve(Workbench& bench) {
  const Film film = bench.film;
  const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = 9.0f * ImGui::GetFontSize();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##curve", {width, height});
  bench.interface.items.mark("tone curve");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "grey light from left to right, a stop a line; what the screen shows of it, upward;\n"
        "bars: how bright the picture's pixels are");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + width, low.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), 4.0f);
  const float ev = film.ev - film.compensation;
  const std::array<float, kBins> bins = histogramOf(bench.picture.meter(), ev);
  for (int i = 0; i < kBins; ++i) {
    const float x = low.x + width * static_cast<float>(i) / kBins;
    list.AddRectFilled({x, low.y + height * (1.0f - 0.9f * bins[static_cast<std::size_t>(i)])},
                       {x + width / kBins, low.y + height}, IM_COL32(120, 150, 190, 90));
  }
  for (int stop = -7; stop <= 7; ++stop) {
    const float x = low.x + width * (static_cast<float>(stop) + kStops) / (2.0f * kStops);
    list.AddLine({x, low.y}, {x, low.y + height}, IM_COL32(255, 255, 255, stop == 0 ? 70 : 22));
  }
  const law::ToneParameters tone =
      toneParameters({.ev = ev, .whiteBalance = 6504.0f, .saturation = film.saturation, .curve = film.tone});
  const float grey = 0.18f * 1.2f * std::exp2(ev) / 1000.0f;
  ImVec2 before{};
  constexpr int kPoints = 96;
  for (int i = 0; i <= kPoints; ++i) {
    const float share = static_cast<float>(i) / kPoints;
    const float light = grey * std::exp2((2.0f * share - 1.0f) * kStops);
    const float shown = law::toneMap(glm::vec3(light), tone).y;
    const ImVec2 at{low.x + width * share, low.y + height * (1.0f - shown)};
    if (i > 0) list.AddLine(before, at, IM_COL32(255, 215, 120, 255), 2.0f);
    before = at;
  }
}

}  // namespace

void drawFilm(Workbench& bench) {
  ImGui::BeginChild("##film");
  drawCurve(bench);
  if (bench.document.scene().film.exposure == ExposureMode::automatic)
    ImGui::TextDisabled("the meter says EV %.1f", static_cast<double>(bench.film.ev));
  drawSection(bench, "film");
  if (ImGui::Button("save picture…")) bench.perform(Action::savePicture, "");
  bench.interface.items.mark("save picture");
  ImGui::EndChild();
}

}  // namespace welkin::viewer
