// The path-traced reference beside the real-time picture.
#include <fmt/format.h>

#include "apps/viewer/panels/panels.hpp"
#include "welkin/scene/features.hpp"

namespace welkin::viewer {

void drawReference(Workbench& bench) {
  ImGui::BeginChild("##reference");
  ImGui::TextWrapped(
      "The same view by the path tracer, which knows no shortcuts. It grows while nothing moves, at half the "
      "resolution, and begins anew when something has changed.");
  if (ImGui::Checkbox("trace (R)", &bench.referenceWanted)) bench.say("");
  bench.interface.items.mark("trace");
  const auto choice = [&](const char* label, Comparison comparison) {
    if (ImGui::RadioButton(label, bench.comparison == comparison)) bench.comparison = comparison;
    bench.interface.items.mark(std::string("compare ") + label);
  };
  choice("side by side", Comparison::wipe);
  ImGui::SameLine();
  choice("reference", Comparison::reference);
  ImGui::SameLine();
  choice("difference", Comparison::difference);
  if (bench.comparison == Comparison::wipe) {
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::SliderFloat("##wipe", &bench.wipe, 0.0f, 1.0f, "the real-time picture to here");
    bench.interface.items.mark("wipe");
  }
  if (bench.comparison == Comparison::difference) ImGui::TextDisabled("what the screen shows, times four; grey: equal");
  ImGui::Separator();
  const ReferenceState& state = bench.reference.state();
  if (!state.trouble.empty())
    ImGui::TextWrapped("%s", state.trouble.c_str());
  else if (!bench.referenceWanted)
    ImGui::TextDisabled("not traced");
  else if (!bench.reference.running())
    ImGui::TextDisabled("waits for the picture to come to rest");
  else
    ImGui::Text("%.0f paths a pixel, %.0f %% of the picture%s", state.samples, 100.0 * state.share,
                state.complete ? ", complete" : "");
  if (state.flip >= 0.0) ImGui::Text("FLIP %.3f (0 equal, 1 all different)", state.flip);
  const Scene& scene = bench.document.scene();
  if (featuresOf(scene) != tracedFeaturesOf(scene))
    ImGui::TextWrapped("The real-time picture shows %s, the path tracer %s.", featuresOf(scene).c_str(),
                       tracedFeaturesOf(scene).c_str());
  ImGui::EndChild();
}

}  // namespace welkin::viewer
