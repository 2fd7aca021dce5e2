#include "apps/viewer/picture/sky_picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/tone.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/gl/state.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/governor.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::viewer {

namespace {

// Rounds of the interleave after which a picture at rest stays as it is.
constexpr int kRounds = 4;
// How far the governor may go down with the resolution of a moving picture.
constexpr float kLeastScale = 0.42f;
// Frames over which a level of light may come while nothing moves that could stutter.
constexpr int kLightFramesAtRest = 2;

constexpr const char* kShowText = R"(
#include "welkin/base/law.glsl"
#include "welkin/base/tone.glsl"
layout(std140) uniform Tone { ToneParameters uTone; };
uniform sampler2D uLight;
uniform sampler2D uReference;
uniform int uComparison;  // the order of Comparison, from 1
uniform float uWipe;
uniform sampler2D uSamples;
uniform float uMostSamples;
in vec2 vUv;
layout(location = 0) out vec4 oColour;
vec3 heat(float share) {
  vec3 low = mix(vec3(0.02, 0.02, 0.09), vec3(0.10, 0.32, 0.72), clamp(4.0 * share, 0.0, 1.0));
  vec3 mid = mix(low, vec3(0.18, 0.74, 0.42), clamp(4.0 * share - 1.0, 0.0, 1.0));
  vec3 high = mix(mid, vec3(0.98, 0.82, 0.20), clamp(4.0 * share - 2.0, 0.0, 1.0));
  return mix(high, vec3(0.85, 0.12, 0.08), clamp(4.0 * share - 3.0, 0.0, 1.0));
}
void main() {
  vec3 shown = toneMap(textureLod(uLight, vUv, 0.0).rgb, uTone);
#ifdef SAMPLES
  oColour = vec4(heat(textureLod(uSamples, vUv, 0.0).r / uMostSamples), 1.0);
  return;
#endif
#ifdef COMPARE  // a variant: the software driver runs all of a shader
  vec4 reference = textureLod(uReference, vUv, 0.0);
  vec3 traced = toneMap(reference.rgb, uTone);
  // What has not been traced yet stays dark.
  if (reference.a < 0.99) traced = 0.15 * shown;
  if (uComparison == 1) shown = vUv.x < uWipe ? shown : traced;
  if (uComparison == 2) shown = traced;
  if (uComparison == 3) shown = reference.a < 0.99 ? vec3(0.5) : vec3(0.5) + 4.0 * (shown - traced);
#endif
  // Half a step of noise against bands (J. Jimenez 2014, interleaved gradient noise).
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  oColour = vec4(shown + (noise - 0.5) / 255.0, 1.0);
}
)";

// Edges of things, which are drawn with one sample of a pixel: neighbours along the edge are mixed, across it nothing
// is, as far as the edge's slope can be told from the corners round a pixel (in the manner of T. Lottes 2009, FXAA).
constexpr const char* kSmoothText = R"(
uniform sampler2D uPicture;
in vec2 vUv;
layout(location = 0) out vec4 oColour;
const float kLeast = 0.06;  // difference of brightness that is an edge
const float kReach = 4.0;   // pixels along an edge
float brightness(vec3 c) { return dot(c, vec3(0.3, 0.6, 0.1)); }
vec3 at(vec2 pixels) { return textureLod(uPicture, vUv + pixels / vec2(textureSize(uPicture, 0)), 0.0).rgb; }
void main() {
  vec3 here = at(vec2(0.0));
  vec4 round_ = vec4(brightness(at(vec2(-0.5, -0.5))), brightness(at(vec2(0.5, -0.5))), brightness(at(vec2(-0.5, 0.5))),
                     brightness(at(vec2(0.5, 0.5))));
  float own = brightness(here);
  float least = min(min(min(round_.x, round_.y), min(round_.z, round_.w)), own);
  float most = max(max(max(round_.x, round_.y), max(round_.z, round_.w)), own);
  vec2 uphill = vec2(round_.y + round_.w - round_.x - round_.z, round_.z + round_.w - round_.x - round_.y);
  vec2 along = vec2(-uphill.y, uphill.x);
  // The flatter an edge lies, the longer are its steps.
  along = clamp(along / (min(abs(along.x), abs(along.y)) + 0.02), vec2(-kReach), vec2(kReach));
  vec3 near = 0.5 * (at(0.2 * along) + at(-0.2 * along)), wide = 0.5 * near + 0.25 * (at(0.5 * along) + at(-0.5 * along));
  float found = brightness(wide);
  vec3 smoothed = found < least || found > most ? near : wide;
  oColour = vec4(most - least < kLeast ? here : smoothed, 1.0);
}
)";

