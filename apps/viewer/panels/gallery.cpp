// The skies that come with Welkin, as pictures.
#include <algorithm>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// Returns whether it was chosen, by mouse or keyboard.
bool drawCard(Workbench& bench, std::size_t index, float width) {
  const PresetFile& preset = bench.options.presets[index];
  const float height = width * Thumbnails::kHeight / Thumbnails::kWidth;
  ImGui::BeginGroup();
  ImGui::PushID(static_cast<int>(index));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool chosen = ImGui::InvisibleButton("##card", {width, height + ImGui::GetTextLineHeightWithSpacing()});
  bench.interface.items.mark("preset " + preset.name);
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemFocused();
  if (ImGui::IsItemHovered()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0f);
    ImGui::TextUnformatted(preset.sentence.c_str());
    if (!bench.thumbnails.trouble(index).empty()) ImGui::TextDisabled("%s", bench.thumbnails.trouble(index).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = corner, high{corner.x + width, corner.y + height};
  if (const unsigned texture = bench.thumbnails.texture(index)) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's backend takes a texture's name as a pointer.
    list.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), low, high, {0, 0}, {1, 1},
                         0xffffffff, 5.0f);
  } else {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 5.0f);
  }
  const bool current = bench.document.origin().name == preset.name;
  if (lit || current)
    list.AddRect(low, high, ImGui::GetColorU32(current ? ImGuiCol_CheckMark : ImGuiCol_NavHighlight), 5.0f, 0, 2.0f);
  const std::string name = spaced(preset.name);
  list.PushClipRect(low, {high.x, high.y + ImGui::GetTextLineHeightWithSpacing()}, true);
  list.AddText({corner.x + 2.0f, high.y + 1.0f}, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
  list.PopClipRect();
  ImGui::PopID();
  ImGui::EndGroup();
  return chosen;
}

}  // namespace

void drawGallery(Workbench& bench) {
  if (bench.options.presets.empty()) {
    ImGui::TextWrapped("No presets were found beside the program; WELKIN_PRESETS may name their folder.");
    return;
  }
  bench.thumbnails.start();
  ImGui::Checkbox("keep camera", &bench.keepCamera);
  bench.interface.items.mark("keep camera");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("another sky, seen from here");
  if (!bench.thumbnails.complete()) {
    ImGui::SameLine();
    ImGui::TextDisabled("drawing pictures …");
  }
  ImGui::BeginChild("##gallery");
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>(std::floor(room / (ImGui::GetFontSize() * 11.0f))));
  const float width =
      std::max(std::floor((room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns)), 1.0f);
  for (std::size_t i = 0; i < bench.options.presets.size(); ++i) {
    if (static_cast<int>(i) % columns != 0) ImGui::SameLine();
    if (drawCard(bench, i, width)) bench.openPreset(bench.options.presets[i]);
  }
  ImGui::EndChild();
}

}  // namespace welkin::viewer
