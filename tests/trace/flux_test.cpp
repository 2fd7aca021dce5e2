// The flux solver: closed forms, energy, other ways to the same number, and what it refuses. Published numbers:
// validation_test.cpp.
#include "welkin/trace/flux.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/trace/lanes.hpp"
#include "welkin/base/error.hpp"

namespace welkin {
namespace {

// 4.5 standard errors happen once in 100,000 times; runs are deterministic. 1e-6: sums of floats.
void expectNear(const FluxEstimate& e, double expected, const char* what) {
  EXPECT_NEAR(e.mean, expected, 4.5 * e.se + 1e-6) << what;
}

VoxelGrid slab(double depth, const glm::ivec3& dims = {1, 1, 1}) {
  VoxelGrid grid(dims, glm::dvec3(0.0), glm::dvec3(1000.0) / glm::dvec3(dims));
  for (int z = 0; z < dims.z; ++z)
    for (int y = 0; y < dims.y; ++y)
      for (int x = 0; x < dims.x; ++x) grid.set({x, y, z}, float(depth / 1000.0));
  return grid;
}

// Sides that are no multiple of a brick, an empty brick, and voxels of unequal sides.
VoxelGrid lumpy() {
  VoxelGrid grid({21, 11, 9}, {5.0, -3.0, 100.0}, {10.0, 20.0, 15.0});
  for (int z = 0; z < 9; ++z)
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 21; ++x)
        if (x < 8 || y >= 8) grid.set({x, y, z}, 0.002f * float((x * 5 + y * 3 + z * 7) % 11));
  return grid;
}

const PhaseTable& forward() {
  static const PhaseTable kTable = PhaseTable::henyeyGreenstein(0.85);
  return kTable;
}

// Mean of exp(-depth) over the top, by marching in small steps through a periodic grid.
double meanTransmittance(const VoxelGrid& grid, const FluxDirection& sun) {
  const double zenith = sun.zenith * std::numbers::pi / 180.0, azimuth = sun.azimuth * std::numbers::pi / 180.0;
  const glm::dvec3 way =
      -glm::dvec3(std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith));
  const glm::dvec3 size = glm::dvec3(grid.dims()) * grid.voxel();
  constexpr int kAcross = 200, kSteps = 400;
  double sum = 0.0;
  for (int n = 0; n < kAcross * kAcross; ++n) {
    const glm::dvec3 start = size * glm::dvec3((n % kAcross + 0.5) / kAcross, (n / kAcross + 0.5) / kAcross, 1.0);
    const double step = size.z / -way.z / kSteps;
    double depth = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      glm::dvec3 p = start + way * (step * (i + 0.5));
      for (int k = 0; k < 2; ++k) p[k] -= size[k] * std::floor(p[k] / size[k]);
      depth += step * double(grid.at(glm::ivec3(p / grid.voxel())));
    }
    sum += std::exp(-depth);
  }
  return sum / (kAcross * kAcross);
}

TEST(Flux, ABlackCloudLetsThroughWhatBeerSays) {
  for (const FluxDirection& sun : {FluxDirection{0.0, 0.0}, FluxDirection{40.0, 30.0}, FluxDirection{65.0, 250.0}}) {
    const VoxelGrid grid = lumpy();
    const FluxResult r = traceFlux(grid, nullptr, forward(),
                                   {.sides = FluxSides::periodic, .sun = sun, .albedo = 0.0, .photons = 400000});
    // The reference marches in steps: 3e-4.
    EXPECT_NEAR(r.transmitted.mean, meanTransmittance(grid, sun), 4.5 * r.transmitted.se + 3e-4);
    EXPECT_EQ(r.transmitted.mean, r.unscattered.mean);
    EXPECT_EQ(r.reflected.mean, 0.0);
    expectNear(r.absorbed, 1.0 - r.transmitted.mean, "absorbed");
  }
}

TEST(Flux, ColumnsAverageToTheDomainAndSeeTheirOwnVoxels) {
  VoxelGrid grid({3, 2, 1}, glm::dvec3(0.0), glm::dvec3(100.0));
  for (int i = 0; i < 6; ++i) grid.set({i % 3, i / 3, 0}, 0.005f * float(i));
  const FluxResult r =
      traceFlux(grid, nullptr, forward(), {.sides = FluxSides::periodic, .albedo = 0.0, .photons = 300000});
  double mean = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(r.transmitted.columns[i], std::exp(-0.5 * double(i)), 4.5 * r.transmitted.columnsSe[i] + 1e-6);
    EXPECT_NEAR(r.absorbed.columns[i], -std::expm1(-0.5 * double(i)), 4.5 * r.absorbed.columnsSe[i] + 1e-6);
    mean += r.transmitted.columns[i] / 6.0;
  }
  EXPECT_NEAR(mean, r.transmitted.mean, 1e-12);
}

