// The path tracer against closed forms, quadrature and published radiances.
#include <gtest/gtest.h>

#include <cmath>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/error.hpp"
#include "welkin/light/law.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::trace {
namespace {

const CloudCacheExtent kCoarse{.weather = {.texels = 256}, .cells = 64, .cellLayers = 32};

struct Mean {
  glm::dvec3 value{0.0};
  double error = 0.0;  // standard error of the luminance
};

// Of all pixels, whose samples are independent.
Mean meanOf(const TraceLayers& layers) {
  Mean mean;
  const double n = static_cast<double>(layers.variance.pixels.size());
  for (std::size_t i = 0; i < layers.variance.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) mean.value[c] += layers.radiance.pixels[3 * i + static_cast<std::size_t>(c)] / n;
    mean.error += layers.variance.pixels[i];
  }
  mean.error = std::sqrt(mean.error) / n;
  return mean;
}
double luminanceOf(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

TraceLayers trace(const Scene& scene, const TraceSettings& settings) {
  PathTracer tracer(scene, {}, settings);
  EXPECT_TRUE(tracer.run({}));
  EXPECT_EQ(tracer.statistics().overBound, 0u);
  EXPECT_EQ(tracer.statistics().notFinite, 0u);
  return tracer.layers();
}

Scene withoutAir() {
  Scene scene;
  scene.atmosphere.rayleigh = scene.atmosphere.mie = scene.atmosphere.ozone = 0.0f;
  return scene;
}

// Hillaire's atmosphere without clouds: references.md section 5, by Monte Carlo with all orders, +-20e-6 per unit
// irradiance.
struct SkyCase {
  const char* name;
  double sunZenith, viewZenith, viewAzimuth;  // degrees; azimuth from the sun's
  glm::dvec3 radiance;
};
class ClearSky : public testing::TestWithParam<SkyCase> {};

TEST_P(ClearSky, HasThePublishedRadiance) {
  const SkyCase& c = GetParam();
  Scene scene;
  scene.layers.clear();
  scene.atmosphere.coefficients = AirCoefficients::hillaire;
  scene.ground.albedo = glm::vec3(0.0f);
  scene.sun.elevation = static_cast<float>((90.0 - c.sunZenith) * kDegree);
  scene.sun.azimuth = 0.0f;
  scene.camera.position = {0.0, 0.0, 200.0};
  scene.camera.heading = static_cast<float>(c.viewAzimuth * kDegree);
  scene.camera.pitch = static_cast<float>((90.0 - c.viewZenith) * kDegree);
  scene.camera.fov = static_cast<float>(0.5 * kDegree);
  const TraceLayers layers = trace(scene, {.width = 32, .height = 32, .samples = 256, .sunDisc = SunDisc::leftOut});
  const Mean mean = meanOf(layers);
  const glm::dvec3 found = mean.value / glm::dvec3(kSunIrradiance);
  const double ours = luminanceOf(found), theirs = luminanceOf(c.radiance);
  // The irradiance's colour is near white, so its relative standard error is that of the luminance.
  const double share = mean.error / luminanceOf(mean.value);
  EXPECT_LT(share, 0.02);
  // Four standard errors, theirs, and what the transmittance table is off (3e-3).
  EXPECT_NEAR(ours, theirs, 4.0 * share * theirs + 20e-6 + 3e-3 * theirs) << ours << " " << theirs;
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], c.radiance[i], 6.0 * share * c.radiance[i] + 20e-6 + 3e-3 * c.radiance[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(References, ClearSky,
                         testing::Values(SkyCase{"zenith", 60, 0, 0, {.003471, .007653, .018794}},
                                         SkyCase{"toward", 60, 60, 0, {.039695, .047139, .067893}},
                                         SkyCase{"across", 60, 60, 90, {.005855, .012916, .030748}},
                                         SkyCase{"away", 60, 60, 180, {.006739, .014815, .034388}},
                                         SkyCase{"low", 85, 85, 90, {.017915, .021637, .020577}}),
                         [](const auto& one) { return one.param.name; });

// A white furnace: droplets and a ground that absorb nothing under a sky of the same radiance everywhere.
TEST(PathTracer, InUniformLightNothingIsSeen) {
  Scene scene = withoutAir();
  scene.atmosphere.model = SkyKind::gradient;
  scene.atmosphere.gradientHorizon = scene.atmosphere.gradientZenith = glm::vec3(2.0f);
  scene.atmosphere.gradientGlow = glm::vec3(0.0f);
  scene.sun.elevation = static_cast<float>(-60.0 * kDegree);
  scene.ground.albedo = glm::vec3(1.0f);
  const TraceLayers layers = trace(scene, {.width = 32, .height = 18, .samples = 64, .clouds = kCoarse});
  const Mean mean = meanOf(layers);
  double clear = 0.0;
  for (const float t : layers.transmittance.pixels) clear += t / (32.0 * 18.0);
  EXPECT_LT(clear, 0.9);  // there are clouds to be seen
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.value[c], 2.0, 4.0 * mean.error + 1e-4);
  // No path may be worth much more than another: roulette of long ones made it 0.0047.
  EXPECT_LT(mean.error, 0.003);
}

// The same furnace under a sky that the library's user paints.
TEST(PathTracer, TakesASkyOfTheUsersOwn) {
  class Even : public SkyModel {
   public:
    glm::vec3 radiance(const glm::vec3&) const override { return glm::vec3(3.0f); }
  };
  Scene scene = withoutAir();
  scene.sun.elevation = static_cast<float>(-60.0 * kDegree);
  scene.ground.albedo = glm::vec3(1.0f);
  const Even sky;
  PathTracer tracer(scene, {.sky = &sky}, {.width = 32, .height = 18, .samples = 64, .clouds = kCoarse});
  EXPECT_TRUE(tracer.run({}));
  const Mean mean = meanOf(tracer.layers());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.value[c], 3.0, 4.0 * mean.error + 1e-3);
  EXPECT_LT(mean.error, 0.03);
}

