// The sky's tables on the GPU against those of the CPU, and what update() renders anew.
#include "welkin/realtime/sky_tables.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {
namespace {

class SkyTablesOnGpu : public testing::TestWithParam<gl::ContextKind> {
 protected:
  std::vector<float> read(const gl::Texture& texture, int layer = 0) {
    gl::Framebuffer framebuffer(gl_);
    const gl::Texture* const targets[] = {&texture};
    framebuffer.target(targets, layer);
    std::vector<float> texels(static_cast<std::size_t>(texture.width()) * texture.height() * 4);
    gl_.ReadPixels(0, 0, texture.width(), texture.height(), GL_RGBA, GL_FLOAT, texels.data());
    gl_.check("reading a table");
    return texels;
  }
  // Largest difference of colours against max(value, floor).
  double difference(const gl::Texture& texture, const Table& table, double floor) {
    double worst = 0;
    const int layers = std::max(texture.depth(), 1);
    const std::size_t plane = static_cast<std::size_t>(table.width) * table.height * 4;
    for (int z = 0; z < layers; ++z) {
      const std::vector<float> got = read(texture, z);
      for (std::size_t i = 0; i < plane; ++i) {
        const double a = table.texels[plane * static_cast<std::size_t>(z) + i], b = got[i];
        worst = std::max(worst, std::isfinite(b) ? std::abs(a - b) / std::max(std::abs(a), floor) : 1e30);
      }
    }
    return worst;
  }

