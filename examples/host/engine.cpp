#include "engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace host {

namespace {

constexpr double kPi = 3.14159265358979;
constexpr float kNear = 0.5f;  // m
constexpr int kSides = 48;     // of the glass disc

double unitOf(int x, int y) {
  auto h = static_cast<std::uint32_t>(x) * 0x8DA6B343u ^ static_cast<std::uint32_t>(y) * 0xD8163841u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}
double valueNoise(double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double u = fade(x - fx), v = fade(y - fy);
  const double low = unitOf(i, j) + u * (unitOf(i + 1, j) - unitOf(i, j));
  const double high = unitOf(i, j + 1) + u * (unitOf(i + 1, j + 1) - unitOf(i, j + 1));
  return low + v * (high - low);
}

const char* const kVertex = R"(#version 330
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
uniform vec3 uEye;
uniform mat4 uClipFromEye;
out vec3 vFromEye, vNormal, vPlace;
void main() {
  vPlace = aPosition;
  vNormal = aNormal;
  vFromEye = aPosition - uEye;
  vFromEye.y -= dot(aPosition.xz, aPosition.xz) / 12720000.0;  // the earth is round
  gl_Position = uClipFromEye * vec4(vFromEye, 1.0);
}
)";

// What follows calls, of the include: welkinLight, welkinAir, welkinThrough.
const char* const kLand = R"(
in vec3 vFromEye, vNormal, vPlace;
uniform float uExposure;
out vec4 oColour;
float unitOf(vec2 p) { return fract(52.98 * fract(dot(p, vec2(0.0671, 0.0583)))); }
vec3 albedoOf(vec3 place, vec3 normal) {
  vec2 cell = floor(vec2(dot(place.xz, vec2(0.8, 0.6)) / 300.0, dot(place.xz, vec2(-0.6, 0.8)) / 170.0));
  vec3 field = mix(vec3(0.07, 0.11, 0.035), vec3(0.24, 0.2, 0.09), unitOf(cell) * unitOf(cell + 7.0));
  vec3 wood = vec3(0.03, 0.05, 0.02), rock = vec3(0.16, 0.15, 0.14);
  vec3 land = mix(field, wood, smoothstep(60.0, 160.0, place.y + 90.0 * unitOf(cell + 3.0)));
  land = mix(land, rock, smoothstep(0.9, 0.75, normal.y));
  return mix(vec3(0.02, 0.035, 0.045), land, smoothstep(0.0, 4.0, place.y));
}
void main() {
  vec3 normal = normalize(vNormal);
  WelkinLight light = welkinLight(vFromEye);
  vec3 irradiance = light.sun * max(dot(normal, light.toSun), 0.0) + light.sky * (0.5 + 0.5 * normal.y);
  vec3 radiance = albedoOf(vPlace, normal) * irradiance * (uExposure / 3.14159265);
  WelkinFront air = welkinAir(vFromEye);
  oColour = vec4(radiance * air.through + air.light, 1.0);
}
)";

const char* const kGlass = R"(
in vec3 vFromEye, vNormal, vPlace;
uniform float uExposure;
out vec4 oColour;
// Lines at whole numbers of x, as wide as two pixels and no less than a hundredth.
float line(float x) {
  float width = max(fwidth(x), 0.01);
  return 1.0 - smoothstep(0.5 * width, 1.5 * width, abs(fract(x - 0.5) - 0.5));
}
void main() {
  float away = length(vPlace.xz) / 1000.0;
  float lines = max(line(away), line(atan(vPlace.z, vPlace.x) * 12.0 / 3.14159265));
  float alpha = mix(0.13, 0.85, lines);
  WelkinLight light = welkinLight(vFromEye);
  vec3 lit = (light.sun * max(light.toSun.y, 0.0) + light.sky) * (uExposure / 3.14159265);
  vec3 colour = mix(vec3(0.2, 0.65, 0.7), vec3(1.0, 0.5, 0.12), lines) * lit;
  oColour = welkinThrough(vec4(colour * alpha, alpha), vFromEye);
}
)";

