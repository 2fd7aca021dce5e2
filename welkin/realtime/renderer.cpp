#include "welkin/density/classical/clouds.hpp"
#include "welkin/realtime/blocks.hpp"
#include "welkin/realtime/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "welkin/atmosphere/moon.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/hero_grid.hpp"
#include "welkin/gl/state.hpp"
#include "welkin/noise/blue_noise.hpp"
#include "welkin/noise/textures.hpp"
#include "welkin/realtime/falling.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/grid_atlas.hpp"
#include "welkin/realtime/host.hpp"
#include "welkin/realtime/march_params.hpp"
#include "welkin/realtime/noise_textures.hpp"
#include "welkin/realtime/shader_sources.hpp"
#include "welkin/realtime/sky_tables.hpp"
#include "welkin/realtime/surroundings.hpp"
#include "welkin/realtime/timers.hpp"
#include "welkin/scene/lightning.hpp"
#include "welkin/scene/rain.hpp"
#include "welkin/scene/surface.hpp"

namespace welkin::realtime {

namespace {

constexpr int kBlueNoiseSize = 64;
constexpr int kMostWait = 16;               // frames
constexpr int kAirShadePixels = 16;         // edge in the picture of a texel of the shade in the air
constexpr std::size_t kMaxVoxelClouds = 8;  // grids, classical and hero clouds together

// The uniform block "Layers" of the passes that march through clouds.
struct LayersBlock {
  law::LayerParams layers[kMaxLayers];
  law::ClipParams clips[kMaxLayers];
  law::SheetParams sheets[kMaxSheets];
  law::GridParams grids[kMaxVoxelClouds];
  law::AtmosphereParams air;
  law::LightVolumeParams volume;
  law::RainParams rain[kMaxLayers];
};

// Texture fetches of one density sample: every layer reads its weather and its noises.
double fetchesPerSample(const Scene& scene, std::size_t grids) {
  double sum = 2.0 * static_cast<double>(grids);  // index and brick
  for (const Layer& layer : scene.layers) {
    const law::LayerParams p = layerParams(layer, glm::dvec3(0.0), {});
    // profile: warp, weather, base, detail, and where they are used more weather, the anvil's fibres and fine detail.
    // nubis: two of weather, base, curl, detail.
    sum += layer.cloud.shape == LayerShape::nubis
               ? 5.0
               : 4.0 + (p.needsExtra ? 1.0 : 0.0) + (p.hasAnvil ? 1.0 : 0.0) + (p.fineDetail > 0.0f ? 1.0 : 0.0);
  }
  return sum;
}
// Of one ray: the host's depth, sunlight at three heights, air before cloud and ground; a sheet takes three more.
constexpr double kFetchesPerRay = 8.0;

glm::dvec3 eastNorthUp(const glm::dvec3& p, UpAxis up) { return up == UpAxis::z ? p : glm::dvec3(p.x, -p.z, p.y); }
glm::dvec3 hostAxes(const glm::dvec3& p, UpAxis up) { return up == UpAxis::z ? p : glm::dvec3(p.x, p.z, -p.y); }

// The eye's place among the clouds.
glm::dvec2 placeOf(const glm::dvec3& position, const Frame& frame) { return glm::dvec2(position) + frame.origin; }

TextureName nameOf(const gl::Texture& t) { return {t.id(), t.width(), t.height(), t.depth()}; }

}  // namespace

struct View::State {
  int width = 0, height = 0, interleave = 0;
  gl::Texture marched, marchedDepth, samples, airShade, rainSegments;
  std::array<gl::Texture, 2> history;
  int current = 0;             // history that was written last
  int frames = 0;              // since the last reset
  int still = 0;               // frames since anything moved
  int same = 0;                // and since the light became complete
  int scene = 0, quality = 0;  // which of the renderer's scenes it shows, and how
  int jumps = 0;               // the light volume's by then
  bool complete = true;        // the last frame's light
  bool lightDrawn = false;     // its frame to come has had its share of the light volume's work
  std::optional<FrameParams> last;
  glm::dvec3 lastPosition{0.0};
  glm::dvec2 travel{0.0};  // of the picture over the history's grid (frame_params.hpp), pixels
  double lastTime = 0.0;
  float exposure = 1.0f;  // factor on what the history holds
  law::HostParams host{};
  UpAxis up = UpAxis::z;
  gl::UniformBuffer hostBuffer;
  std::shared_ptr<Eye> eye = std::make_shared<Eye>();
  std::shared_ptr<Surroundings> around;
};

View::View() : state_(std::make_unique<State>()) {}
View::~View() = default;
View::View(View&&) noexcept = default;
View& View::operator=(View&&) noexcept = default;
void View::reset() {
  state_->frames = 0;
  state_->still = state_->same = 0;
  state_->last.reset();
  state_->travel = glm::dvec2(0.0);
}

struct Renderer::State {
  gl::Api gl;
  gl::VertexArray triangle;
  gl::Framebuffer framebuffer;
  gl::UniformBuffer frameBuffer, layersBuffer, marchBuffer, weatherBuffer, nightBuffer, lightningBuffer, volumeBuffer;
  SkyTables sky;
  Timers timers;
  Scene scene;
  bool hasScene = false;
  int sceneNumber = 0, qualityNumber = 0, cloudsNumber = 0;
  AirSurface underAir;
  Heavens heavens;
  std::map<std::string, gl::Program> composites;  // by the defines of the variant
  glm::vec3 sunDirection{0.0f, 0.0f, 1.0f};       // of the light: by night it is the moon's
  gl::Texture profileBase, profileDetail, profileWarp, nubisBase, nubisDetail, curl, white, blueNoise;
  std::vector<gl::Texture> maps;
  SurroundingsPool pool;
  std::shared_ptr<Surroundings> around;  // of the view whose turn it is
  WeatherLevels* weather = nullptr;      // what is in them; null when there is nothing to know
  LightVolume* light = nullptr;
  int weatherNumber = 0, skyNumber = 0;  // change when they have to be made anew, or their light is of no use
  GridAtlas grids;
  std::vector<PlacedGrid> heroGrids;  // hero clouds, in still air
  ClassicalClouds classical;
  double cloudTime = 0.0;               // s, that classical clouds were made for
  std::vector<PlacedGrid> placedGrids;  // those handed over
  float gridExtinction = 0.0f;          // their greatest, 1/m
  gl::Program march, lightProgram, sheetProgram, resolve, resolveAveraged, resolveFirstRound, weatherProgram,
      airShadeProgram;
  std::string marchDefines;
  float billowMix = 0.75f;
  bool counting = false, customised = false;
  std::shared_ptr<const SkyModel> userSky;
  double samples = 0.0, mostSamples = 0.0, rays = 0.0;
  FallingPass falling;
  DropLevels drops;                       // of the last lightPass
  int particles = 0;                      // of the last frame
  law::HostParams host{};                 // of the last lightPass
  const View::State* hostView = nullptr;  // that it was for

