// The OSL nodes against the law: their headers read as C++ everywhere, and compiled and run where oslc and testshade
// are.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>

#include "tests/osl/osl_language.hpp"
#include "welkin/density/field.hpp"
#include "welkin/density/hero_body.hpp"
#include "welkin/density/hero_shape.hpp"

namespace welkin {
namespace {

int signedOf(std::uint32_t x) { return static_cast<int>(x); }
std::uint32_t unsignedOf(int x) { return static_cast<std::uint32_t>(x); }

TEST(Osl, MaskedHashIsTheLawsHash) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000000; ++i) {
    const auto x = static_cast<std::uint32_t>(random());
    ASSERT_EQ(unsignedOf(osl::welkin_hash(signedOf(x))), law::hashUint(x)) << x;
  }
  for (const std::uint32_t x : {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu})
    EXPECT_EQ(unsignedOf(osl::welkin_hash(signedOf(x))), law::hashUint(x)) << x;
}

TEST(Osl, MaskedShiftIsUnsigned) {
  std::mt19937 random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<std::uint32_t>(random());
    const int n = 1 + static_cast<int>(random() % 31);
    ASSERT_EQ(unsignedOf(osl::welkin_shift(signedOf(x), n)), x >> n) << x << " >> " << n;
  }
}

TEST(Osl, HashesOfCellsAreTheLaws) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> cell(-100000, 100000);
  for (int i = 0; i < 100000; ++i) {
    const int x = cell(random), y = cell(random), z = cell(random), w = cell(random);
    const auto seed = static_cast<std::uint32_t>(random());
    ASSERT_EQ(unsignedOf(osl::welkin_hash3(x, y, z, signedOf(seed))), law::hashCell3(x, y, z, seed));
    ASSERT_EQ(unsignedOf(osl::welkin_hash4(x, y, z, w, signedOf(seed))), law::hashCell4(x, y, z, w, seed));
    for (const int period : {0, 1, 64, 96, 672})
      ASSERT_EQ(osl::welkin_wrap(x, period), law::wrapCell(x, period)) << x << " " << period;
  }
}

TEST(Osl, NoisesAreTheLaws) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> at(-150.0f, 150.0f);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec4 p(at(random), at(random), at(random), at(random));
    const int seed = static_cast<int>(random() & 0xFFFFFF), period = i % 3 == 0 ? 0 : 96 << (i % 3);
    ASSERT_NEAR(osl::welkin_worley(p.x, p.y, p.z, period, seed),
                law::worley3(glm::vec3(p), period, law::kWorleyEuclidean, unsignedOf(seed)).x, 1e-5f);
    ASSERT_NEAR(osl::welkin_simplex(p.x, p.y, p.z, p.w, period, seed), law::simplex4(p, period, unsignedOf(seed)),
                1e-5f);
  }
}

Hero randomClassic(std::mt19937& random) {
  const auto in = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  Hero hero;
  hero.form.shape = HeroShape::classic;
  hero.cloud.seed = static_cast<int>(random() % 1000);
  hero.form.radiiLow = {in(0, 1), in(0, 1), in(0, 1)};
  hero.form.radiiHigh = {in(0, 1), in(0, 1), in(0, 1)};
  hero.form.breadth = in(0.5f, 2.0f);
  HeroClassic& c = hero.classic;
  c.cloudScale = in(0.5f, 2.0f);
  c.density = in(0.1f, 2.0f);
  c.distortion = in(0.0f, 1.5f);
  c.overallScale = in(0.1f, 1.5f);
  c.worleyInfluence = in(0.0f, 1.5f);
  c.worleyClump = in(0.0f, 1.0f);
  c.wave = in(0.0f, 1.0f);
  c.noiseInfluence = in(0.0f, 1.5f);
  c.noiseScale = in(0.3f, 3.0f);
  c.noiseDetail = 1 + static_cast<int>(random() % 8);
  c.noiseWhisp = in(0.2f, 0.9f);
  c.windStrength = in(0.0f, 30.0f);
  c.windDirection = {in(-1, 1), in(-1, 1), in(-1, 1)};
  c.stationary = in(0.0f, 1.0f);
  c.time = in(0.0f, 300.0f);
  return hero;
}

