// The wind rose, and time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/viewer/panels/dial.hpp"
#include "apps/viewer/panels/panels.hpp"
#include "welkin/scene/animation.hpp"

namespace welkin::viewer {

namespace {

constexpr float kFastest = 60.0f;  // m/s at the rim
constexpr float kDegrees = 180.0f / std::numbers::pi_v<float>;

// An arrow that blows from the rim inward: it begins where the wind comes from, and ends in the middle.
void drawArrow(const Dial& dial, float from, float speed, ImU32 colour, float width) {
  const float share = std::clamp(speed / kFastest, 0.0f, 1.0f) * dial.radius;
  const ImVec2 tail{dial.centre.x + share * std::sin(from), dial.centre.y - share * std::cos(from)};
  dial.list->AddLine(tail, dial.centre, colour, width);
  const float head = 0.45f * ImGui::GetFontSize();
  const auto wing = [&](float turn) {
    return ImVec2{dial.centre.x + head * std::sin(from + turn), dial.centre.y - head * std::cos(from + turn)};
  };
  dial.list->AddTriangleFilled(dial.centre, wing(0.45f), wing(-0.45f), colour);
  dial.list->AddCircleFilled(tail, 1.6f * width, colour);
}

void drawRose(Workbench& bench) {
  const Scene& scene = bench.document.scene();
  const Dial dial = beginDial(bench, "wind rose", 14.0f);
  dial.list->AddCircleFilled(dial.centre, dial.radius, IM_COL32(30, 42, 60, 255), 64);
  for (const float ring : {20.0f, 40.0f, 60.0f}) {
    const float r = dial.radius * ring / kFastest;
    dial.list->AddCircle(dial.centre, r, IM_COL32(255, 255, 255, 45), 64);
    dial.list->AddText({dial.centre.x + 3.0f, dial.centre.y - r}, IM_COL32(255, 255, 255, 90),
                       fmt::format("{:.0f}", ring).c_str());
  }
  drawCompass(dial);
  for (const Sheet& sheet : scene.sheets)
    drawArrow(dial, sheet.windFrom, sheet.windSpeed, IM_COL32(190, 200, 255, 130), 2.0f);
  drawArrow(dial, scene.wind.from, scene.wind.speed, IM_COL32(130, 205, 255, 255), 4.0f);
  if (ImGui::IsItemHovered() && !dial.active)
    ImGui::SetTooltip("drag: where the wind comes from, and how fast (m/s)%s",
                      scene.sheets.empty() ? "" : "\nthin: winds of the sheets");
  if (!dial.active) return;
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const float x = pointer.x - dial.centre.x, y = dial.centre.y - pointer.y;
  const float from = std::atan2(x, y) * kDegrees;
  bench.document.set("wind", "from", static_cast<double>(from < 0.0f ? from + 360.0f : from));
  bench.document.set("wind", "speed",
                     static_cast<double>(std::clamp(std::hypot(x, y) / dial.radius, 0.0f, 1.0f) * kFastest));
}

void drawTime(Workbench& bench) {
  if (ImGui::Button(bench.playing ? "stop" : "let time run")) bench.perform(Action::play, "");
  bench.interface.items.mark("let time run");
  ImGui::SameLine();
  if (ImGui::Button("to 0")) bench.perform(Action::resetTime, "");
  bench.interface.items.mark("time to 0");
  ImGui::SameLine();
  const Scene& scene = bench.document.scene();
  double last = 0.0;
  for (const Keyframe& k : scene.keyframes) last = std::max(last, k.time);
  if (last > 0.0 && hasKeyframes(scene, "camera.")) {
    ImGui::Checkbox("camera by keyframes", &bench.cameraByKeyframes);
    bench.interface.items.mark("camera by keyframes");
  } else {
    ImGui::NewLine();
  }
  float time = scene.time;
  ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6.0f);
  if (ImGui::SliderFloat("time", &time, 0.0f, last > 0.0 ? static_cast<float>(last) : 3600.0f, "%.1f s"))
    bench.document.moveTime(std::clamp(time, 0.0f, 1e7f));
  bench.interface.items.mark("time");
  if (last > 0.0 && ImGui::IsItemHovered()) ImGui::SetTooltip("%zu keyframes, to %.1f s", scene.keyframes.size(), last);
  ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6.0f);
  ImGui::SliderFloat("time-lapse", &bench.timeRate, 1.0f, 300.0f, "%.0f x", ImGuiSliderFlags_Logarithmic);
  bench.interface.items.mark("time-lapse");
}

}  // namespace

void drawWind(Workbench& bench) {
  ImGui::BeginChild("##wind");
  drawRose(bench);
  drawSection(bench, "wind");
  for (std::size_t i = 0; i < bench.document.scene().sheets.size(); ++i) {
    ImGui::TextDisabled("sheet %zu", i);
    const std::string path = fmt::format("sheet.{}", i);
    for (const Section& section : bench.document.sections())
      if (section.path == path)
        for (const char* name : {"wind_speed", "wind_from"}) drawField(bench, section, *findField(section, name));
  }
  ImGui::Separator();
  drawTime(bench);
  ImGui::EndChild();
}

}  // namespace welkin::viewer
