#pragma once
// The window, or what stands for it: a context, a framebuffer to draw into, events, a clipboard.
#include <memory>
#include <string>
#include <vector>

#include "apps/viewer/model/event.hpp"
#include "welkin/gl/loader.hpp"

namespace welkin::viewer {

struct WindowOptions {
  std::string title = "Welkin";
  int width = 1280, height = 720;  // pixels
};

class Platform {
 public:
  virtual ~Platform() = default;

  // OpenGL functions of the context, which is current on this thread.
  virtual const gl::Loader& loader() const = 0;
  // Where the picture goes; its size in pixels.
  virtual unsigned framebuffer() const = 0;
  virtual int width() const = 0;
  virtual int height() const = 0;
  // Pixels of the interface to one of a usual screen: 2 on screens of high density.
  virtual float density() const { return 1.0f; }

  // What has happened since the last call; waits for something to happen, at most so long.
  virtual std::vector<Event> poll(int milliseconds) = 0;
  // A script's wish; what became of it comes as an event.
  virtual void resize(int width, int height) = 0;
  virtual void present() = 0;

  virtual void setTitle(const std::string& title) = 0;
  virtual void setClipboard(const std::string& text) = 0;
  virtual std::string clipboard() = 0;
};

// Throws Error (noOpenGl) when there is no display or no OpenGL 3.3.
std::unique_ptr<Platform> openWindow(const WindowOptions& options);
// Without display and window; its events are those of scripts. Throws Error (noOpenGl).
std::unique_ptr<Platform> openHeadless(const WindowOptions& options);

}  // namespace welkin::viewer
