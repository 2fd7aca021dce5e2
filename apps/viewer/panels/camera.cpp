// The camera: how it moves, where it has been.
#include <fmt/format.h>

#include <numbers>

#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

void drawMode(Workbench& bench) {
  NavigationMode& mode = bench.navigation.mode;
  if (ImGui::RadioButton("look and fly", mode == NavigationMode::look)) mode = NavigationMode::look;
  bench.interface.items.mark("look and fly");
  ImGui::SameLine();
  if (ImGui::RadioButton("orbit", mode == NavigationMode::orbit)) mode = NavigationMode::orbit;
  bench.interface.items.mark("orbit");
  if (mode == NavigationMode::orbit) {
    float kilometres = static_cast<float>(bench.navigation.pivotDistance / 1000.0);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 7.0f);
    if (ImGui::SliderFloat("pivot ahead", &kilometres, 0.05f, 100.0f, "%.2f km", ImGuiSliderFlags_Logarithmic))
      bench.navigation.pivotDistance = 1000.0 * static_cast<double>(kilometres);
    bench.interface.items.mark("pivot");
  }
  bool byHeight = bench.navigation.speed <= 0.0f;
  if (ImGui::Checkbox("speed by height", &byHeight))
    bench.navigation.speed =
        byHeight ? 0.0f : static_cast<float>(bench.navigation.speedOf(bench.document.scene().camera));
  bench.interface.items.mark("speed by height");
  if (!byHeight) {
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 7.0f);
    ImGui::SliderFloat("speed", &bench.navigation.speed, 1.0f, 5000.0f, "%.0f m/s", ImGuiSliderFlags_Logarithmic);
    bench.interface.items.mark("speed");
  } else {
    ImGui::SameLine();
    ImGui::TextDisabled("%.0f m/s", bench.navigation.speedOf(bench.document.scene().camera));
  }
}

void drawVantages(Workbench& bench) {
  const Action all[] = {Action::homeView, Action::below, Action::inside, Action::above};
  const char* labels[] = {"home", "below", "inside", "above"};
  for (std::size_t i = 0; i < 4; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::Button(labels[i])) bench.perform(all[i], "");
    bench.interface.items.mark(std::string("go ") + labels[i]);
  }
}

void drawBookmarks(Workbench& bench) {
  for (std::size_t i = 0; i < bench.bookmarks.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const bool kept = bench.bookmarks[i].has_value();
    ImGui::BeginDisabled(!kept);
    if (ImGui::Button(fmt::format("{}", i + 1).c_str(), {2.2f * ImGui::GetFontSize(), 0.0f}))
      bench.goTo(static_cast<int>(i));
    bench.interface.items.mark(fmt::format("bookmark {}", i + 1));
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("keep")) bench.keep(static_cast<int>(i));
    bench.interface.items.mark(fmt::format("keep {}", i + 1));
    ImGui::SameLine();
    if (kept) {
      const Camera& c = *bench.bookmarks[i];
      ImGui::TextDisabled("%.0f m high, %.0f°", c.position.z,
                          static_cast<double>(c.heading) * 180.0 / std::numbers::pi);
    } else {
      ImGui::TextDisabled("empty");
    }
    ImGui::PopID();
  }
}

}  // namespace

void drawCamera(Workbench& bench) {
  ImGui::BeginChild("##camera");
  drawMode(bench);
  drawVantages(bench);
  ImGui::Separator();
  drawSection(bench, "camera");
  if (ImGui::CollapsingHeader("bookmarks", ImGuiTreeNodeFlags_DefaultOpen)) drawBookmarks(bench);
  bench.interface.items.mark("section bookmarks");
  ImGui::EndChild();
}

}  // namespace welkin::viewer