  explicit State(const gl::Loader& loader)
      : gl(gl::loadApi(loader)), framebuffer(gl), frameBuffer(gl), layersBuffer(gl), marchBuffer(gl), weatherBuffer(gl),
        nightBuffer(gl), lightningBuffer(gl), volumeBuffer(gl), sky(gl), timers(gl), falling(gl) {
    triangle = gl::VertexArray(gl);
    const std::array<unsigned char, 4> texel{255, 255, 255, 255};
    white = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba8, 1, 1, 0, gl::Filter::nearest, gl::Addressing::repeat,
                        texel.data());
    blueNoise = gl::Texture(gl, gl::Texture::Kind::plane, gl::kR16F, kBlueNoiseSize, kBlueNoiseSize, 0,
                            gl::Filter::nearest, gl::Addressing::repeat, welkin::blueNoise(kBlueNoiseSize, 1).data());
    const auto resolveText = shaderText("welkin/realtime/shaders/resolve.frag.glsl");
    resolve = gl::Program(gl, "resolve", "", resolveText, shaderSource);
    resolveAveraged = gl::Program(gl, "resolve, averaged", "#define AVERAGE\n", resolveText, shaderSource);
    resolveFirstRound = gl::Program(gl, "resolve, first round", "#define FIRST_ROUND\n", resolveText, shaderSource);
    weatherProgram =
        gl::Program(gl, "weather", "", shaderText("welkin/realtime/shaders/weather.frag.glsl"), shaderSource);
    airShadeProgram = gl::Program(gl, "shade in the air", "", shaderText("welkin/realtime/shaders/air_shade.frag.glsl"),
                                  shaderSource);
  }

  static bool replacesNoise(const CustomTextures& custom) {
    return !custom.profileBase.texels.empty() || !custom.profileDetail.texels.empty() ||
           !custom.profileWarp.texels.empty() || !custom.nubisBase.texels.empty() ||
           !custom.nubisDetail.texels.empty() || !custom.curl.texels.empty();
  }

  bool sameGrids(const CustomTextures& custom) const {
    const auto same = [](const PlacedGrid& a, const PlacedGrid& b) {
      return a.voxels == b.voxels && a.fromWorld == b.fromWorld && a.extinction == b.extinction;
    };
    return std::equal(placedGrids.begin(), placedGrids.end(), custom.grids.begin(), custom.grids.end(), same);
  }

  // Whether hero clouds baked for one scene are those of another.
  static bool sameHeroes(const Scene& a, const Scene& b) {
    const auto same = [&](const Hero& x, const Hero& y) {
      const bool ages = x.cloud.lifetime > 0.0f || x.cloud.updraft > 0.0f || x.form.shape == HeroShape::classic;
      return sameFields(x.cloud, y.cloud) && sameFields(x.form, y.form) && sameFields(x.surface, y.surface) &&
             sameFields(x.classic, y.classic) && sameFields(x.scatter, y.scatter) && (!ages || a.time == b.time);
    };
    return a.seed == b.seed && std::equal(a.heroes.begin(), a.heroes.end(), b.heroes.begin(), b.heroes.end(), same);
  }

  static bool sameClassicals(const Scene& a, const Scene& b) {
    return a.seed == b.seed &&
           std::equal(a.classical.begin(), a.classical.end(), b.classical.begin(), b.classical.end(), sameClassical);
  }

  // Whether another scene has the very clouds of this one, its textures being the renderer's own.
  bool sameClouds(const Scene& next, const CustomTextures& custom) const {
    const auto sameLayer = [](const Layer& a, const Layer& b) {
      return sameFields(a.cloud, b.cloud) && sameFields(a.weather, b.weather) && sameFields(a.profile, b.profile) &&
             sameFields(a.nubis, b.nubis);
    };
    return hasScene && !customised && !replacesNoise(custom) && custom.weatherMaps.empty() && sameGrids(custom) &&
           sameHeroes(scene, next) && sameClassicals(scene, next) && scene.seed == next.seed &&
           sameFields(scene.wind, next.wind) && sameFields(scene.noise.profile, next.noise.profile) &&
           sameFields(scene.noise.baseShape, next.noise.baseShape) &&
           sameFields(scene.noise.detail, next.noise.detail) && sameFields(scene.noise.curl, next.noise.curl) &&
           std::equal(scene.layers.begin(), scene.layers.end(), next.layers.begin(), next.layers.end(), sameLayer) &&
           std::equal(scene.sheets.begin(), scene.sheets.end(), next.sheets.begin(), next.sheets.end(),
                      [](const Sheet& a, const Sheet& b) { return sameFields(a, b); });
  }

  // Whether another scene has clouds in the same places, of other sizes perhaps, so that light changes over by and by.
  bool kindred(const Scene& next, const CustomTextures& custom) const {
    const auto sameShape = [](const Layer& a, const Layer& b) { return a.cloud.shape == b.cloud.shape; };
    return !customised && !replacesNoise(custom) && scene.seed == next.seed && custom.weatherMaps.empty() &&
           sameGrids(custom) && sameHeroes(scene, next) && sameClassicals(scene, next) &&
           std::equal(scene.layers.begin(), scene.layers.end(), next.layers.begin(), next.layers.end(), sameShape);
  }

  static bool uses(const Scene& sky, LayerShape shape) {
    return std::any_of(sky.layers.begin(), sky.layers.end(), [&](const Layer& l) { return l.cloud.shape == shape; });
  }

  void makeTextures(const Scene& next, const CustomTextures& custom);
  void makeWeather(const Scene& next, const CustomTextures& custom);
  void makeGrids(const Scene& next, const CustomTextures& custom);
  void makeAtlas();
  void evolve(const Drift& drift);
  glm::dvec2 carriedBy(const Drift& drift, std::size_t cloud) const;
  bool lit() const;
  // Over how many frames weather and light may come; after a cut nobody has seen the old ones.
  int framesOf(const View::State& view, const Frame& frame) const {
    return view.frames == 0 && frame.waitForLight ? 1 : scene.quality.lightFrames;
  }
  // Weather and light are those of this sky, here.
  bool complete() const { return !(light && light->stale()) && !(weather && weather->changing()); }
  void surround(View::State& view, const glm::dvec2& place);
  void makeMarch();
  void bindClouds(const gl::Program& program, int unit) const;
  void makeTargets(View::State& view, const Frame& frame) const;
  void bind(const gl::Program& program, const char* name, const gl::Texture& texture, int unit) const {
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(texture.target(), texture.id());
    gl.Uniform1i(program.uniform(name), unit);
  }
  void bindHostDepth(const gl::Program& program, const Frame& frame, int unit) const {
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(GL_TEXTURE_2D, frame.depthTexture ? frame.depthTexture : white.id());
    gl.Uniform1i(program.uniform("uHostDepth"), unit);
  }

