// The menu bar above, the status bar below, and the list of keys.
#include <fmt/format.h>

#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace {

bool enabled(const Workbench& bench, Action action) {
  if (action == Action::undo) return bench.document.canUndo();
  if (action == Action::redo) return bench.document.canRedo();
  return true;
}

std::string labelOf(const Workbench& bench, const ActionInfo& info) {
  std::string label(info.label);
  if (info.action == Action::undo && bench.document.canUndo()) label += " " + bench.document.undoName();
  if (info.action == Action::redo && bench.document.canRedo()) label += " " + bench.document.redoName();
  return label;
}

void drawHelp(Workbench& bench) {
  if (!bench.helpShown) return;
  ImGui::SetNextWindowSize({ImGui::GetFontSize() * 34.0f, 0.0f}, ImGuiCond_Appearing);
  if (ImGui::Begin("Keys and mouse", &bench.helpShown, ImGuiWindowFlags_NoCollapse)) {
    const auto row = [](const char* what, const char* keys) {
      ImGui::TextColored({0.72f, 0.86f, 1.0f, 1.0f}, "%s", keys);
      ImGui::SameLine(ImGui::GetFontSize() * 13.0f);
      ImGui::TextUnformatted(what);
    };
    row("look round, or orbit", "drag");
    row("orbit", "drag with the right button");
    row("shift the view", "drag with the middle button");
    row("forward and back", "wheel");
    row("angle of view", "ctrl+wheel");
    row("fly", "w a s d, e up, q down");
    row("faster, slower", "shift, alt held");
    row("turn", "arrow keys");
    row("go to a bookmark, keep one", "1 to 9, ctrl+1 to ctrl+9");
    row("type a value", "ctrl+click on a slider");
    ImGui::Separator();
    for (const ActionInfo& info : actions())
      if (info.chord.key != Key::none) row(std::string(info.label).c_str(), nameOf(info.chord).c_str());
  }
  ImGui::End();
}

}  // namespace

void drawMenu(Workbench& bench) {
  constexpr std::pair<ActionGroup, const char*> kMenus[] = {
      {ActionGroup::file, "File"},     {ActionGroup::edit, "Edit"},   {ActionGroup::time, "Sky"},
      {ActionGroup::camera, "Camera"}, {ActionGroup::panel, "Panel"}, {ActionGroup::window, "Window"}};
  if (ImGui::BeginMainMenuBar()) {
    for (const auto& [group, title] : kMenus) {
      const bool open = ImGui::BeginMenu(title);
      bench.interface.items.mark(std::string("menu ") + title);
      if (!open) continue;
      for (const ActionInfo& info : actions()) {
        if (info.group != group) continue;
        if (ImGui::MenuItem(labelOf(bench, info).c_str(), nameOf(info.chord).c_str(), false,
                            enabled(bench, info.action)))
          bench.perform(info.action, "");
        bench.interface.items.mark(std::string(info.name));
      }
      ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
  }
  drawHelp(bench);
}

void drawStatus(Workbench& bench) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float height = ImGui::GetFrameHeight();
  ImGui::SetNextWindowPos({0.0f, screen.y - height});
  ImGui::SetNextWindowSize({screen.x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0f, 2.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("##status", nullptr, kFlags)) {
    const std::string driver =
        bench.picture.softwareDriver() ? "no GPU: drawn by the processor" : bench.picture.driver();
    const std::string pace = bench.picture.settled() ? "at rest" : fmt::format("{:.0f} ms", bench.pace.frameMs);
    const std::string right =
        fmt::format("{}x{}   {}   {}", bench.picture.width(), bench.picture.height(), pace, driver);
    if (bench.messageIsError)
      ImGui::TextColored({1.0f, 0.55f, 0.45f, 1.0f}, "%s", bench.message.c_str());
    else
      ImGui::TextUnformatted(bench.message.c_str());
    const float width = ImGui::CalcTextSize(right.c_str()).x;
    ImGui::SameLine(std::max(screen.x - width - 10.0f, ImGui::GetItemRectSize().x + 20.0f));
    ImGui::TextDisabled("%s", right.c_str());
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace welkin::viewer
