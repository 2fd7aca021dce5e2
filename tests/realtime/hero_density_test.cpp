// The density of hero clouds of random parameters at random points: the law in GLSL and in the field's lanes, from the
// same grid of the smooth shape; and the voxels of the real-time renderer, as the GPU and the CPU filter them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/scene/random_scene.hpp"
#include "welkin/density/field.hpp"
#include "welkin/density/hero_grid.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/grid_atlas.hpp"
#include "welkin/realtime/noise_textures.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {
namespace {

constexpr int kSide = 64;
constexpr std::size_t kPoints = kSide * kSide;
constexpr std::size_t kShapes = ChoiceNames<HeroShape>::names.size();

// Every parameter anywhere on its slider.
Hero randomHero(HeroShape shape, std::mt19937& random) {
  Scene scene;
  scene.heroes.resize(1);
  for (const Section& section : sectionsOf(scene))
    if (section.path.starts_with("hero."))
      for (Field f : section.fields) {
        f.hard = f.soft;
        if (f.name != std::string_view("species")) assign(scene, section, f, welkin::test::randomValue(f, random));
      }
  Hero hero = scene.heroes.front();
  hero.form.shape = shape;
  hero.cloud.age = 0.3f + 0.5f * hero.cloud.age;  // grown
  hero.cloud.extinction += 0.01f;
  hero.classic.density += 0.1f;
  return alone(hero);
}

// A program that answers floats at points.
class Asked {
 public:
  Asked() : gl_(gl::loadApi(context_.loader())), framebuffer_(gl_), vertices_(gl_), out_(plane(nullptr)) {}

  const gl::Api& gl() const { return gl_; }

  template <class Bind>
  std::vector<float> answers(const gl::Program& program, const std::vector<glm::dvec3>& points, const Bind& bind) {
    std::vector<glm::vec4> places;
    for (const glm::dvec3& p : points) places.emplace_back(p, 0.0);
    const gl::Texture asked = plane(places.data());
    const gl::Texture* targets[] = {&out_};
    framebuffer_.target(targets);
    gl_.UseProgram(program.id());
    texture(program, "uPoints", 0, asked);
    bind();
    gl_.BindVertexArray(vertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<glm::vec4> texels(kPoints);
    gl_.ReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_FLOAT, texels.data());
    gl_.check("asking for densities");
    std::vector<float> found;
    for (const glm::vec4& t : texels) found.push_back(t.x);
    return found;
  }

  void texture(const gl::Program& program, const char* name, int unit, const gl::Texture& texture) const {
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_.BindTexture(texture.target(), texture.id());
    gl_.Uniform1i(program.uniform(name), unit);
  }

 private:
  gl::Texture plane(const void* texels) const {
    return {gl_, gl::Texture::Kind::plane, gl::kRgba32F,          kSide, kSide,
            0,   gl::Filter::nearest,      gl::Addressing::clamp, texels};
  }
  gl::Context context_;
  gl::Api gl_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray vertices_;
  gl::Texture out_;
};

gl::Program programOf(const gl::Api& gl, const std::string& name, const std::string& declarations,
                      const std::string& answer) {
  std::string text = "precision highp sampler3D;\n";
  for (const char* file : {"base/law.glsl", "noise/hash.glsl", "noise/lattice.glsl", "noise/perlin.glsl",
                           "noise/simplex.glsl", "noise/worley.glsl", "noise/fbm.glsl", "noise/curl.glsl",
                           "density/scatter.glsl", "density/hero.glsl", "realtime/grid.glsl"})
    text += std::string("#include \"welkin/") + file + "\"\n";
  text += declarations +
          "uniform sampler2D uPoints;\nout vec4 oResult;\nvoid main() {\n"
          "  vec3 p = texelFetch(uPoints, ivec2(gl_FragCoord.xy), 0).xyz;\n  oResult = vec4(" +
          answer + ");\n}\n";
  return {gl, name, "", text, shaderSource};
}

std::vector<glm::dvec3> pointsIn(const glm::dvec3& low, const glm::dvec3& high, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<glm::dvec3> points(kPoints);
  // Their places are floats from the anchor, so that every reading is asked at the same ones.
  for (glm::dvec3& p : points) p = glm::vec3(low + glm::dvec3(unit(random), unit(random), unit(random)) * (high - low));
  return points;
}

// How far answers lie from the law, as shares of the full extinction, smallest first.
struct Errors {
  std::vector<double> plain;
  // Beyond what the law itself answers within kReached of the point: a float's place in a cloud of kilometres is known
  // to a tenth of a millimetre, and an edge of a few metres makes 1e-4 of that.
  std::vector<double> beyond;
  std::size_t inCloud = 0;