// As welkin_cloud_noise.osl makes them of its parameters.
float noiseOf(const HeroClassic& c, const HeroForm& form, const glm::vec3& x, const glm::vec3& place, int seed) {
  const float scale = 10.0f / std::sqrt(form.width * form.height) * c.overallScale;
  const glm::vec3 wind =
      glm::length(c.windDirection) > 1e-6f ? glm::normalize(c.windDirection) * (c.windStrength * c.time) : glm::vec3(0);
  const glm::vec3 cells = (x + place * (1.0f - c.stationary) - wind) * scale;
  return osl::welkin_distortion(cells.x, cells.y, cells.z, x.x / (0.5f * form.width), c.time / 60.0f, c.worleyInfluence,
                                c.worleyClump, c.wave, c.noiseInfluence, c.noiseScale, c.noiseDetail, c.noiseWhisp,
                                seed);
}

TEST(Osl, DistortionIsTheLaws) {
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    Hero hero = randomClassic(random);
    hero.cloud.position = {0.0, 0.0, 1200.0};
    const HeroBody body = bakeHero(hero, {}, 1, 1000);
    const law::HeroParams& p = body.params;
    // Where the cloud stands in its own axes.
    const glm::vec3 place(0.0f, 0.0f, 1200.0f);
    for (int i = 0; i < 100; ++i) {
      std::uniform_real_distribution<float> unit(0.0f, 1.0f);
      const glm::vec3 low(p.low), size = glm::vec3(p.high) - low;
      const glm::vec3 x = low + glm::vec3(unit(random), unit(random), unit(random)) * size;
      const float law = 1.5f - law::heroClassicOffset(x, p);
      ASSERT_NEAR(noiseOf(hero.classic, hero.form, x, place, p.seed), law, 1e-3f) << round;
    }
  }
}

TEST(Osl, GradientIsThatOfTheShape) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < 20000; ++i) {
    HeroForm form;
    form.radiiLow = {unit(random), unit(random), unit(random)};
    form.radiiHigh = {unit(random), unit(random), unit(random)};
    const float h = unit(random), scale = 0.5f + unit(random);
    const float found = osl::welkin_gradient(h, scale, form.radiiLow.x, form.radiiLow.y, form.radiiLow.z,
                                             form.radiiHigh.x, form.radiiHigh.y, form.radiiHigh.z);
    ASSERT_NEAR(found, shapeGradient(form, scale, {0.0f, 0.0f, h * form.height}), 1e-5f);
  }
}

// Both nodes together, against the field that everything else asks; its gradient comes from a grid.
TEST(Osl, CloudIsThatOfTheField) {
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    Hero hero = randomClassic(random);
    hero.cloud.position = {0.0, 0.0, 1200.0};
    hero.classic.stationary = 1.0f;
    const DensityField field({.heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    const HeroForm& f = hero.form;
    std::uniform_real_distribution<float> unit(0.02f, 0.98f);
    double squares = 0.0;
    int inside = 0;
    for (int i = 0; i < 1000; ++i) {
      const glm::vec3 share(unit(random), unit(random), unit(random));
      const glm::vec3 x((share.x - 0.5f) * f.width, (share.y - 0.5f) * f.width * f.breadth, share.z * f.height);
      const float gradient = osl::welkin_gradient(share.z, hero.classic.cloudScale, f.radiiLow.x, f.radiiLow.y,
                                                  f.radiiLow.z, f.radiiHigh.x, f.radiiHigh.y, f.radiiHigh.z);
      const float found = osl::welkin_density(share.x, share.y, gradient,
                                              noiseOf(hero.classic, f, x, glm::vec3(0.0f), body.params.seed),
                                              hero.classic.cloudScale, hero.classic.density, hero.classic.distortion);
      // From the cloud's own axes into the world's.
      const glm::dvec3 world = body.origin + glm::dvec3(x.x * body.params.axisX - x.y * body.params.axisY,
                                                        x.x * body.params.axisY + x.y * body.params.axisX, x.z);
      const double law = field.extinction(world) / hero.cloud.extinction;
      squares += (found - law) * (found - law);
      inside += law > 0.0;
      ASSERT_NEAR(found, law, 0.05 * hero.classic.density) << round;
    }
    EXPECT_GT(inside, 30);
    EXPECT_LT(std::sqrt(squares / 1000.0), 0.01 * hero.classic.density);
  }
}

std::string output(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return text;
  char block[4096];
  while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) text.append(block, got);
  const int status = ::pclose(pipe);
  return status == 0 ? text : "FAILED: " + text;
}