// A bright spot of the sky is looked for: on bare ground its light is the integral, and clouds under it look as under a
// sun of the same place and strength.
class Spot : public SkyModel {
 public:
  static constexpr double kRadius = 0.1;  // rad, where it has fallen to 1/e
  glm::dvec3 centre;
  double peak;
  Spot(const glm::dvec3& c, double illuminance)
      : centre(c), peak(illuminance / (3.14159265358979 * kRadius * kRadius)) {}
  glm::vec3 radiance(const glm::vec3& d) const override {
    const double angle = glm::length(glm::dvec3(d) - centre);
    return glm::vec3(static_cast<float>(peak * std::exp(-angle * angle / (kRadius * kRadius))));
  }
};

TEST(PathTracer, LooksForBrightSpotsOfTheSky) {
  Scene scene = withoutAir();
  scene.layers.clear();
  scene.ground.albedo = glm::vec3(0.5f);
  scene.camera.pitch = static_cast<float>(-70.0 * kDegree);
  const glm::dvec3 towards = sunDirection(scene.sun);
  scene.sun.elevation = static_cast<float>(-60.0 * kDegree);
  const Spot sky(towards, 100.0);
  PathTracer tracer(scene, {.sky = &sky}, {.width = 32, .height = 18, .samples = 64, .clouds = kCoarse});
  EXPECT_TRUE(tracer.run({}));
  const Mean mean = meanOf(tracer.layers());
  // The spot is small: its light falls as from its centre, less the mean of the cosine over it.
  const double exact = 0.5 / 3.14159265358979 * 100.0 * towards.z * std::exp(-0.25 * Spot::kRadius * Spot::kRadius);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.value[c], exact, 4.0 * mean.error + 0.01 * exact);  // of the sky's table
  EXPECT_LT(mean.error, 0.015 * exact);  // by chance alone it would be 4 %
}

