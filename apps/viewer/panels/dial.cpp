#include "apps/viewer/panels/dial.hpp"

#include <algorithm>

namespace welkin::viewer {

Dial beginDial(Workbench& bench, const char* name, float size) {
  const float room = ImGui::GetContentRegionAvail().x;
  const float edge = std::max(std::min(size * ImGui::GetFontSize(), room), 1.0f);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5f * (room - edge));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(name, {edge, edge});
  bench.interface.items.mark(name);
  if (ImGui::IsItemActivated()) bench.document.beginGesture();
  if (ImGui::IsItemDeactivated()) bench.document.endGesture();
  Dial dial;
  dial.list = ImGui::GetWindowDrawList();
  dial.centre = {corner.x + 0.5f * edge, corner.y + 0.5f * edge};
  dial.radius = std::max(0.5f * edge - 1.1f * ImGui::GetFontSize(), 1.0f);
  dial.active = ImGui::IsItemActive();
  return dial;
}

void drawCompass(const Dial& dial) {
  const float away = dial.radius + 0.55f * ImGui::GetFontSize();
  const auto letter = [&](const char* text, float x, float y) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    dial.list->AddText({dial.centre.x + x * away - 0.5f * size.x, dial.centre.y + y * away - 0.5f * size.y},
                       ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
  };
  letter("N", 0.0f, -1.0f);
  letter("E", 1.0f, 0.0f);
  letter("S", 0.0f, 1.0f);
  letter("W", -1.0f, 0.0f);
}

}  // namespace welkin::viewer