  // The passes, in order.
  void skyPass(const glm::dvec3& position);
  void weatherPass(const glm::dvec2& place, const Drift& drift, int frames);
  void lightPass(View::State& view, const Frame& frame, const glm::dvec3& position, const Drift& drift,
                 const FrameParams& params);
  void airShadePass(View::State& view, const Frame& frame);
  void rainPass(View::State& view, const Frame& frame);
  FallingInputs fallingInputs() const {
    return {layersBuffer, marchBuffer, [this](const gl::Program& program, int unit) { bindClouds(program, unit); },
            sky.transmittance(), light};
  }
  void marchPass(View::State& view, const Frame& frame);
  void resolvePass(View::State& view, const Frame& frame, const gl::Program& program);
  void lightningOf(const glm::dvec2& place, double time);
  void compositePass(const View::State& view, const Frame& frame, const FrameParams& params);
  void dropsPass(const Frame& frame, const FrameParams& view, const glm::dvec3& position);
  const gl::Program& compositeProgram(const Frame& frame, const FrameParams& params);
  void checkFrame(const Frame& frame) const;
  void keepForHost(View::State& view, const Frame& frame, const FrameParams& params);
  void checkHostView(const View::State& view) const;
  float exposure() const;
};

Renderer::Renderer(const gl::Loader& loader) : state_(std::make_unique<State>(loader)) {}
Renderer::~Renderer() = default;

void Renderer::State::makeTextures(const Scene& next, const CustomTextures& custom) {
  const bool fresh = !hasScene;
  const auto make = [&](gl::Texture& texture, const Volume& own, bool changed, auto generate) {
    if (!own.texels.empty())
      texture = textureFromVolume(gl, own);
    else if (fresh || changed || !texture || customised)
      texture = generate();
  };
  // Without a GPU our own SIMD lanes make them several times as fast as the driver's (bench/noise.cpp).
  const bool software = gl.software();
  const float mix = next.layers.empty() ? billowMix : next.layers.front().profile.billowMix;
  const NoiseSettings &old = scene.noise, &now = next.noise;
  if (uses(next, LayerShape::profile)) {
    const bool changed = !sameFields(old.profile, now.profile);
    make(profileBase, custom.profileBase, changed || mix != billowMix, [&] {
      return software ? textureFromVolume(gl, bakeProfileBasePacked(now.profile, mix))
                      : generateProfileBasePacked(gl, now.profile, mix);
    });
    make(profileDetail, custom.profileDetail, changed, [&] {
      return software ? textureFromVolume(gl, bakeProfileDetail(now.profile)) : generateProfileDetail(gl, now.profile);
    });
    make(profileWarp, custom.profileWarp, changed, [&] {
      return software ? textureFromVolume(gl, bakeProfileWarp(now.profile)) : generateProfileWarp(gl, now.profile);
    });
  }
  if (uses(next, LayerShape::nubis)) {
    make(nubisBase, custom.nubisBase, !sameFields(old.baseShape, now.baseShape), [&] {
      return software ? textureFromVolume(gl, bakeBaseShapePacked(now.baseShape))
                      : generateBaseShapePacked(gl, now.baseShape);
    });
    make(nubisDetail, custom.nubisDetail, !sameFields(old.detail, now.detail), [&] {
      return software ? textureFromVolume(gl, bakeDetailPacked(now.detail)) : generateDetailPacked(gl, now.detail);
    });
    make(curl, custom.curl, !sameFields(old.curl, now.curl),
         [&] { return software ? textureFromVolume(gl, bakeCurl(now.curl)) : generateCurl(gl, now.curl); });
  }
  billowMix = mix;
  customised = replacesNoise(custom);
}

// The march is compiled for the layers at hand: their number and shapes are part of its text.
void Renderer::State::makeMarch() {
  std::string layers;
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const bool nubis = scene.layers[i].cloud.shape == LayerShape::nubis;
    layers += nubis ? fmt::format(
                          "found = nubisExtinction(q, full, sky.dither, uLayer[{0}], uClip[{0}], uWeather, uExtra, "
                          "uNubisBase, uNubisDetail, uCurl); ",
                          i)
                    : fmt::format(
                          "found = profileExtinction(q, footprint, sky.dither, uLayer[{0}], uClip[{0}], "
                          "uWeather, uExtra, uBaseNoise, uDetailNoise, uWarpNoise); ",
                          i);
    layers += "sum = vec3(sum.x + found.x, max(sum.y, found.y), sum.z + found.z); ";
  }
  for (std::size_t i = 0; i < grids.count(); ++i)
    layers += fmt::format(
        "inGrid = gridExtinction({1}, uGrid[{0}], uGridIndex, uGridBricks); "
        "sum = vec3(sum.x + inGrid.x, max(sum.y, inGrid.y), sum.z); ",
        i, grids.scattered(i) ? fmt::format("scatteredPoint(q, uGrid[{}].scatter)", i) : "q");
  std::string clearance;
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    clearance +=
        fmt::format("clear = min(clear, layerClearance(q, way, sky.dither, uLayer[{0}], uClip[{0}], uBounds)); ", i);
  for (std::size_t i = 0; i < grids.count(); ++i)
    clearance += fmt::format("clear = min(clear, {}(q, way, uGrid[{}])); ",
                             grids.scattered(i) ? "scatterClearance" : "gridClearance", i);
  std::string rain;
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    if (rains(scene, scene.layers[i]))
      rain += fmt::format(
          "rate = rainRate(q, sky.dither, uLayer[{0}], uClip[{0}], uRain[{0}], uWeather, uExtra, {1}); "
          "snow = snowShare(q.z, uRain[{0}].freezing); sigma = fallingExtinction(rate, snow); "
          "sum += vec3(rate, sigma, sigma * snow); ",
          i, scene.layers[i].cloud.shape == LayerShape::nubis ? "uNubisBase" : "uBaseNoise");
  std::string clouds =
      fmt::format("#define LAYER_SLOTS {}\n#define SHEET_COUNT {}\n#define GRID_SLOTS {}\n#define SKY_LAYERS {}\n",
                  kMaxLayers, scene.sheets.size(), kMaxVoxelClouds, layers);
  if (!rain.empty()) clouds += "#define SKY_RAIN " + rain + "\n";
  const std::string defines = clouds + (counting ? "#define COUNT_SAMPLES\n" : "") +
                              (lit() ? "#define LIGHT_VOLUME\n#define SKY_CLEARANCE " + clearance + "\n" : "");
  if (!rain.empty()) falling.compile(clouds, lit());
  const std::string text = defines + (scene.lightning.rate > 0.0f ? "#define LIGHTNING\n" : "");
  if (text == marchDefines) return;
  if (lit()) {
    lightProgram = gl::Program(gl, "light density", clouds,
                               shaderText("welkin/realtime/shaders/light_density.frag.glsl"), shaderSource);
    sheetProgram = scene.sheets.empty()
                       ? gl::Program()
                       : gl::Program(gl, "light sheets", clouds,
                                     shaderText("welkin/realtime/shaders/light_sheets.frag.glsl"), shaderSource);
  }
  march = gl::Program(gl, "march", text, shaderText("welkin/realtime/shaders/march.frag.glsl"), shaderSource);
  marchDefines = text;
}

