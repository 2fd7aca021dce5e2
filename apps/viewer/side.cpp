// The panels' place in the window.
#include <algorithm>

#include "apps/viewer/frame_loop.hpp"
#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

struct TabInfo {
  Tab tab;
  Action action;
  const char* title;
  void (*draw)(Workbench& bench);
};
constexpr TabInfo kTabs[] = {{Tab::gallery, Action::gallery, "Gallery", drawGallery},
                             {Tab::parameters, Action::parameters, "Sky", drawParameters},
                             {Tab::sun, Action::sun, "Sun", drawSun},
                             {Tab::wind, Action::wind, "Wind", drawWind},
                             {Tab::weather, Action::weather, "Weather", drawWeather},
                             {Tab::camera, Action::camera, "Camera", drawCamera},
                             {Tab::film, Action::film, "Film", drawFilm},
                             {Tab::pace, Action::pace, "Pace", drawPace},
                             {Tab::inspect, Action::inspect, "Inspect", drawInspect},
                             {Tab::reference, Action::reference, "Trace", drawReference}};

}  // namespace

std::optional<Tab> tabOf(Action action) {
  for (const TabInfo& info : kTabs)
    if (info.action == action) return info.tab;
  return std::nullopt;
}

void Viewer::drawPanels() {
  if (!bench_.panels) return;
  drawMenu(bench_);
  drawStatus(bench_);
  const float bar = ImGui::GetFrameHeight();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (panelWidth_ == 0.0f) panelWidth_ = std::min(ImGui::GetFontSize() * 31.0f, 0.5f * screen.x);
  ImGui::SetNextWindowPos({0.0f, bar});
  ImGui::SetNextWindowSizeConstraints({1.0f, 1.0f}, {screen.x * 0.8f, screen.y});
  ImGui::SetNextWindowSize({panelWidth_, std::max(screen.y - 2.0f * bar, 1.0f)});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin(kSide, nullptr, kFlags)) drawTabs();
  panelWidth_ = ImGui::GetWindowWidth();
  ImGui::End();
  drawFiles(bench_);
  if (!reference_.texture() || bench_.comparison != Comparison::wipe) return;
  const Region part = region();
  const float x = static_cast<float>(part.x) + bench_.wipe * static_cast<float>(part.width);
  const float top = screen.y - static_cast<float>(part.y + part.height), bottom = screen.y - static_cast<float>(part.y);
  ImGui::GetBackgroundDrawList()->AddLine({x, top}, {x, bottom}, IM_COL32(255, 255, 255, 200), 1.5f);
}

// In as many rows as they need: a bar that scrolls would hide half of them.
void Viewer::drawTabs() {
  const auto fits = [&](Tab tab) {
    // The aircraft is the camera, and the reference knows nothing of it.
    if (flight_ && (tab == Tab::camera || tab == Tab::reference)) return false;
    return !(bench_.mapShown && tab == Tab::reference);
  };
  if (bench_.wantedTab && fits(*bench_.wantedTab)) bench_.tab = *bench_.wantedTab;
  bench_.wantedTab.reset();
  if (!fits(bench_.tab)) bench_.tab = Tab::parameters;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  bool first = true;
  for (const TabInfo& info : kTabs) {
    if (!fits(info.tab)) continue;
    const float width = ImGui::CalcTextSize(info.title).x + 2.0f * style.FramePadding.x;
    if (!first && ImGui::GetItemRectMax().x + style.ItemInnerSpacing.x + width < right)
      ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
    first = false;
    ImGui::PushStyleColor(ImGuiCol_Button, style.Colors[info.tab == bench_.tab ? ImGuiCol_TabActive : ImGuiCol_Tab]);
    if (ImGui::Button(info.title)) bench_.tab = info.tab;
    ImGui::PopStyleColor();
    interface_.items.mark(std::string("tab ") + info.title);
  }
  ImGui::Separator();
  for (const TabInfo& info : kTabs)
    if (info.tab == bench_.tab) {
      ImGui::PushID(info.title);
      info.draw(bench_);
      ImGui::PopID();
    }
}

}  // namespace welkin::viewer
