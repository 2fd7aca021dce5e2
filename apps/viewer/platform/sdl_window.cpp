// The window by SDL2.
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/viewer/platform/platform.hpp"
#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

[[noreturn]] void refuse(const char* step) {
  throw Error(ErrorKind::noOpenGl, "",
              fmt::format("no window: {} ({}); a display is needed, or --headless with --script, or "
                          "`xvfb-run -s '-screen 0 1280x720x24'` before the command",
                          step, SDL_GetError()));
}

// SDL as a whole, alive while a window is.
struct Sdl {
  Sdl() {
    SDL_SetMainReady();
    SDL_SetHint(SDL_HINT_VIDEO_HIGHDPI_DISABLED, "0");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) refuse("SDL finds no display");
    // A gamepad is welcome, not needed.
    SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);
  }
  ~Sdl() { SDL_Quit(); }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;
};

Key keyOf(SDL_Keycode code) {
  if (code >= SDLK_a && code <= SDLK_z) return static_cast<Key>(static_cast<int>(Key::a) + (code - SDLK_a));
  if (code >= SDLK_0 && code <= SDLK_9) return static_cast<Key>(static_cast<int>(Key::digit0) + (code - SDLK_0));
  if (code >= SDLK_F1 && code <= SDLK_F12) return static_cast<Key>(static_cast<int>(Key::f1) + (code - SDLK_F1));
  switch (code) {
    case SDLK_ESCAPE:
      return Key::escape;
    case SDLK_RETURN:
    case SDLK_KP_ENTER:
      return Key::enter;
    case SDLK_TAB:
      return Key::tab;
    case SDLK_SPACE:
      return Key::space;
    case SDLK_BACKSPACE:
      return Key::backspace;
    case SDLK_DELETE:
      return Key::del;
    case SDLK_INSERT:
      return Key::insert;
    case SDLK_HOME:
      return Key::home;
    case SDLK_END:
      return Key::end;
    case SDLK_PAGEUP:
      return Key::pageup;
    case SDLK_PAGEDOWN:
      return Key::pagedown;
    case SDLK_LEFT:
      return Key::left;
    case SDLK_RIGHT:
      return Key::right;
    case SDLK_UP:
      return Key::up;
    case SDLK_DOWN:
      return Key::down;
    case SDLK_PLUS:
    case SDLK_EQUALS:
    case SDLK_KP_PLUS:
      return Key::plus;
    case SDLK_MINUS:
    case SDLK_KP_MINUS:
      return Key::minus;
    case SDLK_COMMA:
      return Key::comma;
    case SDLK_PERIOD:
      return Key::period;
    case SDLK_SLASH:
      return Key::slash;
    case SDLK_LSHIFT:
    case SDLK_RSHIFT:
      return Key::shift;
    case SDLK_LCTRL:
    case SDLK_RCTRL:
      return Key::ctrl;
    case SDLK_LALT:
    case SDLK_RALT:
      return Key::alt;
    default:
      return Key::none;
  }
}

// What the buttons of a gamepad do is what these keys do.
Key keyOf(SDL_GameControllerButton button) {
  switch (button) {
    case SDL_CONTROLLER_BUTTON_A:
      return Key::c;
    case SDL_CONTROLLER_BUTTON_B:
      return Key::b;
    case SDL_CONTROLLER_BUTTON_LEFTSHOULDER:
      return Key::g;
    case SDL_CONTROLLER_BUTTON_RIGHTSHOULDER:
      return Key::f;
    case SDL_CONTROLLER_BUTTON_BACK:
      return Key::backspace;
    case SDL_CONTROLLER_BUTTON_START:
      return Key::space;
    default:
      return Key::none;
  }
}

std::optional<PadAxis> axisOf(SDL_GameControllerAxis axis) {
  switch (axis) {
    case SDL_CONTROLLER_AXIS_LEFTX:
      return PadAxis::leftX;
    case SDL_CONTROLLER_AXIS_LEFTY:
      return PadAxis::leftY;
    case SDL_CONTROLLER_AXIS_RIGHTX:
      return PadAxis::rightX;
    case SDL_CONTROLLER_AXIS_RIGHTY:
      return PadAxis::rightY;
    case SDL_CONTROLLER_AXIS_TRIGGERLEFT:
      return PadAxis::leftTrigger;
    case SDL_CONTROLLER_AXIS_TRIGGERRIGHT:
      return PadAxis::rightTrigger;
    default:
      return std::nullopt;
  }
}

