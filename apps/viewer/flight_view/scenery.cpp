#include "apps/viewer/flight_view/scenery.hpp"

#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <string>

#include "apps/viewer/flight_view/buffer_offset.hpp"
#include "apps/viewer/flight_view/land_shader.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::viewer {

namespace {

constexpr int kUnits = 9;  // that the include takes, from 0

constexpr const char* kLawText = R"(
#include "welkin/base/law.glsl"
#include "welkin/noise/hash.glsl"
#include "welkin/noise/lattice.glsl"
#include "welkin/noise/perlin.glsl"
)";

// Light and air at one place: what a model near it is lit by throughout. Its small triangles would ask for it again and
// again, as the software driver shades blocks of pixels for each.
constexpr const char* kPlaceFragment = R"(
uniform vec3 uPlace;  // from the eye
out vec4 oLight;
void main() {
  WelkinLight light = welkinLight(uPlace);
  WelkinFront air = welkinAir(uPlace);
  int at = int(gl_FragCoord.x);
  oLight = vec4(at == 0 ? light.toSun : at == 1 ? light.sun : at == 2 ? light.sky : at == 3 ? air.through : air.light, 1.0);
}
)";
constexpr int kPlaceTexels = 5;

// Numbers of Part: 0 fuselage, 1 wing, 2 tail, 3 fin, 4 dark, 5 wheel, 6 spinner, 7 wall, 8 roof.
constexpr const char* kModelVertex = R"(
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in float aPart;
uniform mat3 uWorldFromModel;
uniform vec3 uOrigin;  // from the eye
uniform mat4 uClipFromEye;
uniform vec4 uSurfaces;  // elevator, aileron, rudder, flaps: slopes
out vec3 vFromEye, vNormal, vModel;
flat out int vPart;
void main() {
  vModel = aPosition;
  vPart = int(aPart + 0.5);
  vec3 at = aPosition;
  // Trailing edges swing about their hinges.
  if (vPart == 1 && at.x < -0.42) {
    bool outer = abs(at.y) > 3.21;
    float slope = outer ? -sign(at.y) * uSurfaces.y : (abs(at.y) > 0.6 ? uSurfaces.w : 0.0);
    at.z += slope * (-0.42 - at.x);
  }
  if (vPart == 2 && at.x < -4.8) at.z -= uSurfaces.x * (-4.8 - at.x);
  if (vPart == 3 && at.x < -4.95) at.y -= uSurfaces.z * (-4.95 - at.x);
  vFromEye = uOrigin + uWorldFromModel * at;
  vNormal = uWorldFromModel * aNormal;
  gl_Position = uClipFromEye * vec4(vFromEye, 1.0);
}
)";

