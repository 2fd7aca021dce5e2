// The weather of the GPU's clip levels is the CPU's, whether drawn or uploaded.
#include "welkin/realtime/weather_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

#include "welkin/density/weather_map.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/realtime/noise_textures.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {
namespace {

constexpr WeatherExtent kExtent{.texels = 64, .levels = 3, .finest = 16000.0, .ratio = 2.5};

using Case = std::tuple<std::tuple<LayerShape, Population, bool>, bool>;  // with a picture; made on the processor
class WeatherOnTheGpu : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override { gl_ = gl::loadApi(context_.loader()); }

  Layer layer() const {
    Layer l;
    const auto& [shape, population, picture] = std::get<0>(GetParam());
    l.cloud.shape = shape;
    l.weather.population = population;
    l.weather.precipitation = 0.5f;
    if (picture) l.weather.map = "picture.png";
    return l;
  }

  // Both textures' channels of one slice, as the law's texel has them.
  std::vector<float> read(const WeatherLevels& levels, int slice) {
    const std::size_t count = static_cast<std::size_t>(kExtent.texels) * kExtent.texels;
    std::vector<float> texels(4 * count), half(4 * count);
    gl::Framebuffer framebuffer(gl_);
    for (std::size_t part = 0; part < 2; ++part) {
      const gl::Texture* targets[] = {part == 0 ? &levels.main() : &levels.extra()};
      framebuffer.target(targets, slice);
      gl_.ReadPixels(0, 0, kExtent.texels, kExtent.texels, GL_RGBA, GL_FLOAT, half.data());
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 2; ++c) texels[4 * i + 2 * part + c] = half[4 * i + c];
    }
    return texels;
  }

  gl::Context context_;
  gl::Api gl_;
};

// Heights to 2e-3 of the thickness (the rims of domes, as in the parity cases), shares to 2e-3, beyond a half float's
// own rounding.
TEST_P(WeatherOnTheGpu, IsTheCpus) {
  const gl::Program program(gl_, "weather", "", std::string(shaderSource("welkin/realtime/shaders/weather.frag.glsl")),
                            shaderSource);
  const Layer l = layer();
  Volume map(8, 8, 1, 4);
  for (std::size_t i = 0; i < map.texels.size(); ++i) map.texels[i] = static_cast<float>((i * 7) % 11) / 10.0f;
  roundToHalf(map);
  const gl::Texture picture = textureFromVolume(gl_, map);
  WeatherLevels levels(gl_, kExtent, 1, std::get<1>(GetParam()));
  gl::Framebuffer framebuffer(gl_);
  gl::UniformBuffer buffer(gl_);
  const gl::VertexArray triangle(gl_);
  gl_.BindVertexArray(triangle.id());
  const Drift drift{11.0f, 2.0f, 0.0};
  const glm::dvec2 position(123456.0, -65432.0);
  ASSERT_EQ(levels.update(0, l, position, drift, 5, program, framebuffer, buffer, picture), kExtent.levels);
  for (int level = 0; level < kExtent.levels; ++level) {
    const double edge = kExtent.finest * std::pow(kExtent.ratio, level), texel = edge / kExtent.texels;
    const Volume expected = bakeWeather(l, glm::floor(position / texel) * texel, edge, kExtent.texels, drift, 5, &map);
    const std::vector<float> found = read(levels, level);
    ASSERT_EQ(found.size(), expected.texels.size());
    double most = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool metres = l.cloud.shape == LayerShape::profile ? i % 4 < 2 : i % 4 == 3;
      const double rounding = std::abs(expected.texels[i]) / 1024.0 + 1e-4;
      most = std::max(most, (std::abs(found[i] - expected.texels[i]) - rounding) / (metres ? l.cloud.thickness : 1.0));
    }
    EXPECT_LE(most, 2e-3) << level;
  }
}

// A level that moves on comes in blocks, shown when the last of them is there; one that has come back meanwhile does
// not keep others from coming.
TEST(WeatherLevels, MoveOnABlockAtATime) {
  gl::Context context;
  const gl::Api gl = gl::loadApi(context.loader());
  const gl::Program program(gl, "weather", "", std::string(shaderSource("welkin/realtime/shaders/weather.frag.glsl")),
                            shaderSource);
  const Layer layer;
  const gl::Texture white = textureFromVolume(gl, Volume(1, 1, 1, 4));
  WeatherLevels levels(gl, kExtent, 1, true);
  gl::Framebuffer framebuffer(gl);
  gl::UniformBuffer buffer(gl);
  const gl::VertexArray triangle(gl);
  gl.BindVertexArray(triangle.id());
  const Drift drift{0.0f, 0.0f, 0.0};
  const auto update = [&](double east) {
    return levels.update(0, layer, {east, 0.0}, drift, 5, program, framebuffer, buffer, white, 1);
  };
  ASSERT_EQ(update(0.0), kExtent.levels);
  EXPECT_EQ(update(100.0), 0);
  const double away = 0.1 * kExtent.finest;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(update(away), 0);
  EXPECT_EQ(update(0.0), 0);
  for (int i = 0; i < 63; ++i) EXPECT_EQ(update(-away), 0) << i;
  EXPECT_EQ(update(-away), 1);
  EXPECT_EQ(update(-away), 0);

  std::vector<float> found(static_cast<std::size_t>(kExtent.texels) * kExtent.texels * 4);
  const gl::Texture* targets[] = {&levels.main()};
  framebuffer.target(targets, 0);
  gl.ReadPixels(0, 0, kExtent.texels, kExtent.texels, GL_RGBA, GL_FLOAT, found.data());
  const double texel = kExtent.finest / kExtent.texels;
  const Volume expected =
      bakeWeather(layer, {std::floor(-away / texel) * texel, 0.0}, kExtent.finest, kExtent.texels, drift, 5);
  double most = 0.0;
  for (std::size_t i = 0; i < found.size(); i += 4)
    most = std::max(most, std::abs(static_cast<double>(found[i] - expected.texels[i])));
  EXPECT_LE(most, 2e-3 * layer.cloud.thickness);  // as above
}

INSTANTIATE_TEST_SUITE_P(Layers, WeatherOnTheGpu,
                         testing::Combine(testing::Values(std::tuple(LayerShape::profile, Population::clusters, false),
                                                          std::tuple(LayerShape::profile, Population::domes, true),
                                                          std::tuple(LayerShape::profile, Population::cells, false),
                                                          std::tuple(LayerShape::profile, Population::front, false),
                                                          std::tuple(LayerShape::profile, Population::uniform, false),
                                                          std::tuple(LayerShape::nubis, Population::clusters, false),
                                                          std::tuple(LayerShape::nubis, Population::clusters, true)),
                                          testing::Bool()));

}  // namespace
}  // namespace welkin::realtime
