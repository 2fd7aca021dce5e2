#pragma once
// A context of our own for the command and the tests: no window, no display server.
#include <memory>

#include "welkin/gl/loader.hpp"

namespace welkin::gl {

enum class ContextKind { desktop, es };

// Owns a surfaceless EGL context (OpenGL 3.3 core or newer, or OpenGL ES 3) and keeps it current on this thread while
// it lives. Throws Error (noOpenGl) when the system offers none.
class Context {
 public:
  explicit Context(ContextKind kind = ContextKind::desktop);
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const Loader& loader() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::gl