// The same shaders through OSL itself: every one compiles, and a probe prints what the law must give.
TEST(Osl, CompiledShadersAreTheLaw) {
  if (output("command -v oslc").starts_with("FAILED") || output("command -v testshade").starts_with("FAILED"))
    GTEST_SKIP() << "oslc and testshade are not installed";
  const std::string folder = testing::TempDir() + "welkin_osl", source = std::string(WELKIN_SOURCE_DIR);
  std::filesystem::create_directories(folder);
  const std::string probe = source + "/tests/osl/probe.osl";
  for (const std::string name : {"welkin_cloud_noise", "welkin_cloud_gradient", "welkin_cloud_main", "probe"}) {
    const std::string file = name == "probe" ? probe : source + "/integrations/osl/" + name + ".osl";
    const std::string said =
        output("oslc -I" + source + "/integrations/osl -o " + folder + "/" + name + ".oso " + file);
    ASSERT_FALSE(said.starts_with("FAILED")) << said;
  }
  std::istringstream lines(output("cd " + folder + " && testshade -g 1 1 probe"));
  int hashes = 0, noises = 0, clouds = 0;
  for (std::string word; lines >> word;) {
    if (word == "HASH") {
      int i = 0, hash = 0;
      lines >> i >> hash;
      EXPECT_EQ(unsignedOf(hash), law::hashUint(unsignedOf(i * 7919)));
      ++hashes;
    } else if (word == "NOISE") {
      glm::vec4 p;
      float worley = 0.0f, simplex = 0.0f;
      lines >> p.x >> p.y >> p.z >> p.w >> worley >> simplex;
      EXPECT_NEAR(worley, law::worley3(glm::vec3(p), 96, law::kWorleyEuclidean, 5u).x, 1e-4f);
      EXPECT_NEAR(simplex, law::simplex4(p, 96, 5u), 1e-4f);
      ++noises;
    } else if (word == "CLOUD") {
      glm::vec3 p;
      float distortion = 0.0f, gradient = 0.0f, density = 0.0f;
      lines >> p.x >> p.y >> p.z >> distortion >> gradient >> density;
      EXPECT_NEAR(distortion,
                  osl::welkin_distortion(p.x, p.y, p.z, 0.3f, 0.7f, 0.7f, 0.5f, 0.25f, 0.7f, 1.0f, 5, 0.5f, 9), 1e-3f);
      EXPECT_NEAR(gradient, osl::welkin_gradient(0.1f * p.z, 1.2f, 0.85f, 0.95f, 0.8f, 0.62f, 0.5f, 0.0f), 1e-4f);
      EXPECT_NEAR(density, osl::welkin_density(0.1f * p.x, 0.1f * p.y, gradient, distortion, 1.2f, 0.8f, 0.6f), 1e-4f);
      ++clouds;
    }
  }
  EXPECT_EQ(hashes, 500);
  EXPECT_EQ(noises, 500);
  EXPECT_EQ(clouds, 500);
}

}  // namespace
}  // namespace welkin
