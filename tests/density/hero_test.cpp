// Hero clouds: bounds, place, life, and the formulas that they are said to follow.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "welkin/density/cloud_cache.hpp"
#include "welkin/density/hero_bounds.hpp"
#include "welkin/density/hero_grid.hpp"
#include "welkin/density/hero_shape.hpp"

namespace welkin {
namespace {

Hero ofShape(HeroShape shape) {
  Hero hero;
  hero.form.shape = shape;
  return hero;
}

// Every species, the shapes that no species has, and the ages in between.
std::vector<Hero> allHeroes() {
  std::vector<Hero> heroes;
  for (std::size_t i = 0; i < ChoiceNames<HeroSpecies>::names.size(); ++i)
    heroes.push_back(heroPreset(static_cast<HeroSpecies>(i)));
  for (const HeroShape shape : {HeroShape::curve, HeroShape::ellipsoid, HeroShape::classic})
    heroes.push_back(ofShape(shape));
  heroes.back().classic.wave = 0.5f;
  for (const float age : {0.15f, 0.6f, 0.9f}) {
    heroes.push_back(heroPreset(HeroSpecies::incus));
    heroes.back().cloud.age = age;
  }
  return heroes;
}

glm::dvec3 randomPoint(const HeroBody& body, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  const glm::dvec3 low = body.lowest(), size = body.highest() - low;
  return low + glm::dvec3(unit(random), unit(random), unit(random)) * size;
}

class Heroes : public testing::TestWithParam<std::size_t> {};

TEST_P(Heroes, BoundsHoldEverySample) {
  Hero hero = allHeroes().at(GetParam());
  hero.cloud.heading = 0.7f;
  hero.cloud.position += glm::dvec3(3000.0, -2000.0, 0.0);
  const CloudCache cache = bakeCloudCache({.drift = {8.0f, 1.0f, 300.0}, .seed = 5, .heroes = std::span(&hero, 1)}, {},
                                          {1234.0, -777.0, 150.0}, {.cells = 40, .cellLayers = 24});
  std::mt19937 random(11);
  std::size_t inCloud = 0, empty = 0;
  const int samples = 60000;
  for (int i = 0; i < samples; ++i) {
    const glm::vec3 p(randomPoint(cache.heroes[0].body, random) - glm::dvec3(1234.0, -777.0, 0.0));
    const float sigma = extinctionIn(cache, p), most = majorantAt(cache.majorants, p);
    ASSERT_GE(sigma, 0.0f);
    ASSERT_LE(sigma, most) << p.x << " " << p.y << " " << p.z;
    inCloud += sigma > 0.0f;
    empty += most == 0.0f;
  }
  EXPECT_GT(inCloud, static_cast<std::size_t>(samples) / 300);
  EXPECT_GT(empty, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, Heroes, testing::Range(std::size_t{0}, allHeroes().size()));

// The control: bounds of a cloud with shallower billows are no bounds of this one.
TEST(Hero, BoundsOfAnotherCloudAreExceeded) {
  const HeroBody body = bakeHero(heroPreset(HeroSpecies::mediocris), {}, 1);
  const Volume tile = bakeHeroBillows();
  const TexelBounds billows(tile.view(), 0, TexelBounds::Kind::volume);
  const law::HeroParams right = body.paramsAt({0.0, 0.0});
  law::HeroParams wrong = right;
  wrong.billow *= 0.5f;
  wrong.reach *= 0.5f;
  const HeroBounds bounds(right, *body.parts, body.shapeView(), billows);
  const HeroBounds others(wrong, *body.parts, body.shapeView(), billows);
  std::mt19937 random(3);
  int exceeded = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 p(randomPoint(body, random));
    const float sigma = law::heroExtinction(p, 0.0f, right, *body.parts, body.shapeView(), tile.view());
    ASSERT_LE(sigma, bounds.extinctionIn(p - 4.0f, p + 4.0f));
    exceeded += sigma > others.extinctionIn(p - 4.0f, p + 4.0f);
  }
  EXPECT_GT(exceeded, 20);
}

// The kernels' answer is the scalar law's, and the cache's is the field's.
TEST(Hero, TheFieldIsTheLaw) {
  const std::vector<Hero> heroes = allHeroes();
  const Volume tile = bakeHeroBillows();
  for (const Hero& hero : heroes) {
    const DensityField field({.seed = 2, .heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    std::mt19937 random(7);
    std::vector<glm::dvec3> points;
    points.reserve(2000);
    for (int i = 0; i < 2000; ++i) points.push_back(randomPoint(body, random));
    const std::vector<float> found = field.extinction(points);
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float law =
          law::heroExtinction(glm::vec3(points[i] - glm::dvec3(glm::dvec2(points[0]), 0.0)), 0.0f,
                              body.paramsAt(glm::dvec2(points[0])), *body.parts, body.shapeView(), tile.view());
      difference += std::abs(law - found[i]);
      sum += law;
    }
    ASSERT_GT(sum, 0.0);
    EXPECT_LT(difference / sum, 2e-4) << ChoiceNames<HeroSpecies>::names[static_cast<std::size_t>(hero.cloud.species)];
  }
}

TEST(Hero, StandsWhereItIsPutAndTurnsWithItsHeading) {
  Hero hero = heroPreset(HeroSpecies::mediocris);
  const DensityField east({.heroes = std::span(&hero, 1)});
  hero.cloud.heading = 0.0f;
  hero.cloud.position += glm::dvec3(5000.0, -300.0, 40.0);
  const DensityField north({.heroes = std::span(&hero, 1)});
  std::mt19937 random(5);
  double sum = 0.0, difference = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 p = randomPoint(east.heroes().front(), random);
    // East becomes north, north becomes west.
    const glm::dvec3 q(5000.0 - p.y, -300.0 + p.x, p.z + 40.0);
    const float a = east.extinction(p), b = north.extinction(q);
    sum += a;
    difference += std::abs(a - b);
  }
  ASSERT_GT(sum, 0.0);
  EXPECT_LT(difference / sum, 1e-3);
}

TEST(Hero, TheWindCarriesItsShare) {
  Hero hero = heroPreset(HeroSpecies::humilis);
  hero.cloud.drift = 0.5f;
  const Drift wind{10.0f, 4.7123890f, 100.0};  // from the west
  const HeroBody body = bakeHero(hero, wind, 1, 1000);
  EXPECT_NEAR(body.origin.x, 500.0, 1e-3);
  EXPECT_NEAR(body.origin.y, 0.0, 1e-3);
}

// Nothing at either end of its life, most in between, and no jumps on the way.
TEST(Hero, LivesSmoothly) {
  std::vector<glm::dvec3> points;
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x) points.emplace_back(-9500.0 + 1000.0 * x, -9500.0 + 1000.0 * y, 1300.0 + 500.0 * z);
  const auto water = [&](float age) {
    Hero hero = heroPreset(HeroSpecies::incus);
    hero.cloud.age = age;
    double sum = 0.0;
    for (const float sigma : DensityField({.heroes = std::span(&hero, 1)}).extinction(points)) sum += sigma;
    return sum;
  };
  const double most = water(0.75f);
  EXPECT_EQ(water(0.0f), 0.0);
  EXPECT_EQ(water(1.0f), 0.0);
  EXPECT_LT(water(0.15f), 0.3 * most);
  EXPECT_LT(water(0.92f), 0.7 * most);
  for (const float age : {0.1f, 0.25f, 0.3f, 0.4f, 0.46f, 0.55f, 0.7f, 0.82f, 0.9f})
    EXPECT_NEAR(water(age + 0.002f), water(age), 0.025 * most) << age;
}

TEST(Hero, AgesWithTime) {
  Hero hero = heroPreset(HeroSpecies::congestus);
  hero.cloud.age = 0.1f;
  hero.cloud.lifetime = 1000.0f;
  const glm::dvec3 inside(0.0, 0.0, 2800.0);
  DensityField field({.heroes = std::span(&hero, 1)});
  EXPECT_EQ(field.extinction(inside), 0.0f);
  field.setDrift({0.0f, 0.0f, 500.0});
  EXPECT_GT(field.extinction(inside), 0.0f);
  field.setDrift({0.0f, 0.0f, 2000.0});
  EXPECT_EQ(field.extinction(inside), 0.0f);
}

// 003 eq. 3.2: without distortion the classic cloud is the shape gradient times the density.
TEST(Hero, ClassicIsTheShapeGradient) {
  Hero hero = ofShape(HeroShape::classic);
  hero.classic.distortion = 0.0f;
  hero.classic.density = 0.5f;
  hero.classic.cloudScale = 1.2f;
  const DensityField field({.heroes = std::span(&hero, 1)});
  std::mt19937 random(9);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = randomPoint(field.heroes().front(), random);
    const float gradient = shapeGradient(hero.form, 1.2f, glm::vec3(p) - glm::vec3(0.0f, 0.0f, 1200.0f));
    EXPECT_NEAR(field.extinction(p) / (0.5f * hero.cloud.extinction), std::max(gradient, 0.0f),
                0.025f);  // the grid cuts kinks
  }
}