// A picture at another resolution.
constexpr const char* kStretchText = R"(
uniform sampler2D uPicture;
in vec2 vUv;
layout(location = 0) out vec4 oColour;
void main() { oColour = textureLod(uPicture, vUv, 0.0); }
)";

// A frame's counts of samples, one of a block, in the places of their pixels.
constexpr const char* kCountsText = R"(
uniform sampler2D uCounts;
uniform ivec4 uBlock;  // offset of the pixel in its block; edge of a block; 1: every pixel takes its block's count
in vec2 vUv;
layout(location = 0) out float oCount;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 block = pixel / uBlock.z;
  if (uBlock.w == 0 && pixel - block * uBlock.z != uBlock.xy) discard;
  oCount = texelFetch(uCounts, min(block, textureSize(uCounts, 0) - 1), 0).r;
}
)";

constexpr int kMeterWidth = 64, kMeterHeight = 36;
// The mean of 4 x 4 points of each cell.
constexpr const char* kMeterText = R"(
uniform sampler2D uLight;
uniform vec2 uStep;
in vec2 vUv;
layout(location = 0) out vec4 oLight;
void main() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 16; ++i)
    sum += textureLod(uLight, vUv + (vec2(float(i & 3), float(i >> 2)) - 1.5) * uStep, 0.0).rgb;
  oLight = vec4(sum / 16.0, 1.0);
}
)";

Image readTexture(const gl::Api& gl, gl::Framebuffer& framebuffer, const gl::Texture& texture) {
  const gl::Texture* targets[] = {&texture};
  framebuffer.target(targets);
  const int width = texture.width(), height = texture.height();
  std::vector<float> rgba(static_cast<std::size_t>(width) * height * 4);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
  gl.check("reading a picture back");
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::copy_n(rgba.data() + (static_cast<std::size_t>(height - 1 - y) * width + x) * 4, 3, image.at(x, y));
  return image;
}

// Frames until every pixel has been marched.
int turnsOf(const Quality& quality) {
  const int edge = quality.reprojection ? quality.interleave : 1;
  return edge * edge;
}

// A view with its target.
struct Canvas {
  gl::Texture light, depth;
  gl::Texture counts;  // of density samples, while they are counted
  gl::Framebuffer framebuffer, withDepth;
  GLint name = 0, depthName = 0;
  realtime::View view;
  int frames = 0;        // since it was begun anew
  bool complete = true;  // the last one's light

  // `goesOn`: what was seen is seen on, at another resolution.
  void fit(const gl::Api& gl, int width, int height, bool goesOn = false) {
    if (light && light.width() == width && light.height() == height) return;
    light = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba32F, width, height, 0, gl::Filter::linear,
                        gl::Addressing::clamp, nullptr);
    if (!name) framebuffer = gl::Framebuffer(gl);
    const gl::Texture* targets[] = {&light};
    framebuffer.target(targets);
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name);
    if (!goesOn) view.reset();
    frames = 0;
    depth = {};
  }

  // A foreground needs depth besides.
  void fitDepth(const gl::Api& gl) {
    if (depth) return;
    depth = gl::Texture(gl, gl::Texture::Kind::plane, gl::kDepth32FStencil8, light.width(), light.height(), 0,
                        gl::Filter::nearest, gl::Addressing::clamp, nullptr);
    if (!depthName) withDepth = gl::Framebuffer(gl);
    const gl::Texture* targets[] = {&light};
    withDepth.target(targets);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth.id(), 0);
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &depthName);
  }
};

}  // namespace

struct SkyPicture::State {
  gl::Api gl;
  realtime::Renderer renderer;
  gl::VertexArray triangle;
  gl::Program showProgram, meterProgram, countsProgram;
  mutable gl::Program compareProgram, samplesProgram, smoothProgram, stretchProgram;  // made when first needed
  bool counting = false;
  mutable gl::UniformBuffer tone;
  mutable gl::Framebuffer scratch;
  mutable gl::Texture toned, smoothed;  // of a canvas
  gl::Texture meter;
  Canvas moving, still;
  bool stillShown = false;
  bool waitsForLight = true;
  Quality wanted, current;  // the scene's; the renderer's
  double target = 0.0;      // s a frame while something moves; 0: ungoverned
  std::optional<realtime::Governor> governor;
  bool drewMoving = false;  // the last frame
  // What was drawn last.
  std::optional<Camera> camera;
  double time = 0.0;
  int width = 0, height = 0;
  bool changed = true;  // the scene, since the last frame
  std::string driver;
  Foreground* foreground = nullptr;
  bool clipsFromZero = false;  // clip space may reach from 0, which keeps reversed depth precise