TEST(Flux, EnergyIsKept) {
  const VoxelGrid grid = lumpy();
  for (const FluxSides sides : {FluxSides::open, FluxSides::periodic})
    for (const FluxLight light : {FluxLight::beam, FluxLight::diffuse, FluxLight::isotropic})
      for (const double surface : {0.0, 0.7}) {
        const FluxResult r = traceFlux(grid, nullptr, forward(),
                                       {.sides = sides,
                                        .light = light,
                                        .sun = {55.0, 200.0},
                                        .albedo = 0.95,
                                        .surfaceAlbedo = surface,
                                        .photons = 20000});
        double left = r.reflected.mean + r.absorbed.mean + (1.0 - surface) * r.transmitted.mean, incident = 0.0;
        for (int face = 0; face < 6; ++face) {
          if (face < 4) left += r.faces[face].mean;
          incident += r.incident[face];
        }
        // Roulette changes single weights by at most 1/16: a standard error below 1e-3.
        EXPECT_NEAR(left, 1.0, 3e-3);
        EXPECT_NEAR(incident, 1.0, 1e-12);
      }
}

TEST(Flux, ASlantBeamLightsTheFacesItReaches) {
  VoxelGrid grid({4, 4, 4}, glm::dvec3(0.0), {10.0, 20.0, 40.0});
  const FluxResult r = traceFlux(grid, nullptr, forward(), {.sun = {45.0, 90.0}, .photons = 100000});
  // From +y at 45 degrees: the north face, 160 m high, and the top, 80 m deep.
  EXPECT_NEAR(r.incident[5], 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(r.incident[3], 2.0 / 3.0, 1e-12);
  EXPECT_EQ(r.unscattered.mean, 1.0);
  // The top's light and the upper half of the north's leave through the south, the rest through the bottom.
  expectNear(r.faces[2], 2.0 / 3.0, "south");
  expectNear(r.faces[4], 1.0 / 3.0, "bottom");
}

TEST(Flux, ALambertianSurfaceUnderClearAir) {
  const VoxelGrid grid({9, 9, 9}, glm::dvec3(0.0), glm::dvec3(10.0));
  const FluxResult r = traceFlux(grid, nullptr, forward(),
                                 {.sides = FluxSides::periodic,
                                  .sun = {30.0, 10.0},
                                  .surfaceAlbedo = 0.4,
                                  .photons = 10000,
                                  .views = {{0.0, 0.0}, {70.0, 123.0}}});
  EXPECT_NEAR(r.reflected.mean, 0.4, 1e-6);
  EXPECT_EQ(r.transmitted.mean, 1.0);
  for (const FluxEstimate& e : r.radiance) EXPECT_NEAR(e.mean, 0.4, 1e-6);
}

// Reciprocity of the plane-parallel slab: the same radiance with sun and viewer exchanged.
TEST(Flux, SunAndViewerMayBeExchanged) {
  const VoxelGrid grid = slab(3.0);
  const auto radiance = [&](const FluxDirection& sun, const FluxDirection& view) {
    return traceFlux(grid, nullptr, forward(),
                     {.sides = FluxSides::periodic, .sun = sun, .photons = 400000, .views = {view}})
        .radiance[0];
  };
  const FluxEstimate a = radiance({20.0, 0.0}, {60.0, 90.0}), b = radiance({60.0, 90.0}, {20.0, 0.0});
  EXPECT_NEAR(a.mean, b.mean, 4.5 * std::hypot(a.se, b.se));
  EXPECT_LT(a.se, 0.02 * a.mean);
}

TEST(Flux, AlbedoOfVoxelsIsTheAlbedo) {
  const VoxelGrid grid = lumpy();
  VoxelGrid albedo(grid.dims(), grid.origin(), grid.voxel());
  for (int z = 0; z < 9; ++z)
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 21; ++x) albedo.set({x, y, z}, 0.75f);
  const FluxSettings settings{.sides = FluxSides::periodic, .albedo = 0.75, .photons = 50000};
  const FluxResult a = traceFlux(grid, nullptr, forward(), settings);
  const FluxResult b = traceFlux(grid, &albedo, forward(), settings);
  EXPECT_EQ(a.reflected.columns, b.reflected.columns);
  EXPECT_EQ(a.absorbed.mean, b.absorbed.mean);
  EXPECT_GT(a.absorbed.mean, 0.1);
}