constexpr const char* kModelFragment = R"(
in vec3 vFromEye, vNormal, vModel;
flat in int vPart;
uniform highp sampler2D uLight;  // kPlaceFragment's
uniform float uExposure;
uniform float uInside;  // 1: the eye is in the cabin
uniform vec3 uToGround;  // light that the ground sends up, as a share of what falls on it
out vec4 oColour;
// Share of a pixel that a line covers: `off` its middle, half as wide as `half_`, all in m.
float lineOver(float off, float half_) {
  float pixel = fwidth(off) + 1e-4;
  return clamp((half_ - abs(off)) / pixel + 0.5, 0.0, 1.0) * min(2.0 * half_ / pixel, 1.0);
}
// Albedo and gloss.
vec4 paintOf(vec3 m) {
  vec3 white = vec3(0.62, 0.63, 0.64), red = vec3(0.42, 0.035, 0.03), dark = vec3(0.03, 0.032, 0.036);
  if (vPart == 7) return vec4(vec3(0.36, 0.35, 0.33) * (0.85 + 0.15 * step(0.5, fract(m.x * 0.5))), 0.0);
  if (vPart == 8) return vec4(0.2, 0.17, 0.16, 0.0);
  if (vPart == 5) return vec4(0.025, 0.025, 0.026, 0.1);
  if (vPart == 4) return vec4(0.5, 0.5, 0.5, 0.5);
  if (vPart == 6) return vec4(red, 1.0);
  if (vPart == 1) {
    float tip = smoothstep(4.45, 4.5, abs(m.y)) * smoothstep(5.3, 5.25, abs(m.y));
    return vec4(mix(mix(white, red, tip), dark, 0.6 * lineOver(m.x + 0.42, 0.016)), 0.8);
  }
  if (vPart == 2) return vec4(mix(white, dark, 0.6 * lineOver(m.x + 4.8, 0.016)), 0.8);
  if (vPart == 3) return vec4(mix(white, red, smoothstep(-1.2, -1.25, m.z) * smoothstep(-1.75, -1.7, m.z)), 0.8);
  // Glass: windscreen, side and rear windows; stripe along the side.
  float stripe = lineOver(m.z + 0.02 + 0.03 * m.x, 0.04) + lineOver(m.z - 0.1 + 0.03 * m.x, 0.018);
  vec3 colour = mix(white, red, clamp(stripe, 0.0, 1.0));
  float low = m.x > 0.45 ? -0.36 : -0.34;
  float pane = smoothstep(low, low - 0.02, m.z) * smoothstep(-0.88, -0.86, m.z) * step(m.x, 0.97) * step(-1.75, m.x);
  float posts = smoothstep(0.05, 0.03, abs(m.x - 0.4)) + smoothstep(0.05, 0.03, abs(m.x + 0.62));
  bool front = m.x > 0.42;
  pane *= 1.0 - clamp(posts, 0.0, 1.0);
  if (front) pane = smoothstep(-0.4, -0.42, m.z) * smoothstep(0.97, 0.95, m.x) * smoothstep(-0.97, -0.95, m.z);
  return vec4(mix(colour, vec3(0.012, 0.016, 0.02), pane), mix(0.8, 1.6, pane));
}
void main() {
  if (uInside > 0.5 && vPart == 0 && vModel.x < 0.93) discard;
  vec3 toEye = normalize(-vFromEye);
  vec3 normal = normalize(vNormal);
  vec4 paint = paintOf(vModel);
  vec3 toSun = texelFetch(uLight, ivec2(0), 0).xyz, sun = texelFetch(uLight, ivec2(1, 0), 0).xyz;
  vec3 sky = texelFetch(uLight, ivec2(2, 0), 0).xyz;
  float up = 0.5 + 0.5 * normal.z;
  vec3 below = uToGround * (sun * max(toSun.z, 0.0) + sky);
  vec3 irradiance = sun * max(dot(normal, toSun), 0.0) + sky * up + below * (1.0 - up);
  vec3 radiance = paint.rgb * irradiance / 3.14159265;
  // Lacquer: what it mirrors of sky and ground, and the sun's highlight.
  vec3 mirrored = reflect(-toEye, normal);
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(normal, toEye), 0.0), 5.0);
  vec3 around = mix(below, sky, smoothstep(-0.15, 0.15, mirrored.z)) / 3.14159265;
  float shine = pow(max(dot(mirrored, toSun), 0.0), 180.0) * 29.0;
  radiance += min(paint.a, 1.0) * fresnel * around * max(paint.a, 1.0);
  radiance += min(paint.a, 1.0) * fresnel * sun * shine;
  vec3 through = texelFetch(uLight, ivec2(3, 0), 0).xyz, air = texelFetch(uLight, ivec2(4, 0), 0).xyz;
  oColour = vec4(radiance * uExposure * through + air, 1.0);
}
)";

constexpr const char* kPropellerVertex = R"(
uniform mat3 uWorldFromModel;
uniform vec3 uOrigin;
uniform mat4 uClipFromEye;
out vec3 vFromEye;
out vec2 vDisc;
void main() {
  vDisc = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vFromEye = uOrigin + uWorldFromModel * vec3(2.5, vDisc.x, 0.1 + vDisc.y);
  gl_Position = uClipFromEye * vec4(vFromEye, 1.0);
}
)";