// Its offset lies between .5 and 1.5, as 003 ch. 3.3 asks for.
TEST(Hero, ClassicOffsetVariesAboutOne) {
  const HeroBody body = bakeHero(ofShape(HeroShape::classic), {}, 1, 1000);
  double sum = 0.0, least = 9.0, most = 0.0;
  std::mt19937 random(1);
  const int samples = 4000;
  for (int i = 0; i < samples; ++i) {
    const float offset = law::heroClassicOffset(glm::vec3(randomPoint(body, random)), body.params);
    sum += offset;
    least = std::min<double>(least, offset);
    most = std::max<double>(most, offset);
  }
  EXPECT_NEAR(sum / samples, 1.0, 0.15);
  EXPECT_GE(least, 0.5);
  EXPECT_LE(most, 1.5);
  EXPECT_GT(most - least, 0.4);
}

TEST(Hero, GradationPassesItsRadiiAndStaysBetweenThem) {
  HeroForm form;
  form.radiiLow = {0.5f, 0.9f, 0.3f};
  form.radiiHigh = {0.3f, 0.7f, 0.0f};
  const float radii[] = {0.5f, 0.9f, 0.3f, 0.3f, 0.7f, 0.0f};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(gradation(form, 0.2f * static_cast<float>(i)), radii[i], 1e-3f);
  for (int i = 0; i <= 1000; ++i) {
    const float h = static_cast<float>(i) / 1000.0f, at = std::min(5.0f * h, 4.999f);
    const float a = radii[static_cast<int>(at)], b = radii[static_cast<int>(at) + 1];
    EXPECT_GE(gradation(form, h), std::min(a, b) - 1e-4f) << h;
    EXPECT_LE(gradation(form, h), std::max(a, b) + 1e-4f) << h;
  }
}