void Renderer::setScene(const Scene& scene, const CustomTextures& textures) {
  State& s = *state_;
  if (scene.layers.size() > kMaxLayers || scene.sheets.size() > kMaxSheets)
    throw Error(ErrorKind::badInput, "",
                fmt::format("a sky has at most {} layers and {} sheets", kMaxLayers, kMaxSheets));
  const gl::StateGuard guard(s.gl);
  s.gl.BindVertexArray(s.triangle.id());
  s.heavens = heavensOf(scene.sun, scene.moon, scene.night);
  s.sunDirection = s.heavens.lights.light.direction;
  if (!s.sameClouds(scene, textures)) {
    ++s.cloudsNumber;
    s.underAir = airSurface(scene);
  }
  if (!s.kindred(scene, textures)) ++s.skyNumber;
  s.underAir.ground = scene.ground.albedo;
  s.makeTextures(scene, textures);
  s.makeWeather(scene, textures);
  s.makeGrids(scene, textures);
  s.userSky = textures.sky;
  s.scene = scene;
  s.hasScene = true;
  s.hostView = nullptr;
  ++s.sceneNumber;
  s.makeMarch();
}

void Renderer::setQuality(const Quality& quality) {
  State& s = *state_;
  if (!s.hasScene) throw Error(ErrorKind::failed, "", "a quality was set before setScene()");
  Quality next = quality;
  next.preset = s.scene.quality.preset;
  // How fast light comes does not change the picture.
  s.scene.quality.lightFrames = next.lightFrames;
  if (next == s.scene.quality) return;
  const gl::StateGuard guard(s.gl);
  s.gl.BindVertexArray(s.triangle.id());
  s.scene.quality = next;
  s.hostView = nullptr;
  ++s.qualityNumber;
  s.makeMarch();
}

void Renderer::State::makeWeather(const Scene& next, const CustomTextures& custom) {
  const bool pictures = !custom.weatherMaps.empty();
  bool same = hasScene && !pictures && maps.size() == next.layers.size() && scene.seed == next.seed &&
              sameFields(scene.wind, next.wind) && scene.quality.preset == next.quality.preset;
  for (std::size_t i = 0; same && i < next.layers.size(); ++i) {
    const Layer &a = scene.layers[i], &b = next.layers[i];
    same = !maps[i] && sameFields(a.weather, b.weather) && sameFields(a.cloud, b.cloud) &&
           sameFields(a.nubis, b.nubis) && a.profile.baseVariation == b.profile.baseVariation;
  }
  if (same) return;
  ++weatherNumber;
  maps.clear();
  for (std::size_t i = 0; i < next.layers.size(); ++i) {
    const std::string& name = next.layers[i].weather.map;
    const bool given = i < custom.weatherMaps.size() && !custom.weatherMaps[i].texels.empty();
    if (!name.empty() && !given)
      throw Error(ErrorKind::badInput, "", "the weather map '" + name + "' was not handed to the renderer");
    maps.push_back(given ? textureFromVolume(gl, custom.weatherMaps[i]) : gl::Texture());
  }
}

// Whether there is a volume of light.
bool Renderer::State::lit() const {
  const bool clouds = !scene.layers.empty() || grids.count() > 0;
  return clouds && scene.quality.lightVolume && scene.lighting.model != LightingModel::nubis;
}

// What is cached round the view's eye.
void Renderer::State::surround(View::State& view, const glm::dvec2& place) {
  around = view.around = pool.of(view.eye, view.around, place);
  if (around->weatherNumber != weatherNumber) {
    const WeatherExtent extent = weatherExtent(scene.quality.preset);
    const int layers = static_cast<int>(scene.layers.size());
    if (around->weather && around->skyNumber == skyNumber && around->weather->fits(extent, layers))
      around->weather->change();
    else
      around->weather = layers > 0 ? std::make_unique<WeatherLevels>(gl, extent, layers, gl.software()) : nullptr;
    around->weatherNumber = weatherNumber;
  }
  if (!lit())
    around->light.reset();
  else if (!around->light || around->light->preset() != scene.quality.preset)
    around->light = std::make_unique<LightVolume>(gl, scene.quality.preset);
  else if (around->skyNumber != skyNumber)
    around->light->forget();
  around->skyNumber = skyNumber;
  weather = around->weather.get();
  light = around->light.get();
}

void Renderer::State::makeGrids(const Scene& next, const CustomTextures& custom) {
  const auto named =
      std::count_if(next.grids.begin(), next.grids.end(), [](const GridCloud& g) { return !g.file.empty(); });
  if (custom.grids.size() < static_cast<std::size_t>(named) || custom.grids.size() > kMaxGrids)
    throw Error(ErrorKind::badInput, "",
                fmt::format("the sky names {} grids, and {} were handed to the renderer, which takes at most {}", named,
                            custom.grids.size(), kMaxGrids));
  const std::size_t all = custom.grids.size() + next.classical.size() + next.heroes.size();
  if (all > kMaxVoxelClouds)
    throw Error(
        ErrorKind::badInput, "",
        fmt::format("the real-time renderer draws at most {} grids, classical and hero clouds together, and this "
                    "sky has {}; the path tracer (--renderer path) draws them all",
                    kMaxVoxelClouds, all));
  // Frames may have gone on from the scene's time.
  if (!hasScene || scene.time != next.time) cloudTime = next.time;
  const bool moved = classical.update(next.classical, {next.wind.speed, next.wind.from, cloudTime}, next.seed);
  const bool known = hasScene && sameHeroes(scene, next);
  if (known && sameGrids(custom) && !moved) return;
  placedGrids = custom.grids;
  if (!known) {
    heroGrids.clear();
    for (const Hero& hero : next.heroes) heroGrids.push_back(heroGrid(hero, next.time, next.seed));
  }
  makeAtlas();
}

// Of all clouds that are voxels: those handed over, classical ones, hero clouds.
void Renderer::State::makeAtlas() {
  std::vector<PlacedGrid> all = placedGrids;
  for (std::size_t i = 0; i < classical.count(); ++i) all.push_back(classical.still(i));
  all.insert(all.end(), heroGrids.begin(), heroGrids.end());
  grids = GridAtlas(gl, all);
  gridExtinction = 0.0f;
  for (const PlacedGrid& grid : all)
    gridExtinction = std::max(gridExtinction, grid.voxels->maximum() * static_cast<float>(grid.extinction));
}

// Classical clouds that are others at another time.
void Renderer::State::evolve(const Drift& drift) {
  cloudTime = drift.time;
  if (!classical.update(scene.classical, drift, scene.seed)) return;
  makeAtlas();
  ++cloudsNumber;
}

