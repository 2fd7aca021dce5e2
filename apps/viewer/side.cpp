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

void Viewer::drawTabs() {
  if (!ImGui::BeginTabBar("##tabs", ImGuiTabBarFlags_FittingPolicyScroll)) return;
  for (const TabInfo& info : kTabs) {
    // The aircraft is the camera, and the reference knows nothing of it.
    if (flight_ && (info.tab == Tab::camera || info.tab == Tab::reference)) continue;
    if (bench_.mapShown && info.tab == Tab::reference) continue;
    const bool wanted = bench_.wantedTab == info.tab;
    const bool shown =
        ImGui::BeginTabItem(info.title, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None);
    interface_.items.mark(std::string("tab ") + info.title);
    if (!shown) continue;
    // A tab that is asked for is there in the next frame; what stands in its place, the gallery at first, would begin
    // its work in vain.
    if (!bench_.wantedTab || wanted) {
      bench_.tab = info.tab;
      info.draw(bench_);
    }
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
  bench_.wantedTab.reset();
}

}  // namespace welkin::viewer