// A round land whose triangles grow with distance from the middle.
void makeLand(std::vector<float>& vertices, std::vector<std::uint32_t>& indices) {
  constexpr int kRings = 460, kSpokes = 900;
  const auto radius = [](int ring) { return 25.0 * (std::pow(1.019, ring) - 1.0) * 30.0; };
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double turn = 2.0 * kPi * spoke / kSpokes, r = radius(ring);
      const double x = r * std::cos(turn), z = r * std::sin(turn), step = std::max(0.008 * r, 15.0);
      const double slopeX = (landHeight(x + step, z) - landHeight(x - step, z)) / (2.0 * step);
      const double slopeZ = (landHeight(x, z + step) - landHeight(x, z - step)) / (2.0 * step);
      for (const double v : {x, landHeight(x, z), z, -slopeX, 1.0, -slopeZ}) vertices.push_back(static_cast<float>(v));
      const auto at = static_cast<std::uint32_t>(ring * kSpokes + spoke);
      const auto next = static_cast<std::uint32_t>(ring * kSpokes + (spoke + 1) % kSpokes);
      if (ring + 1 < kRings)
        indices.insert(indices.end(), {at, next, at + kSpokes, next, next + kSpokes, at + kSpokes});
    }
}

// A fan of triangles; its grid is drawn by the shader.
std::vector<float> glassDisc() {
  constexpr double kHeight = 1700.0, kRadius = 6000.0;
  std::vector<float> vertices;
  for (int i = 0; i < kSides; ++i)
    for (const int corner : {-1, i, i + 1}) {
      const double turn = 2.0 * kPi * corner / kSides, r = corner < 0 ? 0.0 : kRadius;
      for (const double v : {r * std::cos(turn), kHeight, r * std::sin(turn), 0.0, 1.0, 0.0})
        vertices.push_back(static_cast<float>(v));
    }
  return vertices;
}

GLuint upload(const Gl& gl, const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices) {
  GLuint array = 0, buffers[2] = {};
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  gl.GenBuffers(2, buffers);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                indices.data(), GL_STATIC_DRAW);
  for (GLuint i = 0; i < 2; ++i) {
    gl.EnableVertexAttribArray(i);
    gl.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float),
                           reinterpret_cast<const void*>(i * 3 * sizeof(float)));
  }
  gl.BindVertexArray(0);
  return array;
}

GLuint texture(const Gl& gl, GLint internal, GLenum format, int width, int height) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT, nullptr);
  for (const GLenum p : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) gl.TexParameteri(GL_TEXTURE_2D, p, GL_NEAREST);
  for (const GLenum p : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) gl.TexParameteri(GL_TEXTURE_2D, p, GL_CLAMP_TO_EDGE);
  return name;
}

}  // namespace

double landHeight(double x, double z) {
  double ridges = 0.0, weight = 0.5;
  for (double size = 9000.0; size > 150.0; size *= 0.48, weight *= 0.5)
    ridges += weight * (1.0 - std::abs(2.0 * valueNoise(x / size, z / size) - 1.0));
  const double rise = 50.0 * std::exp(-(x * x + z * z) / 1.6e7);  // under the tower
  const double plain = 110.0 * valueNoise(x / 2600.0 + 3.4, z / 2600.0 + 0.6) - 30.0 + rise;
  // Mountains stand in a wide arc; the tower stands in the plain.
  const double mountains = std::clamp((std::hypot(x, z + 2000.0) - 5000.0) / 9000.0, 0.0, 1.0);
  const double h =
      plain + mountains * 2300.0 * std::max(ridges - 0.45, 0.0) * valueNoise(x / 14000.0, z / 14000.0 + 5.0);
  return std::max(h, 0.0);
}