void Renderer::State::makeTargets(View::State& view, const Frame& frame) const {
  // A panorama's history is as large as its target: it could not be filtered across the seam and the poles.
  const int scale = frame.mapping == Projection::equirectangular ? 1 : scene.quality.historyScale;
  const int interleave = scene.quality.reprojection ? scene.quality.interleave : 1;
  const int width = (frame.width + scale - 1) / scale, height = (frame.height + scale - 1) / scale;
  const auto target = [&](const gl::Format& format, int w, int h, gl::Filter filter) {
    return gl::Texture(gl, gl::Texture::Kind::plane, format, w, h, 0, filter, gl::Addressing::clamp, nullptr);
  };
  // The history that is read may have another size than the one that is written next: a picture goes over into another
  // quality without a break.
  gl::Texture& written = view.history[static_cast<std::size_t>(1 - view.current)];
  if (!written || written.width() != width || written.height() != height)
    written = target(gl::kRgba16F, width, height, gl::Filter::linear);
  gl::Texture& read = view.history[static_cast<std::size_t>(view.current)];
  if (!read) read = target(gl::kRgba16F, width, height, gl::Filter::linear);
  if (view.width == width && view.height == height && view.interleave == interleave &&
      static_cast<bool>(view.samples) == counting)
    return;
  const int w = (width + interleave - 1) / interleave, h = (height + interleave - 1) / interleave;
  view.marched = target(gl::kRgba16F, w, h, gl::Filter::linear);
  view.marchedDepth = target(gl::kR16F, w, h, gl::Filter::nearest);
  view.samples = counting ? target(gl::kR32F, w, h, gl::Filter::nearest) : gl::Texture();
  view.width = width;
  view.height = height;
  view.interleave = interleave;
}

void Renderer::State::skyPass(const glm::dvec3& position) {
  const double altitude = planetParams(position).altitude;
  sky.update(scene.atmosphere, heavens.lights, std::max(altitude, 0.0), underAir, userSky.get());
}

// `frames`: over how many it may come.
void Renderer::State::weatherPass(const glm::dvec2& place, const Drift& drift, int frames) {
  if (!weather) return;
  const bool changing = weather->changing();
  const int most = frames == 1 ? WeatherLevels::kAll : 1;
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    weather->update(static_cast<int>(i), scene.layers[i], place, drift, scene.seed, weatherProgram, framebuffer,
                    weatherBuffer, maps[i] ? maps[i] : white, most);
  // Light that has been made among both must be made again.
  if (changing && !weather->changing()) ++cloudsNumber;
}

// How far the wind has carried a cloud of the atlas, m.
glm::dvec2 Renderer::State::carriedBy(const Drift& drift, std::size_t cloud) const {
  if (cloud < placedGrids.size()) return glm::dvec2(0.0);
  const std::size_t i = cloud - placedGrids.size();
  if (i < classical.count()) return classical.carried(i);
  return double(scene.heroes[i - classical.count()].cloud.drift) * driftOffset(drift);
}

// What the passes that march need to know, and the volume of light.
void Renderer::State::lightPass(View::State& view, const Frame& frame, const glm::dvec3& position, const Drift& drift,
                                const FrameParams& params) {
  const glm::dvec2 place = placeOf(position, frame);
  evolve(drift);
  LayersBlock block{};
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    block.layers[i] = layerParams(scene.layers[i], glm::dvec3(place, 0.0), drift);
    block.clips[i] = weather->params(static_cast<int>(i), place, drift);
    block.rain[i] = rainParams(scene, scene.layers[i]);
  }
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    block.sheets[i] = sheetParams(scene.sheets[i], place, drift.time, scene.seed);
  std::vector<Shell> shells;
  for (std::size_t i = 0; i < grids.count(); ++i) {
    block.grids[i] = grids.params(i, place - carriedBy(drift, i));
    shells.push_back(grids.shell(i));
  }
  block.air = sky.params().air;
  law::MarchParams m = marchParams(scene, planetParams(position), sunDirection, sky.light(), params.options.w,
                                   frame.background == Background::skyAndGround, shells, gridExtinction);
  drops = {};
  if (rains(scene) && m.planet.altitude < m.rain.x) {
    drops = dropLevels(scene.precipitation, params, m.planet.altitude);
    m.rain.y = drops.reach[0] > 0.0f ? drops.falling.share : 0.0f;
    m.rain.z = drops.reach[kDropLevels - 1];
  }
  m.skyBehind = frame.background == Background::host ? 0.0f : 1.0f;
  marchBuffer.upload(&m, sizeof m);
  if (light) {
    light->place(place, drift, {m.bottom, m.top}, sunDirection, cloudsNumber);
    block.volume = light->params();
  }
  layersBuffer.upload(&block, sizeof block);
  // Light follows weather that changes, or goes along when that has no end.
  around->waited = weather && weather->changing() ? around->waited + 1 : 0;
  const int frames = framesOf(view, frame);
  const bool waits =
      around->waited > 0 && around->waited <= kMostWait && frames > 1 && light && !light->lost(!frame.waitForLight);
  if (light && light->stale() && !view.lightDrawn && !waits) {
    gl.UseProgram(lightProgram.id());
    lightProgram.bindBlock("Layers", kLayersBlock);
    layersBuffer.bind(kLayersBlock);
    bindClouds(lightProgram, 0);
    if (sheetProgram.id()) sheetProgram.bindBlock("Layers", kLayersBlock);
    glm::vec4 heights(-1e9f);
    for (std::size_t i = 0; i < scene.sheets.size(); ++i) heights[static_cast<int>(i)] = scene.sheets[i].height;
    light->draw({lightProgram, sheetProgram, heights}, framebuffer, frames, !frame.waitForLight);
    block.volume = light->params();
    layersBuffer.upload(&block, sizeof block);
  }
  if (rains(scene)) falling.drawMap(fallingInputs(), framebuffer, driftOffset({drift.windSpeed, drift.windFrom, 1.0}));
  host = hostParams(block.air, light ? &block.volume : nullptr, m, sky.light());
  host.rainScale = rains(scene) ? 1.0f / kRainMapEdge : 0.0f;
  host.freezing = freezingLevel(scene.precipitation);
}

void Renderer::State::bindClouds(const gl::Program& program, int unit) const {
  if (weather) {
    bind(program, "uWeather", weather->main(), unit++);
    bind(program, "uExtra", weather->extra(), unit++);
  }
  if (uses(scene, LayerShape::profile)) {
    bind(program, "uBaseNoise", profileBase, unit++);
    bind(program, "uDetailNoise", profileDetail, unit++);
    bind(program, "uWarpNoise", profileWarp, unit++);
  }
  if (uses(scene, LayerShape::nubis)) {
    bind(program, "uNubisBase", nubisBase, unit++);
    bind(program, "uNubisDetail", nubisDetail, unit++);
    bind(program, "uCurl", curl, unit++);
  }
  if (grids.count() > 0) {
    bind(program, "uGridIndex", grids.index(), unit++);
    bind(program, "uGridBricks", grids.bricks(), unit++);
  }
}