  explicit State(const gl::Loader& loader)
      : gl(gl::loadApi(loader)), renderer(loader), triangle(gl),
        showProgram(gl, "show", "", kShowText, realtime::shaderSource),
        meterProgram(gl, "meter", "", kMeterText, realtime::shaderSource),
        countsProgram(gl, "counts", "", kCountsText, realtime::shaderSource), tone(gl), scratch(gl),
        meter(gl, gl::Texture::Kind::plane, gl::kRgba32F, kMeterWidth, kMeterHeight, 0, gl::Filter::nearest,
              gl::Addressing::clamp, nullptr) {
    driver = gl.driver();
    const bool has = gl.major * 10 + gl.minor >= 45 || gl.hasExtension("GL_ARB_clip_control");
    clipsFromZero = has && gl.ClipControl;
  }

  const Canvas& shown() const { return stillShown ? still : moving; }

  void makeGovernor() {
    governor.reset();
    if (target <= 0.0) return;
    governor.emplace(realtime::GovernorSettings{.target = target, .best = wanted, .leastScale = kLeastScale});
  }
  const Quality& movingQuality() const { return governor ? governor->quality() : wanted; }

  // The moving picture makes way after one round, so that every pixel has been marched, in light that is complete.
  bool movingEnough() const { return moving.frames >= turnsOf(movingQuality()) && moving.complete; }

  void use(const Quality& quality) {
    if (quality == current) return;
    renderer.setQuality(quality);
    current = quality;
  }

  void render(Canvas& canvas) {
    realtime::Frame frame = realtime::frameOf(*camera, canvas.light.width(), canvas.light.height());
    frame.framebuffer = static_cast<unsigned>(canvas.name);
    frame.time = time;
    frame.waitForLight = waitsForLight || &canvas == &still;
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    gl.Disable(GL_SCISSOR_TEST);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    if (foreground)
      renderWithForeground(canvas, frame);
    else
      renderer.render(canvas.view, frame);
    if (counting) gatherCounts(canvas);
    canvas.complete = renderer.outputs(canvas.view).complete;
    ++canvas.frames;
  }

  // Aims at a texture for display values, as large as the canvas that is shown.
  void toTexture(gl::Texture& texture) const {
    const gl::Texture& light = shown().light;
    if (!texture || texture.width() != light.width() || texture.height() != light.height())
      texture = gl::Texture(gl, gl::Texture::Kind::plane, gl::kRgba8, light.width(), light.height(), 0,
                            gl::Filter::linear, gl::Addressing::clamp, nullptr);
    const gl::Texture* const targets[] = {&texture};
    scratch.target(targets);
  }