  void add(double found, double expected, double least, double most, double scale) {
    if (found == 0.0 && expected == 0.0) return;  // clear air tells nothing
    plain.push_back(std::abs(found - expected) / scale);
    beyond.push_back(std::max({least - found, found - most, 0.0}) / scale);
    inCloud += expected > 0.0;
  }
  void sort() {
    std::sort(plain.begin(), plain.end());
    std::sort(beyond.begin(), beyond.end());
  }
  double share(double which) const { return plain[static_cast<std::size_t>(which * double(plain.size() - 1))]; }
};

constexpr double kReached = 5e-7;  // of the largest coordinate: four steps of a float's

// The law's answers at points, and their extremes over neighbours on each axis.
template <class Law>
Errors errorsOf(const std::vector<glm::dvec3>& points, const std::vector<float>& found, double scale, const Law& law) {
  const std::vector<float> expected = law(points);
  std::vector<float> least = expected, most = expected;
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-1.0, 1.0}) {
      std::vector<glm::dvec3> moved = points;
      for (glm::dvec3& p : moved) p[axis] += way * kReached * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      const std::vector<float> there = law(moved);
      for (std::size_t i = 0; i < there.size(); ++i) {
        least[i] = std::min(least[i], there[i]);
        most[i] = std::max(most[i], there[i]);
      }
    }
  Errors errors;
  for (std::size_t i = 0; i < points.size(); ++i) errors.add(found[i], expected[i], least[i], most[i], scale);
  errors.sort();
  return errors;
}

const char* nameOf(HeroShape shape) { return ChoiceNames<HeroShape>::names[static_cast<std::size_t>(shape)].data(); }

// The question of the law itself.
class HeroLaw {
 public:
  explicit HeroLaw(Asked& asked)
      : asked_(asked), program_(programOf(asked.gl(), "hero density",
                                          "layout(std140) uniform Hero { HeroParams uHero; };\n"
                                          "layout(std140) uniform Parts { HeroParts uParts; };\n"
                                          "uniform sampler3D uShape, uBillows;\n",
                                          "heroExtinction(p, 0.0, uHero, uParts, uShape, uBillows)")),
        billows_(textureFromVolume(asked.gl(), bakeHeroBillows())), params_(asked.gl()), parts_(asked.gl()) {
    program_.bindBlock("Hero", 0);
    program_.bindBlock("Parts", 1);
  }

  std::vector<float> operator()(const HeroBody& body, const std::vector<glm::dvec3>& points) {
    const law::HeroParams p = body.paramsAt({0.0, 0.0});
    params_.upload(&p, sizeof p);
    parts_.upload(body.parts.get(), sizeof *body.parts);
    const Volume& shape = *body.shape;
    const gl::Texture smooth(asked_.gl(), gl::Texture::Kind::volume, gl::kRgba16F, shape.width, shape.height,
                             shape.depth, gl::Filter::linear, gl::Addressing::clamp, shape.texels.data());
    return asked_.answers(program_, points, [&] {
      params_.bind(0);
      parts_.bind(1);
      asked_.texture(program_, "uShape", 1, smooth);
      asked_.texture(program_, "uBillows", 2, billows_);
    });
  }

 private:
  Asked& asked_;
  gl::Program program_;
  gl::Texture billows_;
  gl::UniformBuffer params_, parts_;
};