const char* nameOf(const Hero& hero) {
  return ChoiceNames<HeroSpecies>::names[static_cast<std::size_t>(hero.cloud.species)].data();
}

// The error of the base grid itself: how far its depths lie from those of the balls, near the surface, in m.
TEST(Hero, TheShapesGridIsGoodToAFractionOfItsCell) {
  for (const HeroSpecies species : {HeroSpecies::humilis, HeroSpecies::mediocris, HeroSpecies::congestus,
                                    HeroSpecies::calvus, HeroSpecies::incus, HeroSpecies::altocumulus_castellanus}) {
    const Hero hero = heroPreset(species);
    const HeroBody body = bakeHero(hero, {}, 1);
    const HeroSolid solid = heroSolid(hero.form, hero.surface.taper, heroLife(hero.cloud.age),
                                      static_cast<std::uint32_t>(body.params.seed));
    const glm::vec3 low(body.params.low), size = glm::vec3(body.params.high) - low;
    const float cell = size.x / static_cast<float>(body.shape->width);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit;
    double squares = 0.0, worst = 0.0;
    int near = 0;
    for (int i = 0; i < 60000; ++i) {
      const glm::vec3 share(unit(random), unit(random), unit(random));
      const float exact = depthIn(solid, low + share * size).w;
      if (std::abs(exact) > 2.0f * cell) continue;
      const double error = law::sample3(body.shapeView(), share).w - exact;
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      ++near;
    }
    ASSERT_GT(near, 300) << nameOf(hero);
    const double error = std::sqrt(squares / near);
    std::printf("%-24s cells of %5.1f m: %5.2f m root mean square, %5.1f m at worst, under billows of %.0f m\n",
                nameOf(hero), cell, error, worst, body.params.billow);
    EXPECT_LT(error, 0.15 * cell) << nameOf(hero);  // trilinear filtering of a smooth function with creases
    EXPECT_GT(error, 1e-3 * cell) << nameOf(hero);  // it is a grid
  }
}

// Along a ray, the way to the first point of half the extinction, or -1.
template <class Extinction>
double wayToSurface(const glm::dvec3& from, const glm::dvec3& way, double length, double step, double half,
                    const Extinction& extinction) {
  for (double t = 0.0; t < length; t += step) {
    if (extinction(from + t * way) < half) continue;
    double out = std::max(t - step, 0.0), in = t;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (out + in);
      (extinction(from + middle * way) < half ? out : in) = middle;
    }
    return in;
  }
  return -1.0;
}