glm::mat4 Eye::view() const {
  const double ch = std::cos(heading), sh = std::sin(heading), cp = std::cos(pitch), sp = std::sin(pitch);
  const glm::vec3 forward(sh * cp, sp, -ch * cp), right(ch, 0.0, sh), above(-sh * sp, cp, ch * sp);
  return glm::mat4(glm::transpose(glm::mat3(right, above, -forward)));
}

Target::Target(const Gl& gl, int w, int h) : width(w), height(h) {
  colour = texture(gl, GL_RGBA16F, GL_RGBA, w, h);
  depth = texture(gl, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, w, h);
  gl.GenFramebuffers(1, &all);
  gl.GenFramebuffers(1, &colourOnly);
  for (const GLuint framebuffer : {all, colourOnly}) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    if (framebuffer == all) gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("no float framebuffer");
  }
}

Engine::Engine(const Gl& gl, const std::string& include)
    : gl_(gl), land_(makeProgram(gl, kVertex, "#version 330\n" + include + kLand)),
      glass_(makeProgram(gl, kVertex, "#version 330\n" + include + kGlass)) {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  makeLand(vertices, indices);
  vertices_ = upload(gl, vertices, indices);
  indices_ = static_cast<GLsizei>(indices.size());
  glassVertices_ = upload(gl, glassDisc(), {});
  if (gl.ClipControl) gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

// Depth is near / distance; where clip space reaches from -1, the same after the viewport's (z + 1) / 2.
glm::mat4 Engine::projection(const Eye& eye, const Target& target) const {
  glm::mat4 p(0.0f);
  p[0][0] = static_cast<float>(1.0 / std::tan(0.5 * eye.fov));
  p[1][1] = p[0][0] * static_cast<float>(target.width) / static_cast<float>(target.height);
  p[2][3] = -1.0f;
  p[2][2] = zeroToOne() ? 0.0f : 1.0f;
  p[3][2] = zeroToOne() ? kNear : 2.0f * kNear;
  return p;
}

void Engine::use(GLuint program, const Eye& eye, const Target& target) {
  gl_.UseProgram(program);
  const glm::mat4 clip = projection(eye, target) * eye.view();
  gl_.UniformMatrix4fv(gl_.GetUniformLocation(program, "uClipFromEye"), 1, GL_FALSE, glm::value_ptr(clip));
  const glm::vec3 p(eye.position);
  gl_.Uniform3f(gl_.GetUniformLocation(program, "uEye"), p.x, p.y, p.z);
  gl_.Uniform1f(gl_.GetUniformLocation(program, "uExposure"), kExposure);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.all);
  gl_.Viewport(0, 0, target.width, target.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
}

void Engine::drawLand(const Eye& eye, const Target& target) {
  use(land_, eye, target);
  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl_.ClearDepth(0.0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.BindVertexArray(vertices_);
  gl_.DrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
}

void Engine::drawGlass(const Eye& eye, const Target& target) {
  use(glass_, eye, target);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_.BindVertexArray(glassVertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3 * kSides);
  gl_.Disable(GL_BLEND);
}

std::vector<unsigned char> Engine::shown(const Target& target) const {
  std::vector<float> light(static_cast<std::size_t>(target.width) * target.height * 4);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.all);
  gl_.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_FLOAT, light.data());
  const auto at = [&](int x, int y, int c) { return light[(static_cast<std::size_t>(y) * target.width + x) * 4 + c]; };
  std::vector<unsigned char> bytes;
  for (int y = target.height - 2; y >= 0; y -= 2)
    for (int x = 0; x + 1 < target.width; x += 2)
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) {
          // Filmic curve of K. Narkowicz (2015).
          const double l = std::max(at(x + (k & 1), y + (k >> 1), c), 0.0f);
          sum += 0.25 * std::min(l * (2.51 * l + 0.03) / (l * (2.43 * l + 0.59) + 0.14), 1.0);
        }
        bytes.push_back(static_cast<unsigned char>(std::lround(255.0 * std::pow(sum, 1.0 / 2.2))));
      }
  return bytes;
}

}  // namespace host