class SdlWindow final : public Platform {
 public:
  explicit SdlWindow(const WindowOptions& options) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
    window_ = SDL_CreateWindow(options.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, options.width,
                               options.height, SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!window_) refuse("the window cannot be opened");
    context_ = SDL_GL_CreateContext(window_);
    if (!context_) {
      SDL_DestroyWindow(window_);
      refuse("the display has no OpenGL 3.3");
    }
    SDL_GL_SetSwapInterval(1);
    SDL_StartTextInput();
    measure();
  }
  ~SdlWindow() override {
    if (pad_) SDL_GameControllerClose(pad_);
    SDL_GL_DeleteContext(context_);
    SDL_DestroyWindow(window_);
  }
  SdlWindow(const SdlWindow&) = delete;
  SdlWindow& operator=(const SdlWindow&) = delete;

  const gl::Loader& loader() const override { return loader_; }
  unsigned framebuffer() const override { return 0; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  float density() const override {
    int logical = 0;
    SDL_GetWindowSize(window_, &logical, nullptr);
    const float pixels = static_cast<float>(width_) / static_cast<float>(std::max(logical, 1));
    float dpi = 96.0f;
    // Displays that do not know their size answer nonsense.
    if (SDL_GetDisplayDPI(SDL_GetWindowDisplayIndex(window_), nullptr, &dpi, nullptr) != 0 || dpi < 60.0f || dpi > 600)
      dpi = 96.0f;
    return std::clamp(std::round(std::max(pixels, dpi / 96.0f) * 4.0f) / 4.0f, 1.0f, 4.0f);
  }

  std::vector<Event> poll(int milliseconds) override {
    std::vector<Event> events;
    SDL_Event event;
    if (milliseconds > 0 && SDL_WaitEventTimeout(&event, milliseconds)) translate(event, events);
    while (SDL_PollEvent(&event)) translate(event, events);
    return events;
  }
  void resize(int width, int height) override { SDL_SetWindowSize(window_, width, height); }
  void present() override { SDL_GL_SwapWindow(window_); }
  void setTitle(const std::string& title) override { SDL_SetWindowTitle(window_, title.c_str()); }
  void setClipboard(const std::string& text) override { SDL_SetClipboardText(text.c_str()); }
  std::string clipboard() override {
    char* text = SDL_GetClipboardText();
    std::string copy = text ? text : "";
    SDL_free(text);
    return copy;
  }

 private:
  void measure() {
    SDL_GL_GetDrawableSize(window_, &width_, &height_);
    width_ = std::max(width_, 1);
    height_ = std::max(height_, 1);
  }

  void translate(const SDL_Event& e, std::vector<Event>& out) {
    switch (e.type) {
      case SDL_QUIT:
        out.push_back({.kind = EventKind::quit});
        break;
      case SDL_WINDOWEVENT:
        if (e.window.event == SDL_WINDOWEVENT_SIZE_CHANGED) {
          measure();
          out.push_back({.kind = EventKind::resize, .x = static_cast<float>(width_), .y = static_cast<float>(height_)});
        }
        break;
      case SDL_MOUSEMOTION: {
        int logical = 0;
        SDL_GetWindowSize(window_, &logical, nullptr);
        const float pixels = static_cast<float>(width_) / static_cast<float>(std::max(logical, 1));
        out.push_back({.kind = EventKind::mouseMove,
                       .x = static_cast<float>(e.motion.x) * pixels,
                       .y = static_cast<float>(e.motion.y) * pixels});
        break;
      }
      case SDL_MOUSEBUTTONDOWN:
      case SDL_MOUSEBUTTONUP: {
        const bool down = e.type == SDL_MOUSEBUTTONDOWN;
        const Uint8 b = e.button.button;
        if (b != SDL_BUTTON_LEFT && b != SDL_BUTTON_RIGHT && b != SDL_BUTTON_MIDDLE) break;
        // While a button is held the pointer may leave the window.
        SDL_CaptureMouse(down ? SDL_TRUE : SDL_FALSE);
        out.push_back({.kind = EventKind::mouseButton,
                       .button = b == SDL_BUTTON_LEFT    ? MouseButton::left
                                 : b == SDL_BUTTON_RIGHT ? MouseButton::right
                                                         : MouseButton::middle,
                       .down = down});
        break;
      }
      case SDL_MOUSEWHEEL:
        out.push_back({.kind = EventKind::wheel, .x = e.wheel.preciseX, .y = e.wheel.preciseY});
        break;
      case SDL_KEYDOWN:
      case SDL_KEYUP:
        if (e.type == SDL_KEYDOWN && e.key.repeat) break;
        out.push_back({.kind = EventKind::key, .down = e.type == SDL_KEYDOWN, .key = keyOf(e.key.keysym.sym)});
        break;
      case SDL_CONTROLLERDEVICEADDED:
        if (!pad_) pad_ = SDL_GameControllerOpen(e.cdevice.which);
        break;
      case SDL_CONTROLLERDEVICEREMOVED:
        if (!pad_ || SDL_GameControllerGetAttached(pad_)) break;
        SDL_GameControllerClose(pad_);
        pad_ = nullptr;
        for (int i = 0; i < kPadAxes; ++i) out.push_back({.kind = EventKind::padAxis, .axis = static_cast<PadAxis>(i)});
        break;
      case SDL_CONTROLLERAXISMOTION:
        if (const auto axis = axisOf(static_cast<SDL_GameControllerAxis>(e.caxis.axis)))
          out.push_back({.kind = EventKind::padAxis,
                         .x = std::clamp(static_cast<float>(e.caxis.value) / 32767.0f, -1.0f, 1.0f),
                         .axis = *axis});
        break;
      case SDL_CONTROLLERBUTTONDOWN:
      case SDL_CONTROLLERBUTTONUP:
        if (const Key key = keyOf(static_cast<SDL_GameControllerButton>(e.cbutton.button)); key != Key::none)
          out.push_back({.kind = EventKind::key, .down = e.type == SDL_CONTROLLERBUTTONDOWN, .key = key});
        break;
      case SDL_TEXTINPUT:
        out.push_back({.kind = EventKind::text, .text = e.text.text});
        break;
      case SDL_DROPFILE:
        out.push_back({.kind = EventKind::drop, .text = e.drop.file ? e.drop.file : ""});
        SDL_free(e.drop.file);
        break;
      default:
        break;
    }
  }

  Sdl sdl_;
  SDL_Window* window_ = nullptr;
  SDL_GLContext context_ = nullptr;
  SDL_GameController* pad_ = nullptr;
  gl::Loader loader_ = [](const char* name) { return SDL_GL_GetProcAddress(name); };
  int width_ = 1, height_ = 1;
};

}  // namespace

std::unique_ptr<Platform> openWindow(const WindowOptions& options) { return std::make_unique<SdlWindow>(options); }

}  // namespace welkin::viewer