// The error of the real-time renderer's voxels: how far their surface lies from that of the law, in m along a ray.
TEST(Hero, TheVoxelsSurfaceLiesWithinAVoxel) {
  for (const HeroSpecies species : {HeroSpecies::humilis, HeroSpecies::mediocris, HeroSpecies::congestus,
                                    HeroSpecies::lenticularis, HeroSpecies::mammatus}) {
    const Hero hero = heroPreset(species);
    const PlacedGrid grid = heroGrid(hero, 0.0, 1);
    const double voxel = grid.voxels->voxel().x;
    const DensityField field({.heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    const double half = 0.4 * body.params.high.w;
    const glm::dvec3 low = body.lowest(), size = body.highest() - low;
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit;
    std::vector<double> errors;
    int rays = 0;
    for (int i = 0; i < 400; ++i) {
      // From the south, as a camera looks.
      const glm::dvec3 from = low + glm::dvec3(unit(random), 0.0, unit(random)) * size;
      const auto way = [&](const auto& extinction) {
        return wayToSurface(from, {0.0, 1.0, 0.0}, size.y, 0.25 * voxel, half, extinction);
      };
      const double exact = way([&](const glm::dvec3& p) { return field.extinction(p); });
      const double baked = way([&](const glm::dvec3& p) { return grid.at(p); });
      if (exact < 0.0) continue;
      ++rays;
      // Beyond ten voxels one of them has met another part of the cloud.
      if (baked >= 0.0 && std::abs(baked - exact) < 10.0 * voxel) errors.push_back(std::abs(baked - exact));
    }
    ASSERT_GT(errors.size(), 60u) << nameOf(hero);
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2], most = errors[errors.size() * 9 / 10];
    const double same = static_cast<double>(errors.size()) / rays;
    std::printf(
        "%-24s voxels of %5.1f m: surface %5.2f m off in the median, 9 of 10 within %5.1f m, %.0f %% of rays meet "
        "the same part\n",
        nameOf(hero), voxel, median, most, 100.0 * same);
    EXPECT_LT(median, 0.5 * voxel) << nameOf(hero);
    EXPECT_GT(same, 0.9) << nameOf(hero);
  }
}

// What replaces octaves that are too fine.
TEST(Hero, TheMeanOfTheBillowsIsTheirMean) {
  const Volume tile = bakeHeroBillows();
  double sum = 0.0;
  for (const float b : tile.texels) sum += b;
  EXPECT_NEAR(sum / static_cast<double>(tile.texels.size()), law::kHeroBillowMean, 0.005);
}

TEST(Hero, AFootprintKeepsTheWater) {
  const Hero hero = heroPreset(HeroSpecies::congestus);
  const DensityField field({.heroes = std::span(&hero, 1)});
  std::mt19937 random(4);
  std::vector<glm::dvec3> points;
  points.reserve(20000);
  for (int i = 0; i < 20000; ++i) points.push_back(randomPoint(field.heroes().front(), random));
  const auto total = [&](float footprint) {
    double sum = 0.0;
    for (const float sigma : field.extinction(points, footprint)) sum += sigma;
    return sum;
  };
  const double exact = total(0.0f);
  EXPECT_NEAR(total(60.0f) / exact, 1.0, 0.05);
  EXPECT_NE(total(60.0f), exact);
}

TEST(Hero, VoxelsHoldTheSameWater) {
  const Hero hero = heroPreset(HeroSpecies::mediocris);
  const PlacedGrid grid = heroGrid(hero, 0.0, 1, 2e5);
  const DensityField field({.heroes = std::span(&hero, 1)});
  std::mt19937 random(4);
  double exact = 0.0, baked = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = randomPoint(field.heroes().front(), random);
    exact += field.extinction(p);
    baked += grid.at(p);
  }
  EXPECT_NEAR(baked / exact, 1.0, 0.03);
}

TEST(Hero, ASpeciesKeepsThePlace) {
  Hero hero;
  hero.cloud.position = {5.0, 6.0, 7.0};
  hero.cloud.heading = 1.0f;
  hero.cloud.seed = 9;
  hero.cloud.scale = 2.0f;
  setSpecies(hero, HeroSpecies::incus);
  EXPECT_EQ(glm::dvec2(hero.cloud.position), glm::dvec2(5.0, 6.0));
  EXPECT_EQ(hero.cloud.seed, 9);
  EXPECT_EQ(hero.cloud.scale, 2.0f);
  EXPECT_GT(hero.form.anvil, 0.0f);
}

}  // namespace
}  // namespace welkin
