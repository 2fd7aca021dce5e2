// The GPU's noise textures are the CPU's, to one unit of a half float's last place, on desktop OpenGL and OpenGL ES.
#include "welkin/realtime/noise_textures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin::realtime {
namespace {

class NoiseOnTheGpu : public testing::TestWithParam<gl::ContextKind> {
 protected:
  void SetUp() override {
    context_ = std::make_unique<gl::Context>(GetParam());
    gl_ = gl::loadApi(context_->loader());
  }

  // All texels, four channels each.
  std::vector<float> read(const gl::Texture& texture) const {
    const int depth = std::max(texture.depth(), 1);
    const std::size_t slice = static_cast<std::size_t>(texture.width()) * texture.height() * 4;
    std::vector<float> texels(slice * depth);
    gl::Framebuffer framebuffer(gl_);
    const gl::Texture* targets[] = {&texture};
    for (int z = 0; z < depth; ++z) {
      framebuffer.target(targets, z);
      gl_.ReadPixels(0, 0, texture.width(), texture.height(), GL_RGBA, GL_FLOAT, texels.data() + slice * z);
    }
    gl_.check("reading a noise texture");
    return texels;
  }

  // Largest difference in units of the last place of a half float. Differences of GLSL's and C++'s rounding (1e-5 for
  // curl and stretched channels, see the parity cases) count as none.
  double worst(const gl::Texture& texture, Volume volume) const {
    roundToHalf(volume);
    const std::vector<float> texels = read(texture);
    EXPECT_EQ(texels.size() / 4, volume.texels.size() / volume.channels);
    double most = 0;
    for (std::size_t i = 0; i < volume.texels.size(); ++i) {
      const std::size_t texel = i / volume.channels, c = i % volume.channels;
      const double a = volume.texels[i], b = texels[texel * 4 + c];
      const double unit = std::ldexp(1.0, std::max(std::ilogb(std::max(std::abs(a), 1e-9)), -14) - 10);
      most = std::max(most, (std::abs(a - b) - 1e-5) / unit);
    }
    return most;
  }

  std::unique_ptr<gl::Context> context_;
  gl::Api gl_;
};

TEST_P(NoiseOnTheGpu, ClassicTexturesAreTheCpus) {
  const BaseShapeSettings base{.size = 40, .worleyCells = 4, .gamma = 1.5f, .seed = 3};
  EXPECT_LE(worst(generateBaseShape(gl_, base), bakeBaseShape(base)), 1.0);
  EXPECT_LE(worst(generateBaseShapePacked(gl_, base), bakeBaseShapePacked(base)), 1.0);
  const DetailSettings detail{};
  EXPECT_LE(worst(generateDetail(gl_, detail), bakeDetail(detail)), 1.0);
  EXPECT_LE(worst(generateDetailPacked(gl_, detail), bakeDetailPacked(detail)), 1.0);
  EXPECT_LE(worst(generateCurl(gl_, {}), bakeCurl({})), 1.0);
  EXPECT_EQ(generateCurl(gl_, {}).depth(), 0);
}

TEST_P(NoiseOnTheGpu, ProfileTexturesAreTheCpus) {
  const ProfileNoiseSettings s{.baseSize = 48, .detailSize = 32, .seed = 3};
  EXPECT_LE(worst(generateProfileBase(gl_, s), bakeProfileBase(s)), 1.0);
  EXPECT_LE(worst(generateProfileBasePacked(gl_, s, 0.75f), bakeProfileBasePacked(s, 0.75f)), 1.0);
  EXPECT_LE(worst(generateProfileDetail(gl_, s), bakeProfileDetail(s)), 1.0);
  EXPECT_LE(worst(generateProfileWarp(gl_, s), bakeProfileWarp(s)), 1.0);
}

// Uploaded texels are exactly those of roundToHalf; three channels gain an alpha of 1.
TEST_P(NoiseOnTheGpu, UploadedVolumesAreTheirHalfFloats) {
  for (const int channels : {1, 2, 3, 4}) {
    Volume v(8, 4, 2, channels);
    for (std::size_t i = 0; i < v.texels.size(); ++i)
      v.texels[i] = std::ldexp(std::sin(static_cast<float>(i) + 1.0f), static_cast<int>(i % 40) - 26);
    const gl::Texture texture = textureFromVolume(gl_, v);
    const std::vector<float> texels = read(texture);
    for (std::size_t i = 0; i < v.texels.size(); ++i)
      EXPECT_EQ(texels[i / channels * 4 + i % channels], roundedToHalf(v.texels[i])) << channels << " " << v.texels[i];
    if (channels == 3) {
      EXPECT_EQ(texels[3], 1.0f);
    }
  }
  EXPECT_THROW(textureFromVolume(gl_, Volume(2, 2, 1, 5)), Error);
}

// Negative control: the comparison sees a setting that changes the texture by a per cent.
TEST_P(NoiseOnTheGpu, ComparisonSeesAnotherSetting) {
  const DetailSettings s{.size = 16, .gamma = 1.01f};
  EXPECT_GT(worst(generateDetail(gl_, {.size = 16}), bakeDetail(s)), 4.0);
}

INSTANTIATE_TEST_SUITE_P(Contexts, NoiseOnTheGpu, testing::Values(gl::ContextKind::desktop, gl::ContextKind::es),
                         [](const auto& kind) { return kind.param == gl::ContextKind::es ? "es" : "desktop"; });

}  // namespace
}  // namespace welkin::realtime
