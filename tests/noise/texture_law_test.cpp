// The fast rows of the CPU route are the law, bit for bit, whatever the sizes, the threads and the instruction set.
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include "welkin/base/error.hpp"
#include "welkin/noise/law.hpp"
#include "welkin/noise/params.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin {
namespace {

glm::vec3 centre(const Volume& v, int x, int y, int z) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(v.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(v.height),
          (static_cast<float>(z) + 0.5f) / static_cast<float>(v.depth)};
}

// Largest difference from the law at every 7th row; `law` answers up to four channels.
template <class Law>
float worstDifference(const Volume& v, const Law& law) {
  float worst = 0;
  for (int row = 0; row < v.height * v.depth; row += 7)
    for (int x = 0; x < v.width; ++x) {
      const int y = row % v.height, z = row / v.height;
      const glm::vec4 expected = law(centre(v, x, y, z));
      for (int c = 0; c < v.channels; ++c) worst = std::max(worst, std::abs(expected[c] - v.at(x, y, z)[c]));
    }
  return worst;
}

// Sizes and frequencies that are no powers of two, and lattices both coarser and finer than a vector of texels.
TEST(NoiseTextures, BaseShapeIsTheLaw) {
  for (const BaseShapeSettings& s :
       {BaseShapeSettings{.size = 48}, BaseShapeSettings{.size = 41, .perlinFrequency = 3, .worleyCells = 5, .seed = 7},
        BaseShapeSettings{.size = 33,
        .perlinFrequency = 30,
        .perlinOctaves = 2,
        .worleyCells = 1,
        .combination = PerlinWorley::carve}}) {
    const auto p = baseShapeParams(s);
    const auto texel = [&](glm::vec3 uvw) { return law::baseShapeTexel(uvw, p); };
    EXPECT_EQ(worstDifference(bakeBaseShape(s), texel), 0.0f) << s.size;
    const auto packed = [&](glm::vec3 uvw) {
      return glm::vec4(law::baseShapePacked(law::baseShapeTexel(uvw, p)), 0, 0);
    };
    EXPECT_EQ(worstDifference(bakeBaseShapePacked(s), packed), 0.0f) << s.size;
  }
}

// With a gamma the SIMD power function enters: not the same bits, but close.
TEST(NoiseTextures, GammaIsTheLawUpToThePowerFunction) {
  const BaseShapeSettings s{.size = 24, .gamma = 2.2f};
  const auto p = baseShapeParams(s);
  EXPECT_LT(worstDifference(bakeBaseShape(s), [&](glm::vec3 uvw) { return law::baseShapeTexel(uvw, p); }), 2e-6f);
}

TEST(NoiseTextures, DetailIsTheLaw) {
  const DetailSettings s{.size = 35, .worleyCells = 3, .seed = 2};
  const auto p = detailParams(s);
  const auto texel = [&](glm::vec3 uvw) { return glm::vec4(law::detailTexel(uvw, p), 0); };
  EXPECT_EQ(worstDifference(bakeDetail(s), texel), 0.0f);
  const auto packed = [&](glm::vec3 uvw) { return glm::vec4(law::detailPacked(law::detailTexel(uvw, p))); };
  EXPECT_EQ(worstDifference(bakeDetailPacked(s), packed), 0.0f);
}

TEST(NoiseTextures, CurlIsTheLaw) {
  const CurlSettings s{.size = 50, .frequency = 5};
  const auto p = curlParams(s);
  const auto texel = [&](glm::vec3 uvw) { return glm::vec4(law::curlTexel(law::xy(uvw), p), 0, 0); };
  EXPECT_EQ(worstDifference(bakeCurl(s), texel), 0.0f);
}

TEST(NoiseTextures, ProfileTexturesAreTheLaw) {
  const ProfileNoiseSettings s{
      .baseSize = 44, .perlinFrequency = 3, .billowCells = 3, .detailSize = 37, .warpSize = 20};
  const auto base = profileBaseParams(s, 0.7f);
  EXPECT_EQ(worstDifference(bakeProfileBase(s),
                            [&](glm::vec3 uvw) { return glm::vec4(law::profileBaseTexel(uvw, base), 0, 0); }),
            0.0f);
  EXPECT_EQ(worstDifference(bakeProfileBasePacked(s, 0.7f),
                            [&](glm::vec3 uvw) {
                              return glm::vec4(law::profileBasePacked(law::profileBaseTexel(uvw, base), base));
                            }),
            0.0f);
  const auto detail = profileDetailParams(s);
  EXPECT_EQ(worstDifference(bakeProfileDetail(s),
                            [&](glm::vec3 uvw) { return glm::vec4(law::profileDetailTexel(uvw, detail), 0, 0); }),
            0.0f);
  const auto warp = profileWarpParams(s);
  EXPECT_EQ(worstDifference(bakeProfileWarp(s),
                            [&](glm::vec3 uvw) { return glm::vec4(law::profileWarpTexel(uvw, warp), 0, 0); }),
            0.0f);
}

// Negative control: the comparison sees another seed.
TEST(NoiseTextures, AnotherSeedIsAnotherTexture) {
  const BaseShapeSettings s{.size = 24};
  const auto p = baseShapeParams({.size = 24, .seed = 1});
  EXPECT_GT(worstDifference(bakeBaseShape(s), [&](glm::vec3 uvw) { return law::baseShapeTexel(uvw, p); }), 0.2f);
}

TEST(NoiseTextures, SameBitsOnOneThreadAndMany) {
  const ProfileNoiseSettings s{.baseSize = 40};
  const Volume many = bakeProfileBase(s), manyShape = bakeBaseShape({.size = 40});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many.texels, bakeProfileBase(s).texels);
  EXPECT_EQ(manyShape.texels, bakeBaseShape({.size = 40}).texels);
}

TEST(NoiseTextures, SameBitsOnEveryInstructionSet) {
  const ProfileNoiseSettings s{.baseSize = 40, .detailSize = 24, .warpSize = 16};
  const Volume base = bakeProfileBase(s), detail = bakeProfileDetail(s), warp = bakeProfileWarp(s);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(base.texels, bakeProfileBase(s).texels) << hwy::TargetName(target);
    EXPECT_EQ(detail.texels, bakeProfileDetail(s).texels) << hwy::TargetName(target);
    EXPECT_EQ(warp.texels, bakeProfileWarp(s).texels) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(NoiseTextures, RefuseSettingsOutOfRange) {
  EXPECT_THROW(bakeBaseShape({.size = 0}), Error);
  EXPECT_THROW(bakeBaseShape({.gamma = 0.0f}), Error);
  EXPECT_THROW(bakeDetail({.lowWeight = 0, .midWeight = 0, .highWeight = 0}), Error);
  try {
    bakeCurl({.octaves = 99});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::badInput);
    EXPECT_STREQ(e.what(), "noise: octaves is 99, outside 1 to 8");
  }
}

}  // namespace
}  // namespace welkin
