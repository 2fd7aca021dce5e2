#include "welkin/realtime/host.hpp"

#include <algorithm>
#include <regex>
#include <set>

#include "welkin/base/error.hpp"
#include "welkin/gl/source.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

constexpr const char* kHostFile = "welkin/realtime/shaders/host.glsl";
constexpr float kDepthUnit = 4.0f;       // m, of a view's cloud depth (shaders/march.frag.glsl)
constexpr float kDepthLimit = 60000.0f;  // the most that it holds

bool isHosts(const std::string& name) {
  return name.starts_with("welkin") || name.starts_with("Welkin") || name.starts_with("uWelkin");
}

// What the text declares outside all braces: functions, structs, constants, macros.
std::set<std::string> declaredNames(const std::string& text) {
  static const std::regex kDeclaration(R"(^(?:#define +(\w+)|struct +(\w+)|const +\w+ +(\w+)|(?:FN +)?\w+ +(\w+)\())");
  std::set<std::string> names;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    std::smatch found;
    if (std::regex_search(line, found, kDeclaration))
      for (std::size_t i = 1; i < found.size(); ++i)
        if (found[i].matched && !isHosts(found[i])) names.insert(found[i]);
    at = end + 1;
  }
  return names;
}

// Puts the prefix before every use of the names outside comments, but for members and swizzles, which stand behind a
// dot.
std::string withPrefix(const std::string& text, const std::set<std::string>& names) {
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    if (text.compare(at, 2, "//") == 0) {
      end = std::min(text.find('\n', at), text.size());
      out += text.substr(at, end - at);
      at = end;
      continue;
    }
    while (end < text.size() && isWord(text[end])) ++end;
    const std::string word = text.substr(at, end - at);
    if (end > at) {
      const bool member = at > 0 && text[at - 1] == '.';
      out += (!member && names.count(word) ? "welkin_" : "") + word;
      at = end;
    } else {
      out += text[at++];
    }
  }
  return out;
}

}  // namespace

const std::string& hostShaderText() {
  static const std::string text = [] {
    const std::string whole = gl::expandIncludes(shaderText(kHostFile), kHostFile, shaderSource).text;
    return withPrefix(whole, declaredNames(whole));
  }();
  return text;
}

law::HostParams hostParams(const law::AtmosphereParams& air, const law::LightVolumeParams* volume,
                           const law::MarchParams& march, const SkyLight& light) {
  law::HostParams h{};
  h.air = air;
  if (volume) h.volume = *volume;
  h.hasVolume = volume ? 1.0f : 0.0f;
  h.planet = march.planet;
  h.skyAround = march.skyAround;
  h.skyOpen = march.skyOpen;
  h.clearSky = glm::vec4(light.skyIrradiance, 0.0f);
  h.shadedSky = march.skyIrradiance;
  h.shadedAir = march.shadedAir;
  h.groundAlbedo = march.groundAlbedo;
  h.bottom = march.bottom;
  h.top = march.top;
  // The march forgets directions within 0.86 / 0.14 mean free paths of typical cloud (march_params.cpp).
  h.extinction = 0.86f / (0.14f * std::max(march.transportPath, 1.0f));
  h.depthUnit = kDepthUnit;
  h.depthFar = 0.98f * std::min(march.maxDistance / kDepthUnit, kDepthLimit);
  return h;
}

void setHostView(law::HostParams& h, const Frame& frame, const FrameParams& params) {
  const glm::mat4 rows = glm::transpose(params.clipFromWorld);
  h.clip0 = rows[0];
  h.clip1 = rows[1];
  h.clip3 = rows[3];
  // Texel i of the march stands at pixel interleave * i + offset of the history.
  const float turns = 1.0f / params.timing.w;
  h.depthPlace = {glm::vec2(params.size) * turns, (-0.5f - glm::vec2(params.offset)) * turns};
  h.exposure = frame.preExposure;
  h.cloudExposure = params.options.x;
  h.yUp = frame.up == UpAxis::y ? 1.0f : 0.0f;
}

void bindHost(const gl::Api& gl, unsigned program, unsigned firstUnit, unsigned block, const gl::UniformBuffer& buffer,
              std::span<const HostSampler> samplers) {
  const GLuint index = gl.GetUniformBlockIndex(program, "WelkinHost");
  if (index == GL_INVALID_INDEX)
    throw Error(
        ErrorKind::badInput, "",
        "the program does not use the uniform block WelkinHost: Renderer::hostShader() has to be part of one of "
        "its shaders, and one of its functions called");
  GLint unit = 0, current = 0, generic = 0;
  gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
  gl.GetIntegerv(GL_CURRENT_PROGRAM, &current);
  gl.GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &generic);
  gl.UniformBlockBinding(program, index, block);
  buffer.bind(block);
  gl.BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(generic));
  gl.UseProgram(program);
  GLuint next = firstUnit;
  for (const HostSampler& sampler : samplers) {
    const GLint location = gl.GetUniformLocation(program, sampler.name);
    if (location < 0) continue;
    gl.ActiveTexture(GL_TEXTURE0 + next);
    gl.BindTexture(sampler.target, sampler.texture ? sampler.texture->id() : 0);
    gl.BindSampler(next, 0);
    gl.Uniform1i(location, static_cast<GLint>(next++));
  }
  gl.UseProgram(static_cast<GLuint>(current));
  gl.ActiveTexture(static_cast<GLenum>(unit));
}

}  // namespace welkin::realtime
