// Opening and saving: a list of files, a name; and what happens to changes when one leaves.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/viewer/panels/panels.hpp"

namespace welkin::viewer {

namespace fs = std::filesystem;

namespace {

struct Purpose {
  Action action;
  const char *title, *button, *ending, *hint;
};
constexpr Purpose kPurposes[] = {
    {Action::open, "Open a sky", "open", ".toml", "a sky file (.sky.toml); files can be dropped on the window too"},
    {Action::saveAs, "Save the sky", "save", ".toml", "name of the sky file, for example evening.sky.toml"},
    {Action::savePicture, "Save the picture", "save", "", ".png as it is shown, .exr linear light in kcd/m²"}};

const Purpose* purposeOf(Action action) {
  const auto found =
      std::find_if(std::begin(kPurposes), std::end(kPurposes), [&](const Purpose& p) { return p.action == action; });
  return found == std::end(kPurposes) ? nullptr : &*found;
}

// Folders first, then the files that end right; hidden ones left out.
std::vector<fs::path> entriesOf(const fs::path& folder, const char* ending) {
  std::vector<fs::path> folders, files;
  std::error_code none;
  fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, none);
  for (; !none && at != fs::directory_iterator(); at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code ignored;
    if (at->is_directory(ignored))
      folders.push_back(at->path());
    else if (name.ends_with(ending) && *ending)
      files.push_back(at->path());
  }
  std::sort(folders.begin(), folders.end());
  std::sort(files.begin(), files.end());
  folders.insert(folders.end(), files.begin(), files.end());
  return folders;
}

// Lists the folder; a click on a file puts its name into the field.
void drawList(Workbench& bench, const Purpose& purpose) {
  FileDialog& dialog = bench.files;
  ImGui::BeginChild("##list", {0.0f, 16.0f * ImGui::GetFontSize()}, true);
  fs::path next;
  if (dialog.folder.has_parent_path() && ImGui::Selectable("../")) next = dialog.folder.parent_path();
  bench.interface.items.mark("file ..");
  for (const fs::path& entry : entriesOf(dialog.folder, purpose.ending)) {
    std::error_code none;
    const bool folder = fs::is_directory(entry, none);
    const std::string name = entry.filename().string();
    if (ImGui::Selectable((name + (folder ? "/" : "")).c_str(), name == dialog.name)) {
      if (folder)
        next = entry;
      else
        dialog.name = name;
    }
    bench.interface.items.mark("file " + name);
  }
  if (!next.empty()) dialog.folder = next;
  ImGui::EndChild();
}

void drawDialog(Workbench& bench, const Purpose& purpose) {
  FileDialog& dialog = bench.files;
  ImGui::SetNextWindowSize({34.0f * ImGui::GetFontSize(), 0.0f}, ImGuiCond_Appearing);
  if (!ImGui::BeginPopupModal(purpose.title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  ImGui::TextDisabled("%s", dialog.folder.string().c_str());
  drawList(bench, purpose);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  bool done = ImGui::InputTextWithHint("##name", purpose.hint, &dialog.name, ImGuiInputTextFlags_EnterReturnsTrue);
  bench.interface.items.mark("file name");
  done |= ImGui::Button(purpose.button);
  bench.interface.items.mark("file accept");
  ImGui::SameLine();
  const bool away = ImGui::Button("cancel");
  bench.interface.items.mark("file cancel");
  if (done && !dialog.name.empty()) {
    std::error_code none;
    const fs::path chosen = dialog.folder / dialog.name;  // an absolute name stands for itself
    if (fs::is_directory(chosen, none)) {
      dialog.folder = chosen;
      dialog.name.clear();
    } else {
      ImGui::CloseCurrentPopup();
      bench.perform(purpose.action, chosen.string());
    }
  } else if (away) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

void drawLeaving(Workbench& bench) {
  if (bench.askBeforeLeaving) ImGui::OpenPopup("Unsaved changes");
  bench.askBeforeLeaving = false;
  if (!ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  ImGui::TextUnformatted("The sky has been changed and not saved.");
  if (ImGui::Button("leave without saving")) bench.leave();
  bench.interface.items.mark("leave");
  ImGui::SameLine();
  if (ImGui::Button("save first")) {
    ImGui::CloseCurrentPopup();
    bench.perform(bench.document.origin().file.empty() ? Action::saveAs : Action::save, "");
  }
  bench.interface.items.mark("save first");
  ImGui::SameLine();
  if (ImGui::Button("stay")) ImGui::CloseCurrentPopup();
  bench.interface.items.mark("stay");
  ImGui::EndPopup();
}

}  // namespace

void askForFile(Workbench& bench, Action action) {
  FileDialog& dialog = bench.files;
  dialog.wanted = action;
  if (!dialog.folder.empty()) return;
  std::error_code none;
  dialog.folder = bench.document.origin().file.empty() ? fs::current_path(none)
                                                       : fs::absolute(bench.document.origin().file, none).parent_path();
}

void drawFiles(Workbench& bench) {
  if (bench.files.wanted)
    if (const Purpose* purpose = purposeOf(*bench.files.wanted)) {
      bench.files.name.clear();
      ImGui::OpenPopup(purpose->title);
    }
  bench.files.wanted.reset();
  for (const Purpose& purpose : kPurposes) drawDialog(bench, purpose);
  drawLeaving(bench);
}

}  // namespace welkin::viewer
