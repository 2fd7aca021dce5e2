#pragma once
// Dear ImGui, fed with our events and drawn into the platform's framebuffer.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <map>
#include <string>

#include "apps/viewer/model/event.hpp"
#include "apps/viewer/model/script.hpp"
#include "apps/viewer/platform/platform.hpp"

namespace welkin::viewer {

// Where the widgets of this frame lie, so that scripts find them by name.
class Items {
 public:
  // Notes the last widget, if it can be seen. Spaces in names become underscores.
  void mark(const std::string& name);
  void mark(const std::string& name, const ImVec2& low, const ImVec2& high);
  std::optional<Box> find(const std::string& name) const;
  void clear() { boxes_.clear(); }

 private:
  std::map<std::string, Box, std::less<>> boxes_;
};

class Interface {
 public:
  explicit Interface(Platform& platform);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void feed(const Event& event);
  // Between these two, widgets.
  void begin(double seconds);
  void draw();

  // Size of the interface: 1 is that of a usual screen.
  void setScale(float scale) { scale_ = scale; }
  float scale() const { return scale_; }

  bool wantsMouse() const;
  bool wantsText() const;  // a text field has the keyboard
  bool wantsKeys() const;  // widgets are being walked by keyboard
  Modifiers modifiers() const;
  bool isDown(Key key) const { return down_[static_cast<std::size_t>(key)]; }
  glm::vec2 pointer() const { return pointer_; }

  Items items;

 private:
  void applyScale();

  Platform& platform_;
  std::string clipboard_;
  glm::vec2 pointer_{-1.0f};
  bool down_[kKeys] = {};
  float scale_ = 1.0f, applied_ = 0.0f;
};

}  // namespace welkin::viewer