// One voxel, many, and bricks that are cut: the same slab.
TEST(Flux, VoxelsOfASlabDoNotMatter) {
  const FluxSettings settings{.sides = FluxSides::periodic, .sun = {60.0, 45.0}, .photons = 200000};
  const FluxResult a = traceFlux(slab(8.0), nullptr, forward(), settings);
  for (const glm::ivec3& dims : {glm::ivec3(20), glm::ivec3(1, 9, 17), glm::ivec3(8, 1, 8)}) {
    const FluxResult b = traceFlux(slab(8.0, dims), nullptr, forward(), settings);
    EXPECT_NEAR(a.reflected.mean, b.reflected.mean, 4.5 * std::hypot(a.reflected.se, b.reflected.se));
    EXPECT_NEAR(a.path.mean, b.path.mean, 4.5 * std::hypot(a.path.se, b.path.se));
  }
}

TEST(Flux, DroppedPathsAreCounted) {
  const FluxSettings settings{.sides = FluxSides::periodic, .photons = 100000, .dropAfter = 0};
  const FluxResult r = traceFlux(slab(1.0), nullptr, forward(), settings);
  expectNear(r.unscattered, std::exp(-1.0), "unscattered");
  EXPECT_NEAR(r.lost.mean, 1.0 - r.unscattered.mean, 1e-12);
}

// The spread over seeds is the standard error: its square over 60 runs has a relative error of 18 %.
TEST(Flux, StandardErrorsAreTrue) {
  double sum = 0.0, square = 0.0, claimed = 0.0;
  constexpr int kRuns = 60;
  for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
    const FluxEstimate e =
        traceFlux(slab(2.0), nullptr, forward(),
                  {.sides = FluxSides::periodic, .photons = 5000, .seed = seed, .views = {{30.0, 0.0}}})
            .radiance[0];
    sum += e.mean;
    square += e.mean * e.mean;
    claimed += e.se * e.se / kRuns;
  }
  const double variance = (square - sum * sum / kRuns) / (kRuns - 1);
  EXPECT_NEAR(variance / claimed, 1.0, 0.6);
}

TEST(Flux, EveryTargetGivesTheSameWithinItsError) {
  const VoxelGrid grid = lumpy();
  const FluxSettings settings{.sun = {30.0, 20.0}, .photons = 100000, .views = {{0.0, 0.0}}};
  const FluxResult best = traceFlux(grid, nullptr, forward(), settings);
  lanes::forEachTarget([&](const char* name) {
    const FluxResult r = traceFlux(grid, nullptr, forward(), settings);
    // The same photons: only those that rounding turns onto another way differ.
    EXPECT_NEAR(r.reflected.mean, best.reflected.mean, best.reflected.se) << name;
    EXPECT_NEAR(r.radiance[0].mean, best.radiance[0].mean, best.radiance[0].se) << name;
  });
}

TEST(Flux, RefusesNonsense) {
  const VoxelGrid grid = slab(1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const FluxSettings& s :
       {FluxSettings{.albedo = 1.1}, FluxSettings{.albedo = nan}, FluxSettings{.surfaceAlbedo = -0.1},
        FluxSettings{.sun = {90.0, 0.0}}, FluxSettings{.sun = {0.0, nan}}, FluxSettings{.photons = 1},
        FluxSettings{.views = {{90.0, 0.0}}}, FluxSettings{.views = {{nan, 0.0}}}, FluxSettings{.views = {{0.0, nan}}}})
    EXPECT_THROW(traceFlux(grid, nullptr, forward(), s), Error);
  EXPECT_THROW(traceFlux(VoxelGrid({4096, 4096, 1}, glm::dvec3(0.0), glm::dvec3(1.0)), nullptr, forward(), {}), Error);
  const VoxelGrid other({2, 1, 1}, glm::dvec3(0.0), glm::dvec3(1.0));
  EXPECT_THROW(traceFlux(grid, &other, forward(), {}), Error);
  VoxelGrid bright = grid;
  bright.set({0, 0, 0}, 1.5f);
  EXPECT_THROW(traceFlux(grid, &bright, forward(), {}), Error);
  EXPECT_THROW(traceFlux(grid, nullptr, forward(), {}, [](double) { return false; }), Cancelled);
}

// Lanes that never had a photon take part in every lookup.
TEST(Flux, FewerPhotonsThanLanesStayInTheGrid) {
  const FluxResult r = traceFlux(lumpy(), nullptr, forward(),
                                 {.light = FluxLight::isotropic, .photons = 3, .views = {{0.0, 0.0}, {130.0, 200.0}}});
  double out = 0.0;
  for (const FluxEstimate& face : r.faces) out += face.mean;
  EXPECT_NEAR(out, 1.0, 1e-6);
}

}  // namespace
}  // namespace welkin
