#include "apps/viewer/ui/interface.hpp"

#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

constexpr float kFontSize = 15.0f;

// The first font of these that is there; ImGui's own bitmap font stands in.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                  "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

// Latin, Greek, and what the panels write besides: arrows, degrees, multiplication signs.
constexpr ImWchar kGlyphs[] = {0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x2026, 0x2190, 0x21bb,
                               0x2200, 0x22ff, 0x25a0, 0x26ff, 0x2715, 0x2717, 0};

void mapKeys(ImGuiIO& io) {
  const auto set = [&](ImGuiKey_ key, Key ours) { io.KeyMap[key] = static_cast<int>(ours); };
  set(ImGuiKey_Tab, Key::tab);
  set(ImGuiKey_LeftArrow, Key::left);
  set(ImGuiKey_RightArrow, Key::right);
  set(ImGuiKey_UpArrow, Key::up);
  set(ImGuiKey_DownArrow, Key::down);
  set(ImGuiKey_PageUp, Key::pageup);
  set(ImGuiKey_PageDown, Key::pagedown);
  set(ImGuiKey_Home, Key::home);
  set(ImGuiKey_End, Key::end);
  set(ImGuiKey_Insert, Key::insert);
  set(ImGuiKey_Delete, Key::del);
  set(ImGuiKey_Backspace, Key::backspace);
  set(ImGuiKey_Space, Key::space);
  set(ImGuiKey_Enter, Key::enter);
  set(ImGuiKey_Escape, Key::escape);
  set(ImGuiKey_A, Key::a);
  set(ImGuiKey_C, Key::c);
  set(ImGuiKey_V, Key::v);
  set(ImGuiKey_X, Key::x);
  set(ImGuiKey_Y, Key::y);
  set(ImGuiKey_Z, Key::z);
}

ImGuiStyle makeStyle() {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0.0f;
  style.FrameRounding = 4.0f;
  style.GrabRounding = 4.0f;
  style.PopupRounding = 5.0f;
  style.TabRounding = 4.0f;
  style.ScrollbarSize = 12.0f;
  style.WindowBorderSize = 0.0f;
  style.FramePadding = {7.0f, 4.0f};
  style.ItemSpacing = {8.0f, 5.0f};
  const auto set = [&](ImGuiCol colour, float r, float g, float b, float a) { style.Colors[colour] = {r, g, b, a}; };
  set(ImGuiCol_WindowBg, 0.085f, 0.095f, 0.115f, 1.0f);
  set(ImGuiCol_PopupBg, 0.10f, 0.11f, 0.135f, 0.98f);
  set(ImGuiCol_MenuBarBg, 0.065f, 0.072f, 0.09f, 1.0f);
  set(ImGuiCol_FrameBg, 0.15f, 0.17f, 0.205f, 1.0f);
  set(ImGuiCol_FrameBgHovered, 0.19f, 0.22f, 0.27f, 1.0f);
  set(ImGuiCol_FrameBgActive, 0.22f, 0.27f, 0.34f, 1.0f);
  set(ImGuiCol_Header, 0.14f, 0.165f, 0.205f, 1.0f);
  set(ImGuiCol_HeaderHovered, 0.20f, 0.26f, 0.34f, 1.0f);
  set(ImGuiCol_HeaderActive, 0.24f, 0.33f, 0.45f, 1.0f);
  set(ImGuiCol_Button, 0.17f, 0.20f, 0.25f, 1.0f);
  set(ImGuiCol_ButtonHovered, 0.24f, 0.33f, 0.45f, 1.0f);
  set(ImGuiCol_ButtonActive, 0.28f, 0.42f, 0.60f, 1.0f);
  set(ImGuiCol_Tab, 0.11f, 0.125f, 0.155f, 1.0f);
  set(ImGuiCol_TabHovered, 0.24f, 0.33f, 0.45f, 1.0f);
  set(ImGuiCol_TabActive, 0.20f, 0.29f, 0.41f, 1.0f);
  set(ImGuiCol_SliderGrab, 0.45f, 0.66f, 0.92f, 1.0f);
  set(ImGuiCol_SliderGrabActive, 0.62f, 0.80f, 1.0f, 1.0f);
  set(ImGuiCol_CheckMark, 0.55f, 0.76f, 1.0f, 1.0f);
  set(ImGuiCol_NavHighlight, 0.95f, 0.75f, 0.35f, 1.0f);
  return style;
}

}  // namespace