constexpr const char* kPropellerFragment = R"(
in vec3 vFromEye;
in vec2 vDisc;
uniform float uExposure;
uniform float uAngle;
out vec4 oColour;
void main() {
  float r = length(vDisc);
  if (r > 1.0 || r < 0.16) discard;
  // Three blades, smeared by their turning.
  float near = 0.5 + 0.5 * cos(3.0 * (atan(vDisc.y, vDisc.x) - uAngle));
  float alpha = (0.03 + 0.16 * near * near * near) * smoothstep(1.0, 0.9, r);
  vec3 paint = mix(vec3(0.05), vec3(0.6, 0.5, 0.1), smoothstep(0.86, 0.9, r));
  WelkinLight light = welkinLight(vFromEye);
  vec3 radiance = paint * (0.5 * light.sun + light.sky) / 3.14159265;
  oColour = welkinThrough(vec4(radiance * uExposure, 1.0) * alpha, vFromEye);
}
)";

gl::Program makeProgram(const gl::Api& gl, const char* name, const std::string& law, const char* fragment,
                        const char* vertex) {
  return {gl, name, "", realtime::Renderer::hostShader() + law + fragment, realtime::shaderSource, vertex};
}

glm::mat4 clipFromEye(const realtime::Frame& frame) { return frame.projection * frame.view; }

void setMatrix(const gl::Api& gl, const gl::Program& program, const char* name, const glm::mat3& matrix) {
  gl.UniformMatrix3fv(program.uniform(name), 1, GL_FALSE, glm::value_ptr(matrix));
}
void setMatrix(const gl::Api& gl, const gl::Program& program, const char* name, const glm::mat4& matrix) {
  gl.UniformMatrix4fv(program.uniform(name), 1, GL_FALSE, glm::value_ptr(matrix));
}
void setVector(const gl::Api& gl, const gl::Program& program, const char* name, const glm::vec3& v) {
  gl.Uniform3f(program.uniform(name), v.x, v.y, v.z);
}

// Where the eye stands in the land.
glm::dvec3 eyeOf(const realtime::Frame& frame) { return {frame.origin, frame.position.z}; }

}  // namespace

ModelBuffer::ModelBuffer(const gl::Api& gl, const ModelMesh& mesh)
    : gl_(gl), count_(static_cast<GLsizei>(mesh.indices.size())) {
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.GenBuffers(2, buffers_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(ModelVertex)),
                mesh.vertices.data(), GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                mesh.indices.data(), GL_STATIC_DRAW);
  const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(ModelVertex), bufferOffset(offset));
  };
  attribute(0, 3, offsetof(ModelVertex, position));
  attribute(1, 3, offsetof(ModelVertex, normal));
  attribute(2, 1, offsetof(ModelVertex, part));
  gl.BindVertexArray(0);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

ModelBuffer::~ModelBuffer() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(2, buffers_);
}

