// What a frame costs, and the quality that it is drawn with.
#include <fmt/format.h>

#include <algorithm>

#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

void drawPasses(Workbench& bench) {
  const realtime::FrameCost& cost = bench.pace.cost;
  double all = 0.0;
  for (const realtime::PassCost& pass : cost.passes) all += pass.milliseconds;
  for (const realtime::PassCost& pass : cost.passes) {
    const float share = all > 0.0 ? static_cast<float>(pass.milliseconds / all) : 0.0f;
    ImGui::ProgressBar(share, {-1.0f, 0.0f}, fmt::format("{}  {:.1f} ms", pass.name, pass.milliseconds).c_str());
  }
  ImGui::Text("all passes %.1f ms, the frame %.1f ms", all, bench.pace.frameMs);
  if (bench.countSamples && cost.rays > 0.0)
    ImGui::Text("%.1f density samples a ray, at most %.0f; %.0f rays", cost.densitySamples / cost.rays,
                cost.mostSamples, cost.rays);
}

void drawSampleScale(Workbench& bench) {
  ImGui::Checkbox("show them: blue few, red", &bench.showSamples);
  bench.interface.items.mark("show samples");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::SliderFloat("##most", &bench.mostSamples, 8.0f, 1024.0f, "%.0f and more", ImGuiSliderFlags_Logarithmic);
  bench.mostSamples = std::max(bench.mostSamples, 1.0f);
  bench.interface.items.mark("most samples");
}

void drawHistory(const Workbench& bench) {
  std::array<float, Pace::kKept> times{};
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = bench.pace.times[(bench.pace.next + i) % times.size()];
  const float most = std::max(*std::max_element(times.begin(), times.end()), 20.0f);
  ImGui::PlotLines("##times", times.data(), static_cast<int>(times.size()), 0,
                   fmt::format("frames, to {:.0f} ms", most).c_str(), 0.0f, most,
                   {ImGui::GetContentRegionAvail().x, 5.0f * ImGui::GetFontSize()});
}

void drawGovernor(Workbench& bench) {
  Pace& pace = bench.pace;
  ImGui::TextDisabled("while something moves:");
  bool own = pace.scale <= 0.0f;
  if (ImGui::Checkbox("resolution by itself", &own)) pace.scale = own ? 0.0f : 0.5f;
  bench.interface.items.mark("scale by itself");
  if (!own) {
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 9.0f);
    float percent = 100.0f * pace.scale;
    if (ImGui::SliderFloat("of the window's", &percent, 10.0f, 100.0f, "%.0f %%")) pace.scale = percent / 100.0f;
    bench.interface.items.mark("scale");
  }
  bool governed = pace.wantedRate > 0.0f;
  if (ImGui::Checkbox("hold the frame rate", &governed)) pace.wantedRate = governed ? 25.0f : 0.0f;
  bench.interface.items.mark("hold rate");
  if (governed) {
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 9.0f);
    ImGui::SliderFloat("frames a second", &pace.wantedRate, 5.0f, 120.0f, "%.0f", ImGuiSliderFlags_Logarithmic);
    bench.interface.items.mark("rate");
  }
  const Quality& now = bench.picture.quality();
  ImGui::Text("drawn with: history 1/%d, interleave %dx%d, steps %.2f, light steps %d", now.historyScale,
              now.interleave, now.interleave, static_cast<double>(now.stepScale), now.lightSteps);
  ImGui::TextDisabled("At rest the window's resolution and the quality below.");
}

void drawMemory(const Workbench& bench) {
  std::size_t all = 0;
  const std::vector<realtime::MemoryRow> rows = bench.picture.memory();
  for (const realtime::MemoryRow& row : rows) all += row.bytes;
  ImGui::Text("%.1f MB of textures", static_cast<double>(all) / 1e6);
  if (!ImGui::BeginTable("##memory", 3, ImGuiTableFlags_RowBg)) return;
  for (const realtime::MemoryRow& row : rows) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.name.c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%dx%dx%d %s", row.width, row.height, std::max(row.depth, 1), row.format.c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%.2f MB", static_cast<double>(row.bytes) / 1e6);
  }
  ImGui::EndTable();
}

}  // namespace

void drawPace(Workbench& bench) {
  ImGui::BeginChild("##pace");
  ImGui::TextWrapped("%s%s", bench.picture.driver().c_str(),
                     bench.picture.softwareDriver() ? ": no GPU was found, the processor draws" : "");
  drawGovernor(bench);
  if (ImGui::Checkbox("count density samples (slower)", &bench.countSamples))
    bench.picture.countSamples(bench.countSamples);
  bench.interface.items.mark("count samples");
  if (bench.countSamples) drawSampleScale(bench);
  drawHistory(bench);
  drawPasses(bench);
  if (ImGui::CollapsingHeader("quality", ImGuiTreeNodeFlags_DefaultOpen)) drawSection(bench, "quality");
  bench.interface.items.mark("section quality");
  if (ImGui::CollapsingHeader("lighting")) drawSection(bench, "lighting");
  bench.interface.items.mark("section lighting");
  if (ImGui::CollapsingHeader("memory")) drawMemory(bench);
  bench.interface.items.mark("section memory");
  ImGui::EndChild();
}

}  // namespace welkin::viewer