void Items::mark(const std::string& name) {
  if (ImGui::IsItemVisible()) mark(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}
void Items::mark(const std::string& name, const ImVec2& low, const ImVec2& high) {
  std::string word = name;
  std::replace(word.begin(), word.end(), ' ', '_');
  boxes_[word] = {{low.x, low.y}, {high.x, high.y}};
}
std::optional<Box> Items::find(const std::string& name) const {
  const auto found = boxes_.find(name);
  if (found == boxes_.end()) return std::nullopt;
  return found->second;
}

Interface::Interface(Platform& platform) : platform_(platform), scale_(platform.density()) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.BackendPlatformName = "welkin";
  mapKeys(io);
  io.ClipboardUserData = this;
  io.SetClipboardTextFn = [](void* self, const char* text) {
    static_cast<Interface*>(self)->platform_.setClipboard(text);
  };
  io.GetClipboardTextFn = [](void* self) {
    auto* interface = static_cast<Interface*>(self);
    interface->clipboard_ = interface->platform_.clipboard();
    return interface->clipboard_.c_str();
  };
  if (!ImGui_ImplOpenGL3_Init("#version 330")) {
    ImGui::DestroyContext();
    throw Error(ErrorKind::noOpenGl, "",
                "Dear ImGui finds no OpenGL library: install libGL (Debian: apt-get install libgl1)");
  }
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Interface::feed(const Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case EventKind::mouseMove:
      pointer_ = {event.x, event.y};
      io.MousePos = {event.x, event.y};
      break;
    case EventKind::mouseButton:
      io.MouseDown[static_cast<int>(event.button)] = event.down;
      break;
    case EventKind::wheel:
      io.MouseWheelH += event.x;
      io.MouseWheel += event.y;
      break;
    case EventKind::key: {
      const auto index = static_cast<std::size_t>(event.key);
      down_[index] = event.down;
      if (event.key != Key::none) io.KeysDown[index] = event.down;
      io.KeyShift = isDown(Key::shift);
      io.KeyCtrl = isDown(Key::ctrl);
      io.KeyAlt = isDown(Key::alt);
      break;
    }
    case EventKind::text:
      io.AddInputCharactersUTF8(event.text.c_str());
      break;
    case EventKind::padAxis:
    case EventKind::drop:
    case EventKind::resize:
    case EventKind::quit:
      break;
  }
}

Modifiers Interface::modifiers() const { return {isDown(Key::shift), isDown(Key::ctrl), isDown(Key::alt)}; }

void Interface::applyScale() {
  if (scale_ == applied_) return;
  applied_ = scale_;
  ImGui::GetStyle() = makeStyle();
  ImGui::GetStyle().ScaleAllSizes(scale_);
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  std::error_code none;
  const auto font = std::find_if(std::begin(kFonts), std::end(kFonts),
                                 [&](const char* f) { return std::filesystem::is_regular_file(f, none); });
  if (font != std::end(kFonts)) {
    fonts.AddFontFromFileTTF(*font, std::round(kFontSize * scale_), nullptr, kGlyphs);
  } else {
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale_);
    fonts.AddFontDefault(&config);
  }
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Interface::begin(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(platform_.width()), static_cast<float>(platform_.height())};
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.25));
  ImGui_ImplOpenGL3_NewFrame();
  applyScale();
  ImGui::NewFrame();
  items.clear();
}

void Interface::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Interface::wantsText() const { return ImGui::GetIO().WantTextInput; }
bool Interface::wantsKeys() const { return ImGui::GetIO().NavActive; }

}  // namespace welkin::viewer
