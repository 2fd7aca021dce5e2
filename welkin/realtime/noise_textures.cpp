#include "welkin/realtime/noise_textures.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/noise/params.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {

namespace {

// The law's struct, and the call that answers its texel as a vec4 from `uvw` and `p`.
struct Recipe {
  const char* params;
  const char* texel;
  gl::Format format;
};
constexpr Recipe kBaseShape{"BaseShapeParams", "baseShapeTexel(uvw, p)", gl::kRgba16F};
constexpr Recipe kBaseShapePacked{"BaseShapeParams", "vec4(baseShapePacked(baseShapeTexel(uvw, p)), 0.0, 1.0)",
                                  gl::kRg16F};
constexpr Recipe kDetail{"DetailParams", "vec4(detailTexel(uvw, p), 1.0)", gl::kRgba16F};
constexpr Recipe kDetailPacked{"DetailParams", "vec4(detailPacked(detailTexel(uvw, p)))", gl::kR16F};
constexpr Recipe kCurl{"CurlParams", "vec4(curlTexel(xy(uvw), p), 0.0, 1.0)", gl::kRg16F};
constexpr Recipe kProfileBase{"ProfileBaseParams", "vec4(profileBaseTexel(uvw, p), 0.0, 1.0)", gl::kRg16F};
constexpr Recipe kProfileBasePacked{"ProfileBaseParams", "vec4(profileBasePacked(profileBaseTexel(uvw, p), p))",
                                    gl::kR16F};
constexpr Recipe kProfileDetail{"ProfileDetailParams", "vec4(profileDetailTexel(uvw, p), 0.0, 1.0)", gl::kRg16F};
constexpr Recipe kProfileWarp{"ProfileWarpParams", "vec4(profileWarpTexel(uvw, p), 0.0, 1.0)", gl::kRg16F};

// Draws all slices; depth 0 is a plane.
template <class Params>
gl::Texture generate(const gl::Api& gl, const Recipe& recipe, const Params& params, int size, int depth) {
  static_assert(sizeof(Params) % 16 == 0, "the law's parameters are std140-clean");
  const std::string defines =
      std::string("#define NOISE_PARAMS ") + recipe.params + "\n#define NOISE_TEXEL(uvw, p) " + recipe.texel + "\n";
  const gl::Program program(gl, "noise texture", defines, shaderText("welkin/realtime/shaders/noise_texture.frag.glsl"),
                            shaderSource);
  gl::Texture texture(gl, depth > 0 ? gl::Texture::Kind::volume : gl::Texture::Kind::plane, recipe.format, size, size,
                      depth, gl::Filter::linear, gl::Addressing::repeat, nullptr);
  gl::UniformBuffer block(gl);
  block.upload(&params, sizeof params);
  block.bind(0);
  program.bindBlock("Noise", 0);
  gl.UseProgram(program.id());
  gl.Uniform3f(program.uniform("uSize"), static_cast<float>(size), static_cast<float>(size),
               static_cast<float>(depth > 0 ? depth : 1));
  const gl::VertexArray triangle(gl);
  gl.BindVertexArray(triangle.id());
  gl::Framebuffer framebuffer(gl);
  const gl::Texture* targets[] = {&texture};
  for (int slice = 0; slice < (depth > 0 ? depth : 1); ++slice) {
    framebuffer.target(targets, slice);
    gl.Uniform1f(program.uniform("uSlice"), static_cast<float>(slice));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl.check("generating a noise texture");
  return texture;
}

template <class Params>
gl::Texture generateCube(const gl::Api& gl, const Recipe& recipe, const Params& params, int size) {
  return generate(gl, recipe, params, size, size);
}

}  // namespace

gl::Texture generateBaseShape(const gl::Api& gl, const BaseShapeSettings& settings) {
  return generateCube(gl, kBaseShape, baseShapeParams(settings), settings.size);
}
gl::Texture generateBaseShapePacked(const gl::Api& gl, const BaseShapeSettings& settings) {
  return generateCube(gl, kBaseShapePacked, baseShapeParams(settings), settings.size);
}
gl::Texture generateDetail(const gl::Api& gl, const DetailSettings& settings) {
  return generateCube(gl, kDetail, detailParams(settings), settings.size);
}
gl::Texture generateDetailPacked(const gl::Api& gl, const DetailSettings& settings) {
  return generateCube(gl, kDetailPacked, detailParams(settings), settings.size);
}
gl::Texture generateCurl(const gl::Api& gl, const CurlSettings& settings) {
  return generate(gl, kCurl, curlParams(settings), settings.size, 0);
}
gl::Texture generateProfileBase(const gl::Api& gl, const ProfileNoiseSettings& settings) {
  return generateCube(gl, kProfileBase, profileBaseParams(settings, 0.0f), settings.baseSize);
}
gl::Texture generateProfileBasePacked(const gl::Api& gl, const ProfileNoiseSettings& settings, float billowMix) {
  return generateCube(gl, kProfileBasePacked, profileBaseParams(settings, billowMix), settings.baseSize);
}
gl::Texture generateProfileDetail(const gl::Api& gl, const ProfileNoiseSettings& settings) {
  return generateCube(gl, kProfileDetail, profileDetailParams(settings), settings.detailSize);
}
gl::Texture generateProfileWarp(const gl::Api& gl, const ProfileNoiseSettings& settings) {
  return generateCube(gl, kProfileWarp, profileWarpParams(settings), settings.warpSize);
}

gl::Texture textureFromVolume(const gl::Api& gl, Volume volume) {
  if (volume.channels < 1 || volume.channels > 4)
    throw Error(ErrorKind::badInput, "", "a volume has 1 to 4 channels, not " + std::to_string(volume.channels));
  roundToHalf(volume);
  const auto kind = volume.depth > 1 ? gl::Texture::Kind::volume : gl::Texture::Kind::plane;
  const auto make = [&](const gl::Format& format, const float* texels) {
    return gl::Texture(gl, kind, format, volume.width, volume.height, volume.depth, gl::Filter::linear,
                       gl::Addressing::repeat, texels);
  };
  if (volume.channels == 1) return make(gl::kR16F, volume.texels.data());
  if (volume.channels == 2) return make(gl::kRg16F, volume.texels.data());
  if (volume.channels == 4) return make(gl::kRgba16F, volume.texels.data());
  std::vector<float> four(volume.texels.size() / 3 * 4, 1.0f);
  for (std::size_t i = 0; i < volume.texels.size(); ++i) four[i / 3 * 4 + i % 3] = volume.texels[i];
  return make(gl::kRgba16F, four.data());
}

Volume volumeFromTexture(const gl::Api& gl, const gl::Texture& texture, int channels) {
  Volume volume(texture.width(), texture.height(), std::max(texture.depth(), 1), channels);
  const std::size_t count = static_cast<std::size_t>(volume.width) * volume.height;
  std::vector<float> slice(4 * count);
  gl::Framebuffer framebuffer(gl);
  const gl::Texture* targets[] = {&texture};
  auto out = volume.texels.begin();
  for (int z = 0; z < volume.depth; ++z) {
    framebuffer.target(targets, z);
    gl.ReadPixels(0, 0, volume.width, volume.height, GL_RGBA, GL_FLOAT, slice.data());
    for (std::size_t i = 0; i < count; ++i)
      out = std::copy_n(slice.begin() + static_cast<std::ptrdiff_t>(4 * i), channels, out);
  }
  gl.check("reading a texture");
  return volume;
}

}  // namespace welkin::realtime