  gl::Context context_{GetParam()};
  gl::Api gl_ = gl::loadApi(context_.loader());
};

// Half floats carry 11 bits: each table is off by 5e-4, and the tables that read a half-float transmittance by a little
// more where it is small.
TEST_P(SkyTablesOnGpu, AreThoseOfTheCpu) {
  SkyTables gpu(gl_);
  struct Case {
    SkyKind model;
    double elevation, altitude;
  };
  for (const Case& c :
       {Case{SkyKind::physical, 0.7, 150}, Case{SkyKind::physical, 0.02, 11000}, Case{SkyKind::physical, -0.15, 2},
        Case{SkyKind::preetham, 0.5, 150}, Case{SkyKind::gradient, 0.5, 150}}) {
    Atmosphere atmosphere;
    atmosphere.model = c.model;
    const glm::vec3 sun(directionFromAngles(2.0, c.elevation));
    gpu.update(atmosphere, sun, c.altitude);
    const SkyTablesCpu cpu = bakeSky(atmosphere, sun, c.altitude);
    const double differences[] = {difference(gpu.transmittance(), cpu.air.transmittance, 1e-2),
                                  difference(gpu.multiScattering(), cpu.air.multiScattering, 1e-2),
                                  difference(gpu.skyView(), cpu.skyView, 1e-2),
                                  difference(gpu.aerialInscatter(), cpu.aerialInscatter, 1e-3),
                                  difference(gpu.aerialTransmittance(), cpu.aerialTransmittance, 1e-2)};
    std::printf("GPU - CPU:");
    for (const double d : differences) {
      std::printf(" %.1e", d);
      EXPECT_LT(d, 4e-3) << c.elevation;
    }
    std::printf("\n");
    EXPECT_EQ(gpu.light().skyIrradiance, cpu.light.skyIrradiance);
  }
  EXPECT_EQ(gpu.airFills(), 1);
  EXPECT_LT(gpu.bytes(), 1500000u);
}

TEST_P(SkyTablesOnGpu, RenderOnlyWhatChanged) {
  SkyTables gpu(gl_);
  Atmosphere atmosphere;
  const glm::vec3 sun(directionFromAngles(2.0, 0.5));
  const auto fills = [&] { return std::pair(gpu.airFills(), gpu.skyFills()); };
  gpu.update(atmosphere, sun, 1000);
  EXPECT_EQ(fills(), std::pair(1, 1));
  gpu.update(atmosphere, sun, 1000);
  gpu.update(atmosphere, sun, 1003);
  EXPECT_EQ(fills(), std::pair(1, 1)) << "three metres at a thousand change nothing";
  gpu.update(atmosphere, sun, 1010);
  EXPECT_EQ(fills(), std::pair(1, 2));
  gpu.update(atmosphere, glm::vec3(directionFromAngles(2.0, 0.51)), 1010);
  EXPECT_EQ(fills(), std::pair(1, 3));
  atmosphere.mie = 4;
  gpu.update(atmosphere, sun, 1010);
  EXPECT_EQ(fills(), std::pair(2, 4));
  gpu.update(atmosphere, sun, 1010, glm::vec3(0.8f));
  EXPECT_EQ(fills(), std::pair(3, 5)) << "snow lights the air from below";
}

// The driver's layout of the uniform block is that of the C++ structs.
TEST_P(SkyTablesOnGpu, ShareTheirLayoutWithTheDriver) {
  const gl::Program program(gl_, "sky_view", "",
                            std::string(shaderSource("welkin/realtime/shaders/sky_view.frag.glsl")), shaderSource);
  const std::pair<const char*, std::size_t> members[] = {
      {"uAir.rayleigh", offsetof(SkyParams, air.rayleigh)},
      {"uAir.sunIrradiance", offsetof(SkyParams, air.sunIrradiance)},
      {"uAir.thickness", offsetof(SkyParams, air.thickness)},
      {"uAir.horizonElevation", offsetof(SkyParams, air.horizonElevation)},
      {"uAir.radianceScale", offsetof(SkyParams, air.radianceScale)},
      {"uAir.skyKind", offsetof(SkyParams, air.skyKind)},
      {"uPreetham.a", offsetof(SkyParams, preetham.a)},
      {"uPreetham.zenith", offsetof(SkyParams, preetham.zenith)},
      {"uGradient.glow", offsetof(SkyParams, gradient.glow)}};
  for (const auto& [name, offset] : members) {
    GLuint index = GL_INVALID_INDEX;
    gl_.GetUniformIndices(program.id(), 1, &name, &index);
    ASSERT_NE(index, GL_INVALID_INDEX) << name;
    GLint got = -1;
    gl_.GetActiveUniformsiv(program.id(), 1, &index, GL_UNIFORM_OFFSET, &got);
    EXPECT_EQ(static_cast<std::size_t>(got), offset) << name;
  }
}

class Painted : public SkyModel {
 public:
  glm::vec3 radiance(const glm::vec3& d) const override { return {colour, d.z, 1.0f}; }
  std::uint64_t revision() const override { return number; }
  float colour = 2.0f;
  std::uint64_t number = 0;
};

TEST_P(SkyTablesOnGpu, HoldAUsersModel) {
  SkyTables gpu(gl_);
  Painted model;
  const glm::vec3 sun(directionFromAngles(2.0, 0.5));
  gpu.update({}, sun, 100, kDefaultGroundAlbedo, &model);
  const std::size_t top = (127 * 96 + 5) * 4;
  EXPECT_NEAR(read(gpu.skyView())[top], 2.0f, 2e-3f);
  EXPECT_NEAR(gpu.light().meanRadiance.x, 2.0f, 1e-3f);
  model.colour = 3.0f;
  gpu.update({}, sun, 100, kDefaultGroundAlbedo, &model);
  EXPECT_EQ(gpu.skyFills(), 1);
  model.number = 1;
  gpu.update({}, sun, 100, kDefaultGroundAlbedo, &model);
  EXPECT_NEAR(read(gpu.skyView())[top], 3.0f, 2e-3f);
  gpu.update({}, sun, 100);
  EXPECT_NE(read(gpu.skyView())[top], 3.0f);
}

TEST_P(SkyTablesOnGpu, Cost) {
  SkyTables gpu(gl_);
  const auto timed = [&](const char* what, const Atmosphere& atmosphere, double elevation) {
    gl_.Finish();
    const auto begin = std::chrono::steady_clock::now();
    gpu.update(atmosphere, glm::vec3(directionFromAngles(2.0, elevation)), 100);
    gl_.Finish();
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    std::printf("%s: %.1f ms\n", what, ms.count());
  };
  Atmosphere hazy;
  hazy.mie = 4;
  timed("first fill", {}, 0.5);
  timed("new air", hazy, 0.5);
  timed("new sun", hazy, 0.6);
  timed("unchanged", hazy, 0.6);
  std::printf("%zu bytes\n", gpu.bytes());
}

INSTANTIATE_TEST_SUITE_P(Kinds, SkyTablesOnGpu, testing::Values(gl::ContextKind::desktop, gl::ContextKind::es),
                         [](const auto& chosen) {
                           return std::string(chosen.param == gl::ContextKind::es ? "es" : "desktop");
                         });

}  // namespace
}  // namespace welkin::realtime