TEST(HeroDensity, GlslIsTheFieldForRandomParameters) {
  Asked asked;
  HeroLaw glsl(asked);
  std::mt19937 random(5);
  for (std::size_t i = 0; i < 2 * kShapes; ++i) {
    Hero hero = randomHero(static_cast<HeroShape>(i % kShapes), random);
    hero.cloud.position = {0.0, 0.0, 800.0};
    const DensityField field({.drift = {8.0f, 1.0f, 0.0}, .seed = 3, .heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    const std::vector<glm::dvec3> points = pointsIn(body.lowest(), body.highest(), random);
    const Errors errors = errorsOf(points, glsl(body, points), body.params.high.w,
                                   [&](const std::vector<glm::dvec3>& at) { return field.extinction(at); });
    std::printf(
        "%-10s size %6.0f m, edge %3.0f m, %4zu in cloud: 9 of 10 within %.1e, worst %.1e, beyond rounding %.1e\n",
        nameOf(hero.form.shape), body.params.place.w, body.params.edge, errors.inCloud, errors.share(0.9),
        errors.plain.back(), errors.beyond.back());
    EXPECT_GT(errors.inCloud, 20u);
    EXPECT_LT(errors.share(0.9), 1e-4);
    EXPECT_LT(errors.beyond.back(), 1e-4);
  }
}

// As close to each other as they can stand.
HeroScatter crowd() { return {.radius = 30000.0f, .spacing = 0.0f, .share = 1.0f, .variation = 0.2f, .turn = 0.6f}; }

std::vector<glm::dvec3> pointsAmong(const glm::dvec3& low, const glm::dvec3& high, std::mt19937& random) {
  const glm::dvec3 middle = 0.5 * (low + high), half = glm::dvec3(0.5, 0.5, 1.0) * (high - middle);
  return pointsIn(middle - half, middle + half, random);
}

TEST(HeroDensity, GlslScattersAsTheField) {
  Asked asked;
  HeroLaw glsl(asked);
  std::mt19937 random(8);
  for (const HeroSpecies species : {HeroSpecies::mediocris, HeroSpecies::lenticularis}) {
    Hero hero = heroPreset(species);
    hero.cloud.position = {300.0, -200.0, 800.0};
    hero.scatter = crowd();
    const DensityField field({.seed = 3, .heroes = std::span(&hero, 1)});
    const HeroBody& body = field.heroes().front();
    const std::vector<glm::dvec3> points = pointsAmong(body.lowest(), body.highest(), random);
    const Errors errors = errorsOf(points, glsl(body, points), body.params.high.w,
                                   [&](const std::vector<glm::dvec3>& at) { return field.extinction(at); });
    EXPECT_GT(errors.inCloud, 60u);
    EXPECT_LT(errors.share(0.9), 1e-3);  // 30 km away a float's step is 2 mm, and the edge 10 m
    EXPECT_LT(errors.beyond.back(), 1e-3);
  }
}

// The control: another seed is another cloud.
TEST(HeroDensity, AnotherSeedIsAnotherDensity) {
  Asked asked;
  HeroLaw glsl(asked);
  std::mt19937 random(5);
  Hero hero, other;
  other.cloud.seed = 1;
  const DensityField field({.heroes = std::span(&hero, 1)});
  const HeroBody wrong = bakeHero(other, {}, 1);
  const HeroBody& body = field.heroes().front();
  const std::vector<glm::dvec3> points = pointsIn(body.lowest(), body.highest(), random);
  const Errors errors = errorsOf(points, glsl(wrong, points), body.params.high.w,
                                 [&](const std::vector<glm::dvec3>& at) { return field.extinction(at); });
  EXPECT_GT(errors.share(0.9), 0.5);
}

// What the real-time renderer draws: its voxels, filtered by the GPU and by the CPU.
TEST(HeroDensity, TheVoxelsOnTheGpuAreThoseOfTheCpu) {
  Asked asked;
  const gl::Api& gl = asked.gl();
  const gl::Program program = programOf(
      gl, "voxels", "layout(std140) uniform Grid { GridParams uGrid; };\nuniform sampler3D uIndex, uBricks;\n",
      "max(gridExtinction(uGrid.scatter.place.w > 0.0 ? scatteredPoint(p, uGrid.scatter) : p, uGrid, uIndex, "
      "uBricks).x, 0.0)");
  program.bindBlock("Grid", 0);
  gl::UniformBuffer params(gl);
  std::mt19937 random(6);
  for (std::size_t i = 0; i <= kShapes; ++i) {
    const bool many = i == kShapes;
    Hero hero = many ? heroPreset(HeroSpecies::mediocris) : randomHero(static_cast<HeroShape>(i), random);
    hero.cloud.position = {0.0, 0.0, 800.0};
    if (many) hero.scatter = crowd();
    PlacedGrid grid = heroGrid(hero, 0.0, 3, 4e5);
    auto halves = std::make_shared<VoxelGrid>(*grid.voxels);
    // As the texture holds them.
    const glm::ivec3 n = halves->dims();
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) halves->set({x, y, z}, roundedToHalf(halves->at({x, y, z})));
    grid.voxels = halves;
    const WorldBox box = boundsOf(grid);
    const std::vector<glm::dvec3> points = (many ? pointsAmong : pointsIn)(box.low, box.high, random);
    const GridAtlas atlas(gl, std::span(&grid, 1));
    const law::GridParams p = atlas.params(0, {0.0, 0.0});
    params.upload(&p, sizeof p);
    const std::vector<float> found = asked.answers(program, points, [&] {
      params.bind(0);
      asked.texture(program, "uIndex", 1, atlas.index());
      asked.texture(program, "uBricks", 2, atlas.bricks());
    });
    const Errors errors = errorsOf(points, found, halves->maximum(), [&](const std::vector<glm::dvec3>& at) {
      std::vector<float> answers;
      for (const glm::dvec3& q : at) answers.push_back(grid.at(q));
      return answers;
    });
    std::printf("%-10s voxels of %3.0f m, %4zu in cloud: worst %.1e\n", nameOf(hero.form.shape), halves->voxel().x,
                errors.inCloud, errors.plain.back());
    EXPECT_GT(errors.inCloud, 30u);
    EXPECT_LT(errors.plain.back(), 1e-4);
  }
}

}  // namespace
}  // namespace welkin::realtime
