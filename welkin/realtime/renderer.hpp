#pragma once
// The real-time renderer: draws a Scene's sky into a framebuffer of the host's OpenGL context. No OpenGL header needed.
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/gl/loader.hpp"
#include "welkin/noise/volume.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::realtime {

// Which axis of the host's world points up; Welkin's own is z, with +x east and +y north. With yUp, +x is east and -z
// north.
enum class UpAxis { z, y };
enum class DepthRange { minusOneToOne, zeroToOne };
// What stands behind the clouds: Welkin's sky and ground, its sky alone (the host has drawn its ground), or the host's
// picture.
enum class Background { skyAndGround, sky, host };

// What the target receives: light; light without the sun's own disc; or, in every channel, how much of what is behind
// the clouds and the ground comes through.
enum class Output { light, lightWithoutSunDisc, transmittance };

// One picture to be drawn. Positions in metres.
struct Frame {
  int width = 0, height = 0;   // of the target, from its lower left corner
  unsigned framebuffer = 0;    // its first colour attachment receives linear light
  glm::mat4 view{1.0f};        // world to eye; its translation is not used
  glm::mat4 projection{1.0f};  // without jitter; forward, reversed and infinite depth are told apart by its numbers
  // equirectangular: `view` gives the axes, `projection` is not used, and there is no host depth. `panorama` is the
  // part that the target shows: centre x and y, width and height, in shares of the whole; y is 0 at the nadir.
  Projection mapping = Projection::perspective;
  glm::dvec4 panorama{0.5, 0.5, 1.0, 1.0};
  glm::dvec3 position{0.0};  // of the eye in the host's world
  UpAxis up = UpAxis::z;
  Background background = Background::skyAndGround;
  unsigned depthTexture = 0;  // the host's scene depth, as large as the target; 0: none
  DepthRange depthRange = DepthRange::minusOneToOne;
  double time = 0.0;         // s, moves the clouds
  float preExposure = 1.0f;  // factor on kcd/m^2 before it is written
  Output output = Output::light;
};

// A view's memory: one for each camera, mirror or cube face that is drawn again and again.
class View {
 public:
  View();
  ~View();
  View(View&&) noexcept;
  View& operator=(View&&) noexcept;
  // Forgets what it has seen: call it after a cut.
  void reset();

 private:
  friend class Renderer;
  struct State;
  std::unique_ptr<State> state_;
};

// What a frame has cost.
struct PassCost {
  std::string name;
  double milliseconds = 0.0;  // by timestamps; 0 where the driver has none
};
struct FrameCost {
  std::vector<PassCost> passes;
  double densitySamples = 0.0;  // in all; only while counting
  double mostSamples = 0.0;     // of one ray
  double rays = 0.0;
  double textureFetches = 0.0;  // of the march, by what a density sample and a ray read; only while counting
};
struct MemoryRow {
  std::string name, format;
  int width = 0, height = 0, depth = 0;
  std::size_t bytes = 0;
};

// What replaces Welkin's own: an empty volume keeps the generated texture. Layouts as the packed textures of
// noise/textures.hpp.
struct CustomTextures {
  Volume profileBase, profileDetail, profileWarp, nubisBase, nubisDetail, curl;
  std::vector<Volume> weatherMaps;      // one for each layer: RGBA authoring map
  std::vector<PlacedGrid> grids;        // of the scene's grids that name a file
  std::shared_ptr<const SkyModel> sky;  // paints the sky in place of atmosphere.model
};

class Renderer {
 public:
  // Works in the context that is current on this thread; every later call must find it current. Throws Error (noOpenGl)
  // when it is too old.
  explicit Renderer(const gl::Loader& loader);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Takes over the sky. Only what has changed since the last call is made anew.
  void setScene(const Scene& scene, const CustomTextures& textures = {});

  // Draws. Leaves the host's OpenGL state as it was, but for the contents of the target.
  void render(View& view, const Frame& frame);

  // Counts density samples from now on (a slower shader).
  void countSamples(bool on);
  // Of the last frame; waits for the driver.
  FrameCost lastCost();
  // Every texture and target: the renderer's own and, after them, the view's.
  std::vector<MemoryRow> memory(const View& view) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::realtime