// How clouds shade the air along the rays of the view (shaders/air_shade.frag.glsl).
void Renderer::State::airShadePass(View::State& view, const Frame& frame) {
  if (!light) {
    view.airShade = gl::Texture();
    return;
  }
  const int width = (frame.width + kAirShadePixels - 1) / kAirShadePixels;
  const int height = 2 * ((frame.height + kAirShadePixels - 1) / kAirShadePixels);
  if (view.airShade.width() != width || view.airShade.height() != height)
    view.airShade = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba8, width, height, 0, gl::Filter::linear,
                                gl::Addressing::clamp, nullptr);
  const gl::Texture* targets[] = {&view.airShade};
  framebuffer.target(targets);
  gl.UseProgram(airShadeProgram.id());
  airShadeProgram.bindBlock("Frame", kFrameBlock);
  airShadeProgram.bindBlock("Volume", kLayersBlock);
  airShadeProgram.bindBlock("March", kMarchBlock);
  const law::LightVolumeParams volume = light->params();
  volumeBuffer.upload(&volume, sizeof volume);
  frameBuffer.bind(kFrameBlock);
  volumeBuffer.bind(kLayersBlock);
  marchBuffer.bind(kMarchBlock);
  bind(airShadeProgram, "uSun", light->sun(), 0);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::State::rainPass(View::State& view, const Frame& frame) {
  if (!rains(scene)) {
    view.rainSegments = gl::Texture();
    return;
  }
  const int marched = view.interleave * ((frame.width + view.width - 1) / view.width);
  const glm::ivec2 size = rainPictureSize(frame.width, frame.height, marched);
  if (view.rainSegments.width() != size.x || view.rainSegments.height() != size.y)
    view.rainSegments = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba16F, size.x, size.y, 0, gl::Filter::linear,
                                    gl::Addressing::clamp, nullptr);
  falling.drawSegments(fallingInputs(), framebuffer, frameBuffer, view.rainSegments);
}

void Renderer::State::marchPass(View::State& view, const Frame& frame) {
  std::vector<const gl::Texture*> targets{&view.marched, &view.marchedDepth};
  if (counting) targets.push_back(&view.samples);
  framebuffer.target(targets);
  gl.UseProgram(march.id());
  march.bindBlock("Frame", kFrameBlock);
  march.bindBlock("Layers", kLayersBlock);
  march.bindBlock("March", kMarchBlock);
  if (scene.lightning.rate > 0.0f) {
    march.bindBlock("Lightning", kLightningBlock);
    lightningBuffer.bind(kLightningBlock);
  }
  frameBuffer.bind(kFrameBlock);
  layersBuffer.bind(kLayersBlock);
  marchBuffer.bind(kMarchBlock);
  int unit = 0;
  bind(march, "uTransmittance", sky.transmittance(), unit++);
  bind(march, "uAerialInscatter", sky.aerialInscatter(), unit++);
  bind(march, "uAerialTransmittance", sky.aerialTransmittance(), unit++);
  bind(march, "uSkyView", sky.skyView(), unit++);
  bind(march, "uBlueNoise", blueNoise, unit++);
  bindHostDepth(march, frame, unit++);
  if (view.rainSegments) bind(march, "uRainSegments", view.rainSegments, unit++);
  if (light) {
    bind(march, "uSun", light->sun(), unit++);
    bind(march, "uDiffuse", light->diffuse(), unit++);
    bind(march, "uBelow", light->below(), unit++);
    bind(march, "uAirShade", view.airShade, unit++);
    if (weather) bind(march, "uBounds", weather->bounds(), unit++);
  }
  bindClouds(march, unit);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  if (!counting) return;
  std::vector<float> counts(static_cast<std::size_t>(view.samples.width()) * view.samples.height());
  gl.ReadBuffer(GL_COLOR_ATTACHMENT2);
  gl.ReadPixels(0, 0, view.samples.width(), view.samples.height(), GL_RED, GL_FLOAT, counts.data());
  samples = mostSamples = 0.0;
  for (const double c : counts) {
    samples += c;
    mostSamples = std::max(mostSamples, c);
  }
  rays = static_cast<double>(counts.size());
}

void Renderer::State::resolvePass(View::State& view, const Frame& frame, const gl::Program& program) {
  const gl::Texture* targets[] = {&view.history[static_cast<std::size_t>(1 - view.current)]};
  framebuffer.target(targets);
  gl.UseProgram(program.id());
  program.bindBlock("Frame", kFrameBlock);
  frameBuffer.bind(kFrameBlock);
  bind(program, "uMarched", view.marched, 0);
  bind(program, "uMarchedDepth", view.marchedDepth, 1);
  bind(program, "uHistory", view.history[static_cast<std::size_t>(view.current)], 2);
  bindHostDepth(program, frame, 3);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  view.current = 1 - view.current;
}

// The flash of this moment, for a march that was compiled for it.
void Renderer::State::lightningOf(const glm::dvec2& place, double time) {
  if (scene.lightning.rate <= 0.0f) return;
  law::LightningParams l{};
  if (const std::optional<Flash> flash = flashAt(scene, place, time))
    l.flash = glm::vec4(glm::vec3(glm::dvec2(flash->position) - place, flash->position.z),
                        static_cast<float>(flash->intensity));
  l.colour = glm::vec4(0.86f, 1.0f, 1.41f, 0.0f);  // a plasma of 10,000 K and more, as the moon sees it: violet-white
  lightningBuffer.upload(&l, sizeof l);
}

const gl::Program& Renderer::State::compositeProgram(const Frame& frame, const FrameParams& params) {
  const bool drawn = frame.background != Background::host && frame.output != Output::transmittance;
  std::string defines;
  if (frame.depthTexture) defines += drawn ? "#define DEPTH\n#define SKY\n" : "#define DEPTH\n";
  if (drawn && frame.output == Output::light && mayShow(params, glm::vec3(sky.params().air.sunDirection), 0.05f))
    defines += "#define DISC\n";
  if (drawn && heavens.moonShows) defines += "#define MOON\n";
  if (drawn && heavens.starsShow) defines += "#define STARS\n";
  const auto found = composites.find(defines);
  if (found != composites.end()) return found->second;
  return composites
      .emplace(defines, gl::Program(gl, "composite", defines, shaderText("welkin/realtime/shaders/composite.frag.glsl"),
                                    shaderSource))
      .first->second;
}

// Rain and snow near the eye, over the picture.
void Renderer::State::dropsPass(const Frame& frame, const FrameParams& view, const glm::dvec3& position) {
  particles = 0;
  if (drops.reach[0] <= 0.0f) return;
  const law::PlanetParams planet = planetParams(position);
  const double surface = law::kSurfaceWind;
  particles = falling.drawDrops({.frame = frame,
                                 .view = view,
                                 .frameBlock = frameBuffer,
                                 .levels = drops,
                                 .eye = glm::dvec3(placeOf(position, frame), position.z),
                                 .up = glm::dvec3(glm::vec3(planet.up)),
                                 .altitude = planet.altitude,
                                 .toSun = sunDirection,
                                 .wind = surface * driftOffset({scene.wind.speed, scene.wind.from, 1.0}),
                                 .velocity = eastNorthUp(frame.velocity, frame.up),
                                 .rate = scene.precipitation.rate,
                                 .shutter = scene.precipitation.shutter,
                                 .most = scene.precipitation.particles,
                                 .framebuffer = framebuffer});
}

