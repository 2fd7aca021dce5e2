#pragma once
// The same view by the path tracer, growing in the background, and how far the real-time picture is from it.
#include <memory>
#include <string>

#include "welkin/base/image.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// How it is shown beside the real-time picture.
enum class Comparison { wipe, reference, difference };

// What is known of it so far.
struct ReferenceState {
  double samples = 0.0;  // of the mean pixel
  double share = 0.0;    // of the pixels that have any
  double flip = -1.0;    // mean FLIP of the two pictures as shown; negative while there is none
  bool complete = false;
  std::string trouble{};
};

class Reference {
 public:
  Reference();
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  // Begins anew. `realtime`: light of the picture to be compared with, of the shape of the window's; the reference is
  // traced at half its resolution, so that it grows while one watches.
  void start(const Scene& scene, const realtime::CustomTextures& textures, Image realtime);
  void stop();
  bool running() const;

  // Makes a texture of what has been traced since the last call: light, and in alpha whether a pixel has any. Returns
  // whether there was something new.
  bool collect(const gl::Api& gl);
  const gl::Texture& texture() const;  // empty before the first
  const ReferenceState& state() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
  gl::Texture texture_;
  ReferenceState state_;
};

}  // namespace welkin::viewer