void ModelBuffer::draw() const {
  gl_.BindVertexArray(array_);
  gl_.DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

Scenery::Scenery(const gl::Api& gl, const Flight& flight)
    : gl_(gl), flight_(flight), shape_(gl, "land's shape", "", kShapeFragment, realtime::shaderSource, kShapeVertex),
      place_(makeProgram(gl, "place", "", kPlaceFragment, "")),
      model_(gl, "model", "", kModelFragment, realtime::shaderSource, kModelVertex),
      propeller_(makeProgram(gl, "propeller", "", kPropellerFragment, kPropellerVertex)),
      mesh_(gl, flight.terrain(), flight.aircraft().position), aircraft_(gl, aircraftMesh()),
      airfield_(gl, airfieldMesh()), light_(gl, gl::Texture::Kind::plane, gl::kRgba32F, kPlaceTexels, 1, 0,
                                            gl::Filter::nearest, gl::Addressing::clamp, nullptr),
      none_(gl), shapes_(gl), lights_(gl) {}

void Scenery::drawSurfaces(const realtime::Frame& frame, const Target& target, const Bind& bind) {
  drawLand(frame, target, bind);
  drawModels(frame, target, bind);
  gl_.check("drawing the land");
}

const gl::Program& Scenery::landProgram(LandKind kind) {
  constexpr const char* kDefines[kLandKinds] = {"#define LAND\n", "#define SEA\n", "#define LAND\n#define SEA\n",
                                                "#define LAND\n#define CLOSE\n",
                                                "#define LAND\n#define SEA\n#define CLOSE\n"};
  gl::Program& land = land_[static_cast<std::size_t>(kind)][rains_ ? 1 : 0];
  if (!land.id())
    land = gl::Program(
        gl_, "land", std::string(kDefines[static_cast<std::size_t>(kind)]) + (rains_ ? "#define RAIN\n" : ""),
        realtime::Renderer::hostShader() + kLawText + kLandFragment, realtime::shaderSource, kLandVertex);
  return land;
}

// Depth of the land, which kind of it each pixel shows (stencil), and how far it is.
void Scenery::drawShape(const realtime::Frame& frame, const Target& target, const LandMesh::Blocks& blocks) {
  if (!along_ || along_.width() != frame.width || along_.height() != frame.height)
    along_ = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kR32F, frame.width, frame.height, 0, gl::Filter::nearest,
                         gl::Addressing::clamp, nullptr);
  const gl::Texture* const targets[] = {&along_};
  shapes_.target(targets);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, target.depth, 0);
  gl_.UseProgram(shape_.id());
  setMatrix(gl_, shape_, "uClipFromEye", clipFromEye(frame));
  const glm::dvec3 eye = eyeOf(frame);
  gl_.Uniform1f(shape_.uniform("uEyeHeight"), static_cast<float>(eye.z));
  gl_.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  for (int kind = 0; kind < kLandKinds; ++kind) {
    gl_.StencilFunc(GL_ALWAYS, kind + 1, 0xff);
    mesh_.draw(shape_, eye, blocks[static_cast<std::size_t>(kind)], 0);
  }
}