// By night the history holds light times this: half floats lose digits below 6e-5, which is a moonlit cloud.
float Renderer::State::exposure() const {
  constexpr float kNightExposure = 4096.0f, kDark = -0.1f;  // the sine of the sun's height
  const bool night = heavens.sun.z < kDark && scene.atmosphere.model != SkyKind::gradient && !userSky;
  return night ? kNightExposure : 1.0f;
}

void Renderer::State::compositePass(const View::State& view, const Frame& frame, const FrameParams& params) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
  gl.Viewport(0, 0, frame.width, frame.height);
  gl.Enable(GL_BLEND);
  gl.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
  gl.BlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
  const gl::Program& program = compositeProgram(frame, params);
  gl.UseProgram(program.id());
  program.bindBlock("Frame", kFrameBlock);
  program.bindBlock("Air", kLayersBlock);
  frameBuffer.bind(kFrameBlock);
  weatherBuffer.upload(&sky.params().air, sizeof(law::AtmosphereParams));
  weatherBuffer.bind(kLayersBlock);
  if (heavens.moonShows || heavens.starsShow) {
    program.bindBlock("Night", kNightBlock);
    nightBuffer.upload(&heavens.night, sizeof heavens.night);
    nightBuffer.bind(kNightBlock);
  }
  bind(program, "uHistory", view.history[static_cast<std::size_t>(view.current)], 0);
  bind(program, "uSkyView", sky.skyView(), 1);
  bind(program, "uTransmittance", sky.transmittance(), 2);
  bindHostDepth(program, frame, 3);
  bind(program, "uMarchedDepth", view.marchedDepth, 4);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::State::checkFrame(const Frame& frame) const {
  if (!hasScene) throw Error(ErrorKind::failed, "", "a frame was asked for before setScene()");
  if (frame.width < 1 || frame.height < 1 || frame.width > 16384 || frame.height > 16384)
    throw Error(
        ErrorKind::badInput, "",
        fmt::format("a picture of {}x{} pixels cannot be drawn; edges go from 1 to 16384", frame.width, frame.height));
  if (frame.mapping == Projection::equirectangular && frame.depthTexture != 0)
    throw Error(ErrorKind::badInput, "", "an equirectangular picture takes no depth of the host");
}

void Renderer::State::keepForHost(View::State& view, const Frame& frame, const FrameParams& params) {
  setHostView(host, frame, params);
  view.host = host;
  view.up = frame.up;
  if (!view.hostBuffer) view.hostBuffer = gl::UniformBuffer(gl);
  view.hostBuffer.upload(&view.host, sizeof view.host);
  hostView = &view;
}

void Renderer::State::checkHostView(const View::State& view) const {
  if (hostView != &view)
    throw Error(
        ErrorKind::failed, "",
        "sky and light are not those of this view: call prepare() or render() for it first, and draw what needs "
        "them before another view's turn comes or the scene changes");
}

void Renderer::prepare(View& view, const Frame& frame) {
  State& s = *state_;
  View::State& v = *view.state_;
  s.checkFrame(frame);
  const gl::StateGuard guard(s.gl);
  s.gl.BindVertexArray(s.triangle.id());
  const glm::dvec3 position = eastNorthUp(frame.position, frame.up);
  const glm::dvec2 place = placeOf(position, frame);
  const Drift drift{s.scene.wind.speed, s.scene.wind.from, frame.time};
  const FrameParams params =
      frameParams(frame, std::max(v.width, 1), std::max(v.height, 1), std::max(v.interleave, 1), s.scene.quality, 0);
  s.surround(v, place);
  s.skyPass(position);
  s.weatherPass(place, drift, s.framesOf(v, frame));
  s.lightPass(v, frame, position, drift, params);
  v.lightDrawn = true;
  s.frameBuffer.upload(&params, sizeof params);
  s.airShadePass(v, frame);
  s.keepForHost(v, frame, params);
  s.gl.check("preparing a frame");
}

const std::string& Renderer::hostShader() { return hostShaderText(); }

void Renderer::bindHost(const View& view, unsigned program, const HostBindings& bindings) {
  const State& s = *state_;
  const View::State& v = *view.state_;
  s.checkHostView(v);
  const bool onlyClouds = !v.last || (v.last->options.z != 1.0f && v.last->camera.forward.w < 0.5f);
  if (!onlyClouds && s.gl.GetUniformLocation(program, "uWelkinClouds") >= 0)
    throw Error(ErrorKind::badInput, "",
                "welkinFront() and welkinThrough() need a perspective frame with depthTexture or Background::host: "
                "without them the sky is part of what the view knows of its clouds");
  const HostSampler samplers[] = {{"uWelkinClouds", GL_TEXTURE_2D, &v.history[static_cast<std::size_t>(v.current)]},
                                  {"uWelkinCloudDepth", GL_TEXTURE_2D, &v.marchedDepth},
                                  {"uWelkinTransmittance", GL_TEXTURE_2D, &s.sky.transmittance()},
                                  {"uWelkinInscatter", GL_TEXTURE_3D, &s.sky.aerialInscatter()},
                                  {"uWelkinThrough", GL_TEXTURE_3D, &s.sky.aerialTransmittance()},
                                  {"uWelkinSunDepth", GL_TEXTURE_3D, s.light ? &s.light->sun() : nullptr},
                                  {"uWelkinBelow", GL_TEXTURE_3D, s.light ? &s.light->below() : nullptr},
                                  {"uWelkinAirShade", GL_TEXTURE_2D, s.light ? &v.airShade : nullptr},
                                  {"uWelkinRain", GL_TEXTURE_2D, rains(s.scene) ? &s.falling.map() : nullptr}};
  realtime::bindHost(s.gl, program, bindings.firstUnit, bindings.uniformBlock, v.hostBuffer, samplers);
}

Outputs Renderer::outputs(const View& view) const {
  const State& s = *state_;
  const View::State& v = *view.state_;
  s.checkHostView(v);
  Outputs o;
  o.clouds = nameOf(v.history[static_cast<std::size_t>(v.current)]);
  o.cloudsFactor = 1.0f / v.exposure;
  o.cloudDepth = nameOf(v.marchedDepth);
  o.cloudDepthFactor = v.host.depthUnit;
  if (v.samples) o.samples = nameOf(v.samples);
  if (v.last) {
    o.cloudsFactor = 1.0f / v.last->wind.w;
    o.cloudDepthOffset = glm::vec2(v.last->offset);
    o.historyShift = glm::vec2(v.last->lock);
  }
  if (rains(s.scene)) {
    o.rain = nameOf(s.falling.map());
    o.rainEdge = kRainMapEdge;
    o.snow = law::snowShare(0.0f, freezingLevel(s.scene.precipitation));
  }
  if (s.light) o.sunDepth = nameOf(s.light->sun());
  o.complete = s.complete();
  o.toSun = hostAxes(glm::dvec3(s.sunDirection), v.up);
  o.sunIrradiance = s.sky.light().sunIrradiance;
  o.skyIrradiance = s.sky.light().skyIrradiance;
  o.skyUnderClouds = glm::vec3(v.host.shadedSky);
  return o;
}