  void tonePass(const Overlay& overlay, bool compares, bool counted) const {
    if (compares && !compareProgram.id())
      compareProgram = gl::Program(gl, "compare", "#define COMPARE\n", kShowText, realtime::shaderSource);
    if (counted && !samplesProgram.id())
      samplesProgram = gl::Program(gl, "samples", "#define SAMPLES\n", kShowText, realtime::shaderSource);
    const gl::Program& program = counted ? samplesProgram : compares ? compareProgram : showProgram;
    const auto bind = [&](const char* name, const gl::Texture& texture, int unit) {
      gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      gl.BindTexture(GL_TEXTURE_2D, texture.id());
      gl.Uniform1i(program.uniform(name), unit);
    };
    gl.UseProgram(program.id());
    program.bindBlock("Tone", 0);
    tone.bind(0);
    bind("uLight", shown().light, 0);
    if (compares) {
      bind("uReference", *overlay.reference, 1);
      gl.Uniform1i(program.uniform("uComparison"), static_cast<int>(overlay.comparison) + 1);
      gl.Uniform1f(program.uniform("uWipe"), overlay.wipe);
    }
    if (counted) {
      bind("uSamples", shown().counts, 2);
      gl.Uniform1f(program.uniform("uMostSamples"), overlay.mostSamples);
    }
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void picturePass(gl::Program& program, const char* name, const char* text, const gl::Texture& picture) const {
    if (!program.id()) program = gl::Program(gl, name, "", text, realtime::shaderSource);
    gl.UseProgram(program.id());
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, picture.id());
    gl.Uniform1i(program.uniform("uPicture"), 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void gatherCounts(Canvas& canvas) {
    const realtime::Outputs outputs = renderer.outputs(canvas.view);
    if (outputs.samples.name == 0) return;
    const int wide = outputs.clouds.width, high = outputs.clouds.height;
    const bool begins = !canvas.counts || canvas.counts.width() != wide || canvas.counts.height() != high;
    if (begins)
      canvas.counts = gl::Texture(gl, gl::Texture::Kind::plane, gl::kR32F, wide, high, 0, gl::Filter::nearest,
                                  gl::Addressing::clamp, nullptr);
    const gl::Texture* targets[] = {&canvas.counts};
    scratch.target(targets);
    gl.BindVertexArray(triangle.id());
    gl.UseProgram(countsProgram.id());
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, outputs.samples.name);
    gl.Uniform1i(countsProgram.uniform("uCounts"), 0);
    gl.Uniform4i(countsProgram.uniform("uBlock"), static_cast<int>(outputs.cloudDepthOffset.x),
                 static_cast<int>(outputs.cloudDepthOffset.y), current.reprojection ? current.interleave : 1,
                 begins || canvas.frames == 0 ? 1 : 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.check("gathering counts of samples");
  }

  void renderWithForeground(Canvas& canvas, realtime::Frame& frame) {
    canvas.fitDepth(gl);
    frame.background = realtime::Background::sky;
    frame.origin = glm::dvec2(frame.position);
    frame.position = {0.0, 0.0, frame.position.z};
    frame.velocity = foreground->velocity();
    if (!clipsFromZero) {
      // The viewport halves depths and adds a half.
      frame.projection[2][2] = 1.0f;
      frame.projection[3][2] *= 2.0f;
      frame.depthRange = realtime::DepthRange::minusOneToOne;
    }
    const Foreground::Bind bind = [&](unsigned program) {
      renderer.bindHost(canvas.view, program, {.firstUnit = 0, .uniformBlock = 0});
    };
    const auto begin = [&] {
      gl.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(canvas.depthName));
      gl.Viewport(0, 0, canvas.light.width(), canvas.light.height());
      if (clipsFromZero) gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
      gl.Enable(GL_DEPTH_TEST);
      gl.DepthFunc(GL_GREATER);
    };
    const auto end = [&] {
      gl.Disable(GL_DEPTH_TEST);
      gl.DepthFunc(GL_LESS);
      if (clipsFromZero) gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    };
    renderer.prepare(canvas.view, frame);
    begin();
    gl.DepthMask(GL_TRUE);
    gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, 0.0f, 0);
    foreground->drawSurfaces(frame, {static_cast<unsigned>(canvas.depthName), canvas.depth.id()}, bind);
    end();
    frame.depthTexture = canvas.depth.id();
    renderer.render(canvas.view, frame);
    begin();
    gl.DepthMask(GL_FALSE);
    gl.Enable(GL_BLEND);
    gl.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    gl.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    foreground->drawGlass(frame, bind);
    gl.Disable(GL_BLEND);
    end();
  }
};

SkyPicture::SkyPicture(const gl::Loader& loader) : state_(std::make_unique<State>(loader)) {}
SkyPicture::~SkyPicture() = default;

void SkyPicture::setScene(const Scene& scene, const realtime::CustomTextures& textures) {
  State& s = *state_;
  s.renderer.setScene(scene, textures);
  s.current = scene.quality;
  s.changed = true;
  if (s.wanted == scene.quality) return;
  s.wanted = scene.quality;
  s.makeGovernor();
}

void SkyPicture::setForeground(Foreground* foreground) {
  state_->foreground = foreground;
  state_->changed = true;
}

void SkyPicture::cut() {
  state_->moving.view.reset();
  state_->changed = true;
  if (state_->governor) state_->governor->cut();
}

void SkyPicture::waitForLight(bool on) { state_->waitsForLight = on; }

void SkyPicture::govern(double seconds) {
  state_->target = seconds;
  state_->makeGovernor();
}

void SkyPicture::took(double seconds) {
  if (state_->governor && state_->drewMoving) state_->governor->take(seconds);
}