void Scenery::drawLand(const realtime::Frame& frame, const Target& target, const Bind& bind) {
  const glm::dvec3 eye = eyeOf(frame);
  mesh_.update(eye, frame.width);
  const Aircraft& aircraft = flight_.aircraft();
  const LandMesh::Blocks blocks = mesh_.inSight(eye, clipFromEye(frame), aircraft.position);
  gl_.Enable(GL_STENCIL_TEST);
  drawShape(frame, target, blocks);

  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  gl_.BindVertexArray(none_.id());
  const glm::mat3 worldFromEye = glm::transpose(glm::mat3(frame.view));
  const float x = 1.0f / frame.projection[0][0], y = 1.0f / frame.projection[1][1];
  for (int kind = 0; kind < kLandKinds; ++kind) {
    if (blocks[static_cast<std::size_t>(kind)].empty()) continue;
    const gl::Program& land = landProgram(static_cast<LandKind>(kind));
    gl_.UseProgram(land.id());
    bind(land.id());
    mesh_.bind(land, eye, kUnits);
    gl_.ActiveTexture(GL_TEXTURE0 + kUnits + 1);
    gl_.BindTexture(GL_TEXTURE_2D, along_.id());
    gl_.Uniform1i(land.uniform("uAlong"), kUnits + 1);
    setVector(gl_, land, "uForward",
              worldFromEye * glm::vec3(frame.projection[2][0] * x, frame.projection[2][1] * y, -1.0f));
    setVector(gl_, land, "uRight", worldFromEye * glm::vec3(x, 0.0f, 0.0f));
    setVector(gl_, land, "uAbove", worldFromEye * glm::vec3(0.0f, y, 0.0f));
    gl_.Uniform2f(land.uniform("uEyePlace"), static_cast<float>(eye.x), static_cast<float>(eye.y));
    gl_.Uniform1f(land.uniform("uPixel"), 2.0f * x / static_cast<float>(frame.width));
    gl_.Uniform1f(land.uniform("uExposure"), frame.preExposure);
    gl_.Uniform1f(land.uniform("uTime"), static_cast<float>(std::fmod(frame.time, 3600.0)));
    const Runway& runway = flight_.terrain().runway();
    gl_.Uniform4f(land.uniform("uRunway"), static_cast<float>(std::sin(runway.heading)),
                  static_cast<float>(std::cos(runway.heading)), static_cast<float>(0.5 * runway.length),
                  static_cast<float>(0.5 * runway.width));
    const glm::vec3 wind(meanWind(wind_, 10.0));
    gl_.Uniform2f(land.uniform("uWind"), wind.x, wind.y);
    setMatrix(gl_, land, "uBodyFromWorld", glm::mat3(glm::transpose(glm::mat3_cast(aircraft.attitude))));
    setVector(gl_, land, "uAircraft", glm::vec3(aircraft.position - eye));
    gl_.StencilFunc(GL_EQUAL, kind + 1, 0xff);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.Disable(GL_STENCIL_TEST);
  gl_.Enable(GL_DEPTH_TEST);
}

// A model that stands at `origin`, from the eye, its axes turned by `worldFromModel`.
void Scenery::drawModel(const ModelBuffer& model, const glm::vec3& origin, const glm::mat3& worldFromModel,
                        const realtime::Frame& frame, const Target& target, const Bind& bind) {
  const gl::Texture* const targets[] = {&light_};
  lights_.target(targets);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.UseProgram(place_.id());
  bind(place_.id());
  setVector(gl_, place_, "uPlace", origin);
  gl_.BindVertexArray(none_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_.Viewport(0, 0, frame.width, frame.height);

  gl_.UseProgram(model_.id());
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, light_.id());
  gl_.Uniform1i(model_.uniform("uLight"), 0);
  setMatrix(gl_, model_, "uWorldFromModel", worldFromModel);
  setVector(gl_, model_, "uOrigin", origin);
  model.draw();
}

void Scenery::drawModels(const realtime::Frame& frame, const Target& target, const Bind& bind) {
  const glm::dvec3 eye = eyeOf(frame);
  const Aircraft& aircraft = flight_.aircraft();
  gl_.UseProgram(model_.id());
  setMatrix(gl_, model_, "uClipFromEye", clipFromEye(frame));
  gl_.Uniform1f(model_.uniform("uExposure"), frame.preExposure);
  setVector(gl_, model_, "uToGround", glm::vec3(0.1f, 0.11f, 0.07f));
  const Deflections& d = aircraft.surfaces;
  gl_.Uniform4f(model_.uniform("uSurfaces"), static_cast<float>(d.elevator), static_cast<float>(d.aileron),
                static_cast<float>(d.rudder), static_cast<float>(0.5 * aircraft.flaps));
  gl_.Uniform1f(model_.uniform("uInside"), flight_.pilot.view() == FlightView::cockpit ? 1.0f : 0.0f);
  drawModel(aircraft_, glm::vec3(aircraft.position - eye), glm::mat3(glm::mat3_cast(aircraft.attitude)), frame, target,
            bind);

  const Runway& runway = flight_.terrain().runway();
  const glm::dvec3 there = glm::dvec3(0.0, 0.0, runway.elevation) - eye;
  if (std::hypot(there.x, there.y) > 15000.0) return;  // less than a pixel
  const auto s = static_cast<float>(std::sin(runway.heading)), c = static_cast<float>(std::cos(runway.heading));
  drawModel(airfield_, glm::vec3(there), glm::mat3(glm::vec3(s, c, 0), glm::vec3(c, -s, 0), glm::vec3(0, 0, 1)), frame,
            target, bind);
}

void Scenery::drawGlass(const realtime::Frame& frame, const Bind& bind) {
  const Aircraft& aircraft = flight_.aircraft();
  gl_.UseProgram(propeller_.id());
  bind(propeller_.id());
  setMatrix(gl_, propeller_, "uClipFromEye", clipFromEye(frame));
  setMatrix(gl_, propeller_, "uWorldFromModel", glm::mat3(glm::mat3_cast(aircraft.attitude)));
  setVector(gl_, propeller_, "uOrigin", glm::vec3(aircraft.position - eyeOf(frame)));
  gl_.Uniform1f(propeller_.uniform("uExposure"), frame.preExposure);
  gl_.Uniform1f(propeller_.uniform("uAngle"), static_cast<float>(aircraft.propeller));
  gl_.BindVertexArray(none_.id());
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_.check("drawing the propeller");
}

}  // namespace welkin::viewer