TEST(PathTracer, ASpotOfTheSkyLightsCloudsLikeASun) {
  class Black : public SkyModel {
   public:
    glm::vec3 radiance(const glm::vec3&) const override { return glm::vec3(0.0f); }
  };
  Scene scene = withoutAir();
  scene.ground.albedo = glm::vec3(0.0f);
  scene.layers.front().cloud.phase = ScatteringPhase::henyey_greenstein;
  scene.layers.front().cloud.asymmetry = 0.3f;
  const TraceSettings settings{.width = 32, .height = 18, .samples = 96, .clouds = kCoarse};
  const Black night;
  PathTracer bySun(scene, {.sky = &night}, settings);
  EXPECT_TRUE(bySun.run({}));
  const glm::dvec3 towards = sunDirection(scene.sun);
  const glm::dvec3 irradiance =
      bakeSky(scene.atmosphere, sunDirection(scene.sun), 0.0f, scene.ground.albedo).params.air.sunIrradiance;
  scene.sun.elevation = static_cast<float>(-60.0 * kDegree);
  const Spot spot(towards, irradiance.y);
  PathTracer bySpot(scene, {.sky = &spot}, settings);
  EXPECT_TRUE(bySpot.run({}));
  EXPECT_EQ(bySpot.statistics().notFinite, 0u);
  const Mean a = meanOf(bySun.layers()), b = meanOf(bySpot.layers());
  EXPECT_NEAR(b.value.y, a.value.y, 4.0 * std::hypot(a.error, b.error) + 0.02 * a.value.y);
  EXPECT_LT(b.error, 0.05 * b.value.y);
}

// A cloud that scatters nothing is black.
TEST(PathTracer, BlackCloudsSendNoLight) {
  Scene scene = withoutAir();
  scene.layers.front().cloud.albedo = 0.0f;
  scene.ground.albedo = glm::vec3(0.0f);
  const TraceLayers layers = trace(scene, {.width = 32, .height = 18, .samples = 16, .clouds = kCoarse});
  for (std::size_t i = 0; i < layers.variance.pixels.size(); ++i)
    if (layers.transmittance.pixels[i] == 0.0f) {
      EXPECT_EQ(layers.radiance.pixels[3 * i], 0.0f);
    }
}

// Delta tracking against quadrature along the same rays.
TEST(PathTracer, TransmittanceIsTheIntegralOfExtinction) {
  Scene scene = withoutAir();
  scene.camera.position = {0.0, 0.0, 150.0};
  scene.camera.pitch = static_cast<float>(25.0 * kDegree);
  const int w = 48, h = 27;
  const TraceLayers layers = trace(scene, {.width = w, .height = h, .samples = 256, .clouds = kCoarse});
  const CloudCache cache = bakeCloudCache({.layers = scene.layers,
                                           .noise = scene.noise,
                                           .drift = {scene.wind.speed, scene.wind.from, scene.time},
                                           .seed = scene.seed},
                                          {}, scene.camera.position, kCoarse);
  const law::PlanetParams planet = planetParams(scene.camera.position);
  const law::CameraParams camera = cameraParams(scene.camera, static_cast<double>(w) / h);
  double ours = 0.0, exact = 0.0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      ours += *layers.transmittance.at(x, y);
      constexpr int kGrid = 3;  // rays a pixel
      for (int s = 0; s < kGrid * kGrid; ++s) {
        const glm::vec2 at(static_cast<float>(x) + (static_cast<float>(s % kGrid) + 0.5f) / kGrid,
                           static_cast<float>(y) + (static_cast<float>(s / kGrid) + 0.5f) / kGrid);
        const glm::vec3 ray =
            glm::normalize(law::cameraRay(glm::vec2(2.0f * at.x / w - 1.0f, 1.0f - 2.0f * at.y / h), camera));
        const float step = 12.0f;
        double tau = 0.0;
        const float enter = law::crossings(ray, cache.majorants.bottom, planet).y;
        const float leave = law::crossings(ray, cache.majorants.top, planet).y;
        for (float t = enter + 0.5f * step; t < leave && tau < 20.0; t += step)
          tau += step * extinctionIn(cache, law::cloudSpace(ray * t, planet));
        exact += std::exp(-tau) / (kGrid * kGrid);
      }
    }
  // Binomial noise of 256 paths, and of 9 rays a pixel against all of it: both below .01 of a pixel at random, and
  // there are 1296.
  EXPECT_GT(exact, 200.0);
  EXPECT_LT(exact, 1200.0);
  EXPECT_NEAR(ours, exact, 5.0);
}

