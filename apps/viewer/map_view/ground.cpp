#include "apps/viewer/map_view/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "welkin/realtime/shader_sources.hpp"

namespace welkin::viewer {

namespace {

constexpr int kUnit = 9;  // the include for hosts takes those before it
constexpr int kRings = 90, kSectors = 128;

// Rings round the point below the eye, each a tenth wider than the one inside it, to beyond the horizon.
constexpr const char* kVertex = R"(
uniform mat4 uClipFromEye;
uniform float uEyeHeight;
out vec3 vFromEye;
out vec2 vPlace;  // from the point below the eye, m
const int kSectors = 128;
const int kCorners[6] = int[6](0, 1, 2, 1, 3, 2);
void main() {
  int quad = gl_VertexID / 6, corner = kCorners[gl_VertexID - 6 * quad];
  int ring = quad / kSectors + (corner >> 1), sector = quad - kSectors * (quad / kSectors) + (corner & 1);
  float radius = 250.0 * (pow(1.1, float(ring)) - 1.0);
  float angle = 6.28318531 * float(sector % kSectors) / float(kSectors);
  vPlace = radius * vec2(sin(angle), cos(angle));
  vFromEye = vec3(vPlace, -uEyeHeight - radius * radius / 12720000.0);
  gl_Position = uClipFromEye * vec4(vFromEye, 1.0);
}
)";

constexpr const char* kFragment = R"(
in vec3 vFromEye;
in vec2 vPlace;
uniform sampler2D uPicture;
uniform vec4 uLand;  // of the point below the eye in the picture; one by its size, 1/m
uniform vec3 uSurroundings;
uniform float uExposure;
out vec4 oColour;
void main() {
  vec2 uv = uLand.xy + vPlace * uLand.zw;
  vec3 albedo = texture(uPicture, uv).rgb;
  // The edge is as sharp as a pixel is.
  vec2 inside = clamp((0.5 - abs(uv - 0.5)) / max(fwidth(uv), 1e-7) + 0.5, 0.0, 1.0);
  albedo = mix(uSurroundings, albedo, inside.x * inside.y);
  WelkinLight light = welkinLight(vFromEye);
  vec3 radiance = albedo * (light.sun * max(light.toSun.z, 0.0) + light.sky) / 3.14159265;
  WelkinFront air = welkinAir(vFromEye);
  oColour = vec4(radiance * uExposure * air.through + air.light, 1.0);
}
)";

constexpr gl::Format kSrgb8{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, "SRGB8_ALPHA8"};

struct Level {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// Half as large, from the mean of 2 x 2; linear light has the mean, not its code.
Level halved(const Level& from) {
  static const auto kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float v = static_cast<float>(i) / 255.0f;
      table[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    }
    return table;
  }();
  Level to{std::max(from.width / 2, 1), std::max(from.height / 2, 1), {}};
  to.rgba.resize(static_cast<std::size_t>(to.width) * to.height * 4);
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x)
      for (int c = 0; c < 4; ++c) {
        float sum = 0.0f;
        for (int i = 0; i < 4; ++i) {
          const int sx = std::min(2 * x + (i & 1), from.width - 1), sy = std::min(2 * y + (i >> 1), from.height - 1);
          sum += kLinear[from.rgba[(static_cast<std::size_t>(sy) * from.width + sx) * 4 + c]];
        }
        const float mean = 0.25f * sum;
        const float code = mean <= 0.0031308f ? 12.92f * mean : 1.055f * std::pow(mean, 1.0f / 2.4f) - 0.055f;
        to.rgba[(static_cast<std::size_t>(y) * to.width + x) * 4 + c] =
            static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(code, 0.0f, 1.0f)));
      }
  return to;
}

// South row first.
Level firstLevel(const Image& picture) {
  Level level{picture.width, picture.height, {}};
  level.rgba.resize(static_cast<std::size_t>(picture.width) * picture.height * 4, 255);
  const bool grey = picture.channels < 3;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        level.rgba[(static_cast<std::size_t>(picture.height - 1 - y) * picture.width + x) * 4 + c] =
            static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(picture.at(x, y)[grey ? 0 : c], 0.0f, 1.0f)));
  return level;
}

}  // namespace

MapGround::MapGround(const gl::Api& gl, MapPicture map)
    : gl_(gl), map_(std::move(map)),
      program_(gl, "map", "", realtime::Renderer::hostShader() + kFragment, realtime::shaderSource, kVertex),
      none_(gl) {
  upload();
  map_.picture = Image();
}

void MapGround::upload() {
  Level level = firstLevel(map_.picture);
  while (std::max(level.width, level.height) > kLargest) level = halved(level);
  texture_ = gl::Texture(gl_, gl::Texture::Kind::plane, kSrgb8, level.width, level.height, 0, gl::Filter::linear,
                         gl::Addressing::clamp, level.rgba.data());
  // Seen from far away each pixel takes the mean of what it covers.
  int number = 0;
  while (std::max(level.width, level.height) > 1) {
    level = halved(level);
    gl_.TexImage2D(GL_TEXTURE_2D, ++number, static_cast<GLint>(kSrgb8.internal), level.width, level.height, 0,
                   kSrgb8.external, kSrgb8.type, level.rgba.data());
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, number);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.check("making a map's texture");
}

void MapGround::drawSurfaces(const realtime::Frame& frame, const Target& /*target*/, const Bind& bind) {
  gl_.UseProgram(program_.id());
  bind(program_.id());
  const glm::mat4 clip = frame.projection * frame.view;
  gl_.UniformMatrix4fv(program_.uniform("uClipFromEye"), 1, GL_FALSE, glm::value_ptr(clip));
  gl_.Uniform1f(program_.uniform("uEyeHeight"), static_cast<float>(frame.position.z));
  const glm::dvec2 below = (frame.origin - map_.corner) / map_.size;
  gl_.Uniform4f(program_.uniform("uLand"), static_cast<float>(below.x), static_cast<float>(below.y),
                static_cast<float>(1.0 / map_.size.x), static_cast<float>(1.0 / map_.size.y));
  gl_.Uniform3f(program_.uniform("uSurroundings"), surroundings_.x, surroundings_.y, surroundings_.z);
  gl_.Uniform1f(program_.uniform("uExposure"), frame.preExposure);
  gl_.ActiveTexture(GL_TEXTURE0 + kUnit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.Uniform1i(program_.uniform("uPicture"), kUnit);
  gl_.BindVertexArray(none_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, kRings * kSectors * 6);
  gl_.check("drawing the map");
}

}  // namespace welkin::viewer
