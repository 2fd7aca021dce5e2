#pragma once
// The sky in the window: drawn at a resolution that keeps up while something moves, and at the window's own once
// nothing does.
#include <memory>
#include <string>
#include <vector>

#include "apps/viewer/picture/foreground.hpp"
#include "apps/viewer/picture/reference.hpp"
#include "welkin/base/image.hpp"
#include "welkin/gl/loader.hpp"
#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// A rectangle of the window in pixels; y counts from the lower edge, as OpenGL's does.
struct Region {
  int x = 0, y = 0, width = 1, height = 1;
};

class SkyPicture {
 public:
  // The context of `loader` is current. Throws Error (noOpenGl).
  explicit SkyPicture(const gl::Loader& loader);
  ~SkyPicture();
  SkyPicture(const SkyPicture&) = delete;
  SkyPicture& operator=(const SkyPicture&) = delete;

  // Throws Error (badInput) for what the scene names and cannot be used.
  void setScene(const Scene& scene, const realtime::CustomTextures& textures);
  // Draws this under the sky from now on, as long as it lives; its origin moves along with the camera.
  void setForeground(Foreground* foreground);
  // Forgets what was seen.
  void cut();
  // Whether the first frame, and that after a cut, waits for light that is complete, however long that takes. Else
  // coarse light stands in, and becomes finer over the next frames.
  void waitForLight(bool on);

  // While something moves, quality gives way so that a frame takes `seconds`; 0: it does not.
  void govern(double seconds);
  // How long the last frame took, in all.
  void took(double seconds);

  // Draws what this frame needs: nothing, when the picture has come to rest. `scale`: of the resolution while something
  // moves, in (0, 1]. Returns whether it has drawn. What it draws at rest is the scene's own quality.
  bool draw(const Camera& camera, double time, int width, int height, float scale);
  // Nothing more would change.
  bool settled() const;

  // Tone-maps the picture into a part of a framebuffer. `film.ev` counts, whatever the mode. `overlay`: what is shown
  // beside or in place of it.
  struct Overlay {
    const gl::Texture* reference = nullptr;
    Comparison comparison = Comparison::wipe;
    float wipe = 0.5f;
    float mostSamples = 0.0f;  // above 0, while they are counted: density samples in false colours, red at so many
  };
  void show(unsigned framebuffer, const Region& region, const Film& film, const Overlay& overlay) const;

  // The picture on screen, reduced to a few thousand pixels: for meters and histograms.
  Image meter() const;

  // The picture on screen: linear, kcd/m^2.
  Image read() const;
  // The quality of the last frame.
  const Quality& quality() const;
  // Of the picture drawn last, in pixels.
  int width() const;
  int height() const;
  // Of the last frame that was drawn; waits for the driver.
  realtime::FrameCost cost() const;
  void countSamples(bool on);
  std::vector<realtime::MemoryRow> memory() const;
  const std::string& driver() const;
  bool softwareDriver() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::viewer