// A step that ended exactly at a sheet's lower face once flew through it: dark rings in the sky.
TEST(PathTracer, NoRayMissesASheet) {
  Scene scene = withoutAir();
  scene.layers.clear();
  Sheet sheet;
  sheet.kind = SheetKind::cirrostratus;
  sheet.height = 8200.0f;
  sheet.opticalDepth = 20.0f;
  sheet.coverage = 1.0f;
  scene.sheets = {sheet};
  scene.camera.position = {0.0, 0.0, 120.0};
  scene.camera.pitch = static_cast<float>(25.0 * kDegree);
  scene.camera.fov = static_cast<float>(0.5 * kDegree);
  const TraceLayers layers = trace(scene, {.width = 8, .height = 256, .samples = 32});
  float most = 0.0f;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 8; ++x) most = std::max(most, *layers.transmittance.at(x, y));
  EXPECT_LT(most, 0.02f);  // exp(-20 / sin) but for thin places of the veil
}

// A cube of constant extinction, turned and placed: Beer-Lambert along its axis; and half of a picture that it fills.
TEST(PathTracer, SeesThroughGrids) {
  VoxelGrid voxels({24, 24, 24}, {0.0, 0.0, 0.0}, {10.0, 10.0, 10.0});
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) voxels.set({x, y, z}, 0.5f);
  Scene scene = withoutAir();
  scene.layers.clear();
  scene.grids.push_back({.file = "cube", .position = {500.0, 3000.0, 900.0}, .extinction = 0.02f});
  const PlacedGrid grid = placed(scene.grids.front(), std::make_shared<VoxelGrid>(voxels));
  scene.camera.position = {620.0, 100.0, 1020.0};  // looks north at the middle of the cube's south face
  scene.camera.heading = scene.camera.pitch = 0.0f;
  scene.camera.fov = static_cast<float>(0.5 * kDegree);
  const auto clearOf = [&] {
    PathTracer tracer(scene, {.grids = std::span(&grid, 1)}, {.width = 32, .height = 32, .samples = 64});
    EXPECT_TRUE(tracer.run({}));
    EXPECT_EQ(tracer.statistics().overBound, 0u);
    double clear = 0.0;
    for (const float t : tracer.layers().transmittance.pixels) clear += t / (32.0 * 32.0);
    return clear;
  };
  // tau = .01 x 240; 65536 binomial samples.
  EXPECT_NEAR(clearOf(), std::exp(-2.4), 4.0 * std::sqrt(0.09 * 0.91 / 65536.0));
  scene.camera.position.x = 500.0;                             // along its western face
  EXPECT_NEAR(clearOf(), 0.5 * (1.0 + std::exp(-2.4)), 0.02);  // the face is 0 to 4 degrees off: perspective
}

