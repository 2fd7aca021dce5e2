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
  glm::dvec3 position{0.0};  // of the eye in the host's world, whose origin touches the ground
  // Where that origin stands among the clouds, east and north. A host that moves its origin along with its camera adds
  // here what it takes from its positions: the sky stays as it is, and the ground below the origin level.
  glm::dvec2 origin{0.0};
  UpAxis up = UpAxis::z;
  Background background = Background::skyAndGround;
  unsigned depthTexture = 0;  // the host's scene depth, as large as the target; 0: none
  DepthRange depthRange = DepthRange::minusOneToOne;
  double time = 0.0;         // s, moves the clouds
  glm::dvec3 velocity{0.0};  // of the eye in m/s: rain and snow streak along with it
  float preExposure = 1.0f;  // factor on kcd/m^2 before it is written
  // Where nothing is known of the light, in a view's first frame, far from the last one, under another sky: waits for
  // weather and light that are complete, however long that takes. false: begins with light that is coarse, and the next
  // frames make it finer (quality.light_frames; Outputs::complete).
  bool waitForLight = true;
  Output output = Output::light;
};

// A view's memory: one for each camera, mirror or cube face that is drawn again and again.
class View {
 public:
  View();
  ~View();
  View(View&&) noexcept;
  View& operator=(View&&) noexcept;
  // Forgets what it has seen: call it after a cut. The next frame is a first one again (Frame::waitForLight).
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
  int particles = 0;            // drops and flakes that were drawn
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

// A texture of OpenGL that belongs to the renderer or a view: read it, do not write it, and forget its name at the next
// call of the renderer. A name of 0: there is none.
struct TextureName {
  unsigned name = 0;
  int width = 0, height = 0, depth = 0;  // depth 0: GL_TEXTURE_2D, else GL_TEXTURE_3D
};

// What a view's last frame leaves to its host beside the picture. The include (Renderer::hostShader) reads all of it;
// the names are for passes that the host has already.
struct Outputs {
  // RGBA16F, linear, at the history's resolution: light that clouds (and air before them) send, times `cloudsFactor` in
  // kcd/m^2, and in alpha the share of light from behind that comes through. Of a frame that has neither depthTexture
  // nor Background::host it holds the sky besides.
  TextureName clouds;
  float cloudsFactor = 1.0f;
  // R16F, nearest, one texel for each block of the history: mean distance of the clouds from the eye, weighted by
  // opacity, times `cloudDepthFactor` in m; where it exceeds 200 km there is no cloud. Each frame marches another pixel
  // of the block, `cloudDepthOffset` of the history's pixels from the block's lower left one.
  TextureName cloudDepth;
  float cloudDepthFactor = 1.0f;
  glm::vec2 cloudDepthOffset{0.0f};
  // The history goes with turns of the camera, by part of one of its pixels: what the target shows at uv stands at
  // uv - historyShift of both.
  glm::vec2 historyShift{0.0f};
  // R32F, nearest, texels as cloudDepth: density samples that the march has taken. None unless samples are counted.
  TextureName samples;
  // R16F, 3D: optical depth of the clouds toward the sun, in nested squares round the eye: the clouds' shadow map. None
  // without quality.lightVolume and with lighting.model nubis.
  TextureName sunDepth;
  // Weather and light are those of this sky at this place; else the frames to come still change them.
  bool complete = true;
  // Light for the host's own lamps, linear Rec.709 in klx; by night the moon is the sun. At the eye and without clouds:
  glm::dvec3 toSun{0.0, 0.0, 1.0};  // unit vector in the host's axes
  glm::vec3 sunIrradiance{0.0f};    // on a plane that faces the sun
  glm::vec3 skyIrradiance{0.0f};    // on level ground, without the sun
  glm::vec3 skyUnderClouds{0.0f};   // the same under the clouds, of the layers' mean cover and depth
  // RG16F, linear, level squares round the eye, whose edge in m is `rainEdge`; x east, y north. Red: what falls at the
  // ground in mm/h; green: how wet it is, 0 to 1. None where nothing falls.
  TextureName rain;
  float rainEdge = 0.0f;
  float snow = 0.0f;  // share of it that is snow, at the ground
};

// Where bindHost puts what the include reads; the numbers are the host's to choose.
struct HostBindings {
  unsigned firstUnit = 0;     // of texture units, up to 9 of them
  unsigned uniformBlock = 0;  // binding of the uniform block
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

  // Takes over the sky's quality alone, but for its preset, which sizes what is cached. Quick for what a Governor
  // changes: shaders, tables and the views' histories are kept. Throws Error (failed) before setScene().
  void setQuality(const Quality& quality);

  // Draws. Leaves the host's OpenGL state as it was, but for the contents of the target.
  void render(View& view, const Frame& frame);

  // Makes what render() needs to know of sky, weather and light round the eye, so that the host can light its opaque
  // surfaces before the clouds are drawn over them. `frame` is that of the render() to come; depth and target are not
  // used. Quick when little has changed. Leaves the host's OpenGL state as it was.
  void prepare(View& view, const Frame& frame);

  // GLSL for the host's own shaders: light and shade of clouds on what it draws, air and clouds before it. Goes after
  // "#version 330" (or later) or "#version 300 es" into a vertex or fragment shader; declares nothing but names that
  // begin with "welkin", "Welkin" and "uWelkin". docs/host.md explains its functions.
  static const std::string& hostShader();

  // Gives a linked program of the host what the include reads, for the view that has been prepared or rendered last.
  // Changes the uniform block's binding, the textures of its type on as many units as the program uses samplers, and
  // unbinds the sampler objects there; all other state stays. Throws Error (badInput) when the program does not use the
  // include, or asks for the clouds of a frame whose sky is in the same texture (see Outputs::clouds), (failed) when
  // another view, or none, was prepared last.
  void bindHost(const View& view, unsigned program, const HostBindings& bindings);

  // What the view's last frame leaves; after prepare() alone the textures are those of the frame before. Throws Error
  // (failed) when another view, or none, was prepared last.
  Outputs outputs(const View& view) const;

  // Counts density samples from now on (a slower shader).
  void countSamples(bool on);
  // Of the last frame; waits for the driver.
  FrameCost lastCost();
  // Every texture and target: the renderer's own, what is cached round the view's eye (views within 900 m of each other
  // share it), and the view's.
  std::vector<MemoryRow> memory(const View& view) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::realtime
