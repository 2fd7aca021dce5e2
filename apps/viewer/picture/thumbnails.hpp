#pragma once
// Small pictures of skies, drawn in the background by a thread and a context of their own.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "welkin/gl/api.hpp"
#include "welkin/realtime/renderer.hpp"

namespace welkin::viewer {

class Thumbnails {
 public:
  static constexpr int kWidth = 192, kHeight = 108;

  // `files`: skies, in the order in which they are drawn. Nothing happens before start().
  Thumbnails(std::vector<std::string> files, std::function<realtime::CustomTextures(const Scene&)> loadTextures);
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  void start();
  // Makes textures of what has been drawn since the last call, in the context of `gl`. Returns whether there was any.
  bool collect(const gl::Api& gl);
  // Name of an OpenGL texture, rows from the top; 0 while there is none.
  unsigned texture(std::size_t index) const;
  // Why a sky has no picture; empty otherwise.
  const std::string& trouble(std::size_t index) const;
  // Whether all are there that there will be. True before start().
  bool complete() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::viewer