bool SkyPicture::draw(const Camera& camera, double time, int width, int height, float scale) {
  State& s = *state_;
  width = std::clamp(width, 1, 8192);
  height = std::clamp(height, 1, 8192);
  if (s.governor) scale *= s.governor->scale();
  const auto scaled = [&](int edge) {
    return std::max(static_cast<int>(std::lround(scale * static_cast<float>(edge))), std::min(edge, 16));
  };
  const bool sameWindow = s.width == width && s.height == height;
  const bool moves = s.changed || !s.camera || !sameFields(*s.camera, camera) || s.time != time || !sameWindow;
  s.changed = s.drewMoving = false;
  s.camera = camera;
  s.time = time;
  s.width = width;
  s.height = height;
  const gl::StateGuard guard(s.gl);
  if (moves) {
    s.stillShown = false;
    s.still.frames = 0;
    s.moving.fit(s.gl, scaled(width), scaled(height), sameWindow);
    s.moving.frames = 0;
  }
  if (!s.movingEnough()) {
    Quality quality = s.movingQuality();
    if (!moves) quality.lightFrames = std::min(quality.lightFrames, kLightFramesAtRest);
    s.use(quality);
    const bool lightAlone = !moves && !s.moving.complete;
    s.render(s.moving);
    s.drewMoving = !lightAlone;
    return true;
  }
  if (settled()) return false;
  // A view that has seen nothing: what a picture at rest looks like does not depend on what came before.
  s.use(s.wanted);
  s.still.fit(s.gl, width, height);
  if (s.still.frames == 0) s.still.view.reset();
  s.render(s.still);
  s.stillShown = s.still.frames >= turnsOf(s.wanted);
  return true;
}

bool SkyPicture::settled() const {
  const State& s = *state_;
  if (s.changed || !s.moving.light || !s.movingEnough()) return false;
  return s.still.frames >= kRounds * turnsOf(s.wanted);
}

void SkyPicture::show(unsigned framebuffer, const Region& region, const Film& film, const Overlay& overlay) const {
  const State& s = *state_;
  const law::ToneParameters tone = toneParameters({.ev = film.ev - film.compensation,
                                                   .whiteBalance = film.whiteBalance,
                                                   .saturation = film.saturation,
                                                   .curve = film.tone});
  const gl::StateGuard guard(s.gl);
  s.tone.upload(&tone, sizeof tone);
  s.gl.BindVertexArray(s.triangle.id());
  const gl::Texture& light = s.shown().light;
  const bool compares = overlay.reference && *overlay.reference;
  const bool counted = overlay.mostSamples > 0.0f && s.counting && s.shown().counts;
  const bool stretched = light.width() != region.width || light.height() != region.height;
  const auto toWindow = [&] {
    s.gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    s.gl.Viewport(region.x, region.y, region.width, region.height);
  };
  // What is drawn coarsely is toned where it is coarse: that costs less, and edges stay as soft as the filter has them.
  if (compares || counted || (!stretched && !s.foreground)) {
    toWindow();
    s.tonePass(overlay, compares, counted);
  } else {
    s.toTexture(s.toned);
    s.tonePass(overlay, false, false);
    const gl::Texture* picture = &s.toned;
    if (s.foreground) {
      if (stretched)
        s.toTexture(s.smoothed);
      else
        toWindow();
      s.picturePass(s.smoothProgram, "smooth", kSmoothText, *picture);
      picture = &s.smoothed;
    }
    if (stretched) {
      toWindow();
      s.picturePass(s.stretchProgram, "stretch", kStretchText, *picture);
    }
  }
  s.gl.check("showing the picture");
}

Image SkyPicture::meter() const {
  const State& s = *state_;
  const gl::StateGuard guard(s.gl);
  const gl::Texture* targets[] = {&s.meter};
  s.scratch.target(targets);
  s.gl.BindVertexArray(s.triangle.id());
  s.gl.UseProgram(s.meterProgram.id());
  s.gl.ActiveTexture(GL_TEXTURE0);
  s.gl.BindTexture(GL_TEXTURE_2D, s.shown().light.id());
  s.gl.Uniform1i(s.meterProgram.uniform("uLight"), 0);
  s.gl.Uniform2f(s.meterProgram.uniform("uStep"), 0.25f / kMeterWidth, 0.25f / kMeterHeight);
  s.gl.DrawArrays(GL_TRIANGLES, 0, 3);
  return readTexture(s.gl, s.scratch, s.meter);
}

Image SkyPicture::read() const {
  const State& s = *state_;
  const gl::StateGuard guard(s.gl);
  return readTexture(s.gl, s.scratch, s.shown().light);
}

const Quality& SkyPicture::quality() const { return state_->current; }
int SkyPicture::width() const { return state_->shown().light.width(); }
int SkyPicture::height() const { return state_->shown().light.height(); }
realtime::FrameCost SkyPicture::cost() const { return state_->renderer.lastCost(); }
void SkyPicture::countSamples(bool on) {
  state_->renderer.countSamples(on);
  state_->counting = on;
  state_->changed = true;
}
std::vector<realtime::MemoryRow> SkyPicture::memory() const { return state_->renderer.memory(state_->shown().view); }
const std::string& SkyPicture::driver() const { return state_->driver; }
bool SkyPicture::softwareDriver() const { return state_->gl.software(); }

}  // namespace welkin::viewer