// Light scattered once in a wide slab seen from below, of a phase function and albedo of its own, against its integral;
// paths that may scatter more than once have the same in their direct layer.
TEST(PathTracer, ScatteredOnceASlabSendsItsIntegral) {
  VoxelGrid voxels({20, 20, 8}, {0.0, 0.0, 0.0}, {2000.0, 2000.0, 50.0});
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x) voxels.set({x, y, z}, 1.0f);
  Scene scene = withoutAir();
  scene.layers.clear();
  scene.ground.albedo = glm::vec3(0.0f);
  scene.sun.elevation = static_cast<float>(50.0 * kDegree);
  scene.sun.azimuth = 0.0f;
  scene.grids.push_back({.file = "slab",
                         .position = {-20000.0, -20000.0, 900.0},
                         .extinction = 0.003f,
                         .albedo = 0.6f,
                         .phase = ScatteringPhase::henyey_greenstein,
                         .asymmetry = 0.5f});
  const PlacedGrid grid = placed(scene.grids.front(), std::make_shared<VoxelGrid>(voxels));
  scene.camera.position = {0.0, 0.0, 0.0};
  scene.camera.pitch = static_cast<float>(90.0 * kDegree);
  scene.camera.fov = static_cast<float>(0.5 * kDegree);
  TraceSettings settings{.width = 32, .height = 32, .samples = 256, .sunDisc = SunDisc::leftOut, .scatterings = 1};
  const auto layersOf = [&] {
    PathTracer tracer(scene, {.grids = std::span(&grid, 1)}, settings);
    EXPECT_TRUE(tracer.run({}));
    EXPECT_EQ(tracer.statistics().overBound, 0u);
    return tracer.layers();
  };
  const Mean once = meanOf(layersOf());
  const double mu0 = std::sin(50.0 * kDegree), depth = 0.003 * 400.0, k = 1.0 / mu0 - 1.0;
  const double phase = law::phaseHenyeyGreenstein(static_cast<float>(mu0), 0.5f);
  const double share = 0.6 * phase * std::exp(-depth) * (1.0 - std::exp(-depth * k)) / k;
  const double exact = share * luminanceOf(glm::dvec3(kSunIrradiance));
  EXPECT_NEAR(luminanceOf(once.value), exact, 4.0 * once.error + 1e-3 * exact);
  EXPECT_LT(once.error, 0.005 * exact);
  settings.scatterings = 0;
  const TraceLayers all = layersOf();
  double direct = 0.0;
  for (std::size_t i = 0; i < all.direct.pixels.size(); i += 3)
    direct += luminanceOf({all.direct.pixels[i], all.direct.pixels[i + 1], all.direct.pixels[i + 2]}) / (32.0 * 32.0);
  EXPECT_NEAR(direct, exact, 4.0 * once.error + 1e-3 * exact);
  EXPECT_GT(luminanceOf(meanOf(all).value), 1.2 * exact);
}

// A picture that was interrupted, saved, and taken up again is the picture that was not, wherever that happened.
TEST(PathTracer, GoesOnFromAStateToTheSamePicture) {
  Scene scene;
  const TraceSettings settings{
      // 35 tiles: more than are traced between two looks at the clock
      .width = 560, .height = 3, .samples = 64, .noise = 0.08, .air = AirModel::tables, .clouds = kCoarse};
  const TraceLayers whole = trace(scene, settings);
  std::vector<std::byte> state;
  PathTracer second(scene, {}, settings);
  for (const int interruption : {1, 2, 3, 4}) {
    SCOPED_TRACE(interruption);
    PathTracer first(scene, {}, settings);
    int calls = 0;
    EXPECT_FALSE(first.run([&](double done) {
      EXPECT_GE(done, 0.0);
      EXPECT_LE(done, 1.0);
      return ++calls < interruption;
    }));
    state = first.state();
    second.restore(state);
    EXPECT_TRUE(second.run({}));
    EXPECT_EQ(second.layers().radiance.pixels, whole.radiance.pixels);
    EXPECT_EQ(second.layers().samples.pixels, whole.samples.pixels);
  }
  float least = 1e9f, most = 0.0f;
  for (const float n : whole.samples.pixels) least = std::min(least, n), most = std::max(most, n);
  EXPECT_LT(least, most);  // it did adapt

  std::vector<std::byte> cut = state;
  cut.pop_back();
  EXPECT_THROW(second.restore(cut), Error);
  cut = state;
  cut[0] = std::byte{0};
  EXPECT_THROW(second.restore(cut), Error);
  PathTracer other(scene, {}, {.width = 32, .height = 48, .clouds = kCoarse});
  EXPECT_THROW(other.restore(state), Error);
}

// The noise asked for is the error that the picture has, on the scale of brightness that the header gives.
TEST(PathTracer, ReachesTheNoiseAskedFor) {
  constexpr int kSize = 16, kMany = 512;  // one tile, so its mean is grey
  constexpr double kNoise = 0.05;
  TraceSettings settings{.width = kSize, .height = kSize, .samples = kMany, .air = AirModel::tables, .clouds = kCoarse};
  const TraceLayers longer = trace(Scene{}, settings);
  settings.noise = kNoise;
  const TraceLayers found = trace(Scene{}, settings);
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 0; i < longer.radiance.pixels.size(); i += 3) {
    const auto luminance = [i](const TraceLayers& layers) {
      const float* p = &layers.radiance.pixels[i];
      return luminanceOf({p[0], p[1], p[2]});
    };
    mean += luminance(longer) / (kSize * kSize);
    square += std::pow(luminance(found) - luminance(longer), 2.0) / (kSize * kSize);
  }
  const double samples = found.samples.pixels.front();
  ASSERT_GT(samples, 32.0);
  ASSERT_LT(samples, kMany / 2);
  // Both begin with the same samples.
  const double error = 0.5 * std::sqrt(0.18 * square / (1.0 - samples / kMany)) / mean;
  // Bright paths are rare: the error of 256 pixels is known to about a third.
  EXPECT_NEAR(error, kNoise, 0.35 * kNoise) << samples << " samples";
}