void Renderer::render(View& view, const Frame& frame) {
  State& s = *state_;
  View::State& v = *view.state_;
  s.checkFrame(frame);
  const gl::StateGuard guard(s.gl);
  s.gl.BindVertexArray(s.triangle.id());
  s.makeTargets(v, frame);
  const glm::dvec3 position = eastNorthUp(frame.position, frame.up);
  const glm::dvec2 place = placeOf(position, frame);
  s.surround(v, place);
  const Drift drift{s.scene.wind.speed, s.scene.wind.from, frame.time};

  if (v.exposure != s.exposure()) {
    view.reset();
    v.exposure = s.exposure();
  }
  const auto paramsNow = [&] { return frameParams(frame, v.width, v.height, v.interleave, s.scene.quality, v.frames); };
  const auto exposed = [&](FrameParams params) {
    params.wind.w *= v.exposure;
    params.options.x = 1.0f / v.exposure;
    return params;
  };
  const FrameParams unlocked = paramsNow();
  FrameParams params = exposed(unlocked);
  if (v.last && v.last->options.z != params.options.z) view.reset();

  s.timers.begin();
  s.lightningOf(place, frame.time);
  s.skyPass(position);
  s.timers.mark("sky tables");
  s.weatherPass(place, drift, s.framesOf(v, frame));
  s.timers.mark("weather");
  s.lightPass(v, frame, position, drift, unlocked);
  v.lightDrawn = false;
  s.timers.mark("light volume");

  const int turns = v.interleave * v.interleave, jumps = s.light ? s.light->jumps() : 0;
  const bool jumped = v.jumps != jumps;
  const bool stands = v.last && sameView(*v.last, params) && v.lastPosition == glm::dvec3(place, position.z) &&
                      v.lastTime == frame.time && v.scene == s.sceneNumber && v.quality == s.qualityNumber;
  // A picture that is not whole yet begins anew with the new light.
  if (stands && jumped && v.still + 1 == v.frames && v.frames < turns) {
    view.reset();
    params = exposed(paramsNow());
  }
  if (v.last) v.travel += travelled(params, *v.last);
  lockGrid(params, v.travel);
  v.still = stands && v.last ? v.still + 1 : 0;
  v.same = v.still > 0 && v.complete && !jumped ? v.same + 1 : 0;
  const bool begun = v.still == v.frames && v.frames < turns;
  const History history = v.frames == 0 || !s.scene.quality.reprojection ? History::none
                          : begun                                        ? History::begun
                          : v.scene != s.sceneNumber || jumped           ? History::changed
                          : v.still > 0                                  ? History::still
                                                                         : History::moved;
  setHistory(params, v.last ? &*v.last : nullptr, glm::dvec3(place, position.z) - v.lastPosition,
             driftOffset(drift) - driftOffset(Drift{drift.windSpeed, drift.windFrom, v.lastTime}), history,
             1.0f / static_cast<float>(v.same / turns + 1));
  s.frameBuffer.upload(&params, sizeof params);

  s.airShadePass(v, frame);
  s.timers.mark("air shade");
  s.rainPass(v, frame);
  s.timers.mark("rain");
  s.marchPass(v, frame);
  s.timers.mark("march");
  const bool average = s.scene.quality.averageHistory && history != History::none;
  s.resolvePass(v, frame,
                v.frames > 0 && v.frames < turns && history != History::none ? s.resolveFirstRound
                : average                                                    ? s.resolveAveraged
                                                                             : s.resolve);
  s.timers.mark("resolve");
  s.compositePass(v, frame, params);
  s.timers.mark("composite");
  s.dropsPass(frame, unlocked, position);
  s.timers.mark("drops");
  s.gl.check("drawing a frame");

  v.last = params;
  v.lastPosition = glm::dvec3(place, position.z);
  v.lastTime = frame.time;
  v.scene = s.sceneNumber;
  v.quality = s.qualityNumber;
  v.complete = s.complete();
  v.jumps = jumps;
  ++v.frames;
  s.keepForHost(v, frame, params);
}

void Renderer::countSamples(bool on) {
  State& s = *state_;
  s.counting = on;
  if (!s.hasScene) return;
  const gl::StateGuard guard(s.gl);
  s.makeMarch();
}

FrameCost Renderer::lastCost() {
  FrameCost cost;
  for (const PassTime& pass : state_->timers.read()) cost.passes.push_back({pass.name, pass.milliseconds});
  cost.densitySamples = state_->counting ? state_->samples : 0.0;
  cost.mostSamples = state_->counting ? state_->mostSamples : 0.0;
  cost.particles = state_->particles;
  cost.rays = state_->counting ? state_->rays : 0.0;
  cost.textureFetches = cost.densitySamples * fetchesPerSample(state_->scene, state_->grids.count()) +
                        cost.rays * (kFetchesPerRay + 3.0 * static_cast<double>(state_->scene.sheets.size()));
  return cost;
}

std::vector<MemoryRow> Renderer::memory(const View& view) const {
  const State& s = *state_;
  std::vector<MemoryRow> rows;
  const auto add = [&](const std::string& name, const gl::Texture& t) {
    if (t) rows.push_back({name, t.format().name, t.width(), t.height(), t.depth(), t.bytes()});
  };
  add("profile base noise", s.profileBase);
  add("profile detail noise", s.profileDetail);
  add("profile warp noise", s.profileWarp);
  add("nubis base shape", s.nubisBase);
  add("nubis detail", s.nubisDetail);
  add("curl", s.curl);
  const std::shared_ptr<Surroundings>& around = view.state_->around;
  if (around && around->weather) {
    add("weather", around->weather->main());
    add("weather extra", around->weather->extra());
    add("weather bounds", around->weather->bounds());
  }
  for (std::size_t i = 0; i < s.maps.size(); ++i) add(fmt::format("weather map {}", i), s.maps[i]);
  if (around && around->light)
    for (const auto& [name, texture] : around->light->textures()) add(name, *texture);
  for (const auto& [name, texture] : s.falling.textures()) add(name, *texture);
  add("grid index", s.grids.index());
  add("grid bricks", s.grids.bricks());
  add("no map", s.white);
  add("blue noise", s.blueNoise);
  add("sky transmittance", s.sky.transmittance());
  add("sky multiple scattering", s.sky.multiScattering());
  add("sky view", s.sky.skyView());
  add("aerial in-scatter", s.sky.aerialInscatter());
  add("aerial transmittance", s.sky.aerialTransmittance());
  add("view: march colour", view.state_->marched);
  add("view: march depth", view.state_->marchedDepth);
  add("view: samples", view.state_->samples);
  add("view: shade in the air", view.state_->airShade);
  add("view: rain along the rays", view.state_->rainSegments);
  add("view: history a", view.state_->history[0]);
  add("view: history b", view.state_->history[1]);
  return rows;
}

}  // namespace welkin::realtime