// Few samples miss the rare bright paths and look finished: after the first round a tile is done only when the mean
// variance of its neighbourhood says so, too.
TEST(PathTracer, CoarseNoiseIsJudgedByTheNeighbourhood) {
  constexpr int kAcross = 6, kDown = 4, kTile = 16, kFirst = 16;
  constexpr double kNoise = 0.12, kPixels = kTile * kTile;
  TraceSettings settings{
      .width = kAcross * kTile, .height = kDown * kTile, .samples = kFirst, .air = AirModel::tables, .clouds = kCoarse};
  const TraceLayers first = trace(Scene{}, settings);
  settings.samples = 64;
  settings.noise = kNoise;
  const TraceLayers found = trace(Scene{}, settings);
  std::vector<double> means(kAcross * kDown), variances(means.size());
  const auto indexOf = [](int x, int y) { return static_cast<std::size_t>(y) * kAcross + static_cast<std::size_t>(x); };
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const auto tile = indexOf(x / kTile, y / kTile);
      const float* p = first.radiance.at(x, y);
      means[tile] += luminanceOf({p[0], p[1], p[2]}) / kPixels;
      variances[tile] += static_cast<double>(*first.variance.at(x, y)) / kPixels;
    }
  std::vector<double> sorted = means;
  std::sort(sorted.begin(), sorted.end());
  const double grey = sorted[sorted.size() / 2];
  int byNeighbours = 0;
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const auto tile = indexOf(column, row);
      double sum = 0.0, count = 0.0;
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, kDown - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, kAcross - 1); ++x, ++count)
          sum += variances[indexOf(x, y)];
      const auto error = [&](double variance) { return 0.5 * std::sqrt(0.18 * variance / (grey * means[tile])); };
      const double own = error(variances[tile]), around = error(sum / count), worse = std::max(own, around);
      const bool finished = *found.samples.at(column * kTile, row * kTile) == kFirst;
      // The layers are floats.
      if (std::abs(worse - kNoise) > 1e-4 * kNoise) {
        EXPECT_EQ(finished, worse < kNoise) << "tile " << tile;
      }
      if (own < kNoise && around > kNoise) ++byNeighbours;
    }
  EXPECT_GT(byNeighbours, 0);
}

// Roulette, branches and the order of layers: what was scattered once and the rest add up, with and without clouds.
TEST(PathTracer, LayersAddUp) {
  const TraceLayers layers =
      trace(Scene{}, {.width = 32, .height = 18, .samples = 8, .air = AirModel::tables, .clouds = kCoarse});
  double direct = 0.0, multiple = 0.0;
  for (std::size_t i = 0; i < layers.radiance.pixels.size(); ++i) {
    EXPECT_NEAR(layers.direct.pixels[i] + layers.multiple.pixels[i], layers.radiance.pixels[i],
                1e-4 * layers.radiance.pixels[i] + 1e-6);
    direct += layers.direct.pixels[i];
    multiple += layers.multiple.pixels[i];
  }
  EXPECT_GT(direct, 0.0);
  EXPECT_GT(multiple, 0.0);
}

TEST(PathTracer, RefusesPicturesWithoutPixels) {
  EXPECT_THROW(PathTracer(Scene{}, {}, {.width = 0, .height = 5}), Error);
  EXPECT_THROW(PathTracer(Scene{}, {}, {.width = 5, .height = 5, .samples = 0}), Error);
}

}  // namespace
}  // namespace welkin::trace
