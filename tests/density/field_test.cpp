// The field's answers are the law's, evaluated by hand, wherever in the world it is asked.
#include "welkin/density/field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/density/small_noise.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/noise/textures.hpp"

namespace welkin {
namespace {

std::vector<Layer> twoLayers() {
  std::vector<Layer> layers(2);
  layers[0].weather.coverage = 0.8f;
  layers[0].cloud.shear = 300.0f;
  layers[0].weather.anvil = 0.5f;
  layers[1].cloud.shape = LayerShape::nubis;
  layers[1].cloud.base = 3000.0f;
  layers[1].weather.coverage = 0.7f;
  layers[1].weather.type = 0.8f;
  return layers;
}

std::vector<glm::dvec3> pointsRound(const glm::dvec2& centre, double low, double high) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 5000; ++i) {
    const auto unit = [&](double k) { return std::fmod(k * (i + 1), 1.0); };
    points.emplace_back(centre.x + 8000.0 * unit(0.6180339887), centre.y + 8000.0 * unit(0.4142135624),
                        low + (high - low) * unit(0.7320508076));
  }
  return points;
}

// The law in its scalar reading, one layer, with one anchor for all.
std::vector<float> byHand(const Layer& layer, const NoiseSettings& noise, const Drift& drift, int seed,
                          const std::vector<glm::dvec3>& points, const glm::dvec2& anchor) {
  const law::LayerParams c = layerParams(layer, glm::dvec3(anchor, 0.0), drift);
  const law::WeatherParams w = weatherParams(layer, anchor, drift, seed);
  const bool profile = layer.cloud.shape == LayerShape::profile;
  Volume base =
      profile ? bakeProfileBasePacked(noise.profile, layer.profile.billowMix) : bakeBaseShapePacked(noise.baseShape);
  Volume detail = profile ? bakeProfileDetail(noise.profile) : bakeDetailPacked(noise.detail);
  Volume third = profile ? bakeProfileWarp(noise.profile) : bakeCurl(noise.curl);
  for (Volume* v : {&base, &detail, &third}) roundToHalf(*v);
  const TextureView map = authoringMap(layer, nullptr);
  std::vector<float> sigma;
  for (const glm::dvec3& p : points) {
    const glm::vec3 q = law::unsheared(glm::vec3(p - glm::dvec3(anchor, 0.0)), c);
    const glm::vec3 found =
        profile ? law::profileExtinctionIn(law::profileWeather(law::profileColumn(q, c, third.view()), w, map), q, 0.0f,
                                           c, base.view(), detail.view())
                : law::nubisExtinctionIn(law::nubisWeather(glm::vec2(q), w, map), q, true, c, base.view(),
                                         detail.view(), third.view());
    sigma.push_back(found.x);
  }
  return sigma;
}

struct Difference {
  double mean = 0.0, largest = 0.0, meanValue = 0.0;
};
Difference compare(const std::vector<float>& a, const std::vector<float>& b) {
  Difference d;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double e = std::abs(a[i] - b[i]);
    d.mean += e / static_cast<double>(a.size());
    d.largest = std::max(d.largest, e);
    d.meanValue += a[i] / static_cast<double>(a.size());
  }
  return d;
}

// A 30 m ramp turns the rims' 2e-3 of a height in the weather into a tenth of full extinction; few points stand there.
TEST(DensityField, IsTheLawEvaluatedByHand) {
  const std::vector<Layer> layers = twoLayers();
  const NoiseSettings noise = test::smallNoise();
  const Drift drift{9.0f, 4.0f, 700.0};
  const DensityField clouds({.layers = layers, .noise = noise, .drift = drift, .seed = 3});
  const std::vector<glm::dvec3> points = pointsRound({5000.0, -9000.0}, 1000.0, 5000.0);
  std::vector<float> sum(points.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::vector<float> expected = byHand(layers[i], noise, drift, 3, points, {0.0, 0.0});
    const Difference d = compare(expected, clouds.layerExtinction(i, points));
    EXPECT_GT(d.meanValue, 1e-4) << i;
    EXPECT_LT(d.mean, 1e-3 * d.meanValue) << i;
    EXPECT_LT(d.largest, 0.1 * layers[i].cloud.extinction) << i;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += expected[k];
  }
  EXPECT_LT(compare(sum, clouds.extinction(points)).mean, 1e-3 * compare(sum, sum).meanValue);
  EXPECT_EQ(clouds.extinction(points[17]), clouds.extinction(std::span(&points[17], 1)).front());
}

// The wind carries the clouds of the origin 10^6 m away, where they are asked for again.
TEST(DensityField, IsAsPreciseFarFromTheOrigin) {
  std::vector<Layer> layers = twoLayers();
  for (Layer& l : layers) {
    l.cloud.updraft = 0.0f;
    l.cloud.detailDrift = 1.0f;
  }
  const NoiseSettings noise = test::smallNoise();
  const Drift still{10.0f, 4.7123890f, 0.0}, late{10.0f, 4.7123890f, 1e5};
  const DensityField near({.layers = layers, .noise = noise, .drift = still, .seed = 3});
  const DensityField far({.layers = layers, .noise = noise, .drift = late, .seed = 3});
  const std::vector<glm::dvec3> points = pointsRound({0.0, 0.0}, 1000.0, 5000.0);
  std::vector<glm::dvec3> moved = points;
  for (glm::dvec3& p : moved) p += glm::dvec3(driftOffset(late), 0.0);
  const Difference d = compare(near.extinction(points), far.extinction(moved));
  EXPECT_GT(d.meanValue, 5e-4) << "too little cloud to compare";
  EXPECT_LT(d.mean, 2e-3 * d.meanValue);
}

// Where a block of points is cut, and so which anchor it takes, does not show.
TEST(DensityField, AnchorsDoNotShow) {
  const std::vector<Layer> layers = twoLayers();
  const DensityField clouds({.layers = layers, .noise = test::smallNoise(), .seed = 3});
  const std::vector<glm::dvec3> points = pointsRound({9e5, -7e5}, 1000.0, 5000.0);
  std::vector<float> one;
  for (std::size_t i = 0; i < 600; ++i) one.push_back(clouds.extinction(points[i]));
  std::vector<float> all = clouds.extinction(points);
  all.resize(one.size());
  const Difference d = compare(one, all);
  EXPECT_GT(d.meanValue, 1e-3);
  EXPECT_LT(d.mean, 2e-3 * d.meanValue);
}

TEST(DensityField, ColumnsAreVerticalIntegrals) {
  std::vector<Layer> layers(1);
  layers[0].weather.coverage = 0.9f;
  const DensityField clouds({.layers = layers, .noise = test::smallNoise(), .seed = 3});
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 100; ++i) places.emplace_back(700.0 * i, 300.0 * i);
  const std::vector<CloudColumn> columns = clouds.columns(0, places, 10.0);
  const Shell shell = shellOf(layers[0]);
  int cloudy = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CloudColumn& c = columns[i];
    EXPECT_NEAR(c.opticalDepth, clouds.opticalDepth(places[i], shell.bottom, shell.top), 1e-2 + 1e-3 * c.opticalDepth);
    if (c.top == 0.0f) continue;
    ++cloudy;
    EXPECT_GE(c.base, shell.bottom);
    EXPECT_LE(c.top, shell.top + 1.0f);
    EXPECT_LE(c.opticalDepth, layers[0].cloud.extinction * (c.top - c.base) + 0.1f);
  }
  EXPECT_GT(cloudy, 10);
  EXPECT_EQ(clouds.opticalDepth(places[0], 500.0, 500.0), 0.0);
  EXPECT_THROW((void)clouds.opticalDepth(places[0], 500.0, 600.0, 0.0), Error);
}

// A slab of even extinction, 600 m deep, seen from below, inside and above.
TEST(DensityField, RaysThroughASlabAreClosedForms) {
  VoxelGrid voxels({32, 32, 4}, {-16000.0, -16000.0, 1000.0}, {1000.0, 1000.0, 150.0});
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) voxels.set({x, y, z}, 0.01f);
  const std::vector<PlacedGrid> grids{
      placed({.values = GridValues::extinction}, std::make_shared<const VoxelGrid>(std::move(voxels)))};
  const DensityField clouds({.grids = grids});
  const double full = clouds.opticalDepth({0.0, 0.0}, 0.0, 3000.0, 1.0);  // of the zeros round it some counts too
  EXPECT_NEAR(full, 6.0, 1.6);
  for (const double sine : {1.0, 0.7, 0.4}) {
    const glm::dvec3 up(std::sqrt(1.0 - sine * sine), 0.0, sine);
    EXPECT_NEAR(clouds.opticalDepthToward({0.0, 0.0, 0.0}, up, 2.0), full / sine, 0.01 * full / sine) << sine;
    EXPECT_NEAR(clouds.opticalDepthToward({0.0, 0.0, 1300.0}, up, 2.0), 0.5 * full / sine, 0.01 * full / sine);
    EXPECT_NEAR(clouds.opticalDepthToward({0.0, 0.0, 3000.0}, -up, 2.0), full / sine, 0.01 * full / sine);
    EXPECT_EQ(clouds.opticalDepthToward({0.0, 0.0, 3000.0}, up), 0.0);
    EXPECT_EQ(clouds.opticalDepthToward({0.0, 0.0, 500.0}, -up), 0.0) << "the ground is in the way";
  }
  EXPECT_EQ(DensityField({}).opticalDepthToward({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}), 0.0);
  EXPECT_THROW((void)clouds.opticalDepthToward({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.0), Error);
}

TEST(DensityField, SheetsAreTheLawEvaluatedByHand) {
  std::vector<Sheet> sheets(2);
  sheets[1].kind = SheetKind::altocumulus;
  sheets[1].coverage = 0.8f;
  const DensityField clouds({.sheets = sheets, .drift = {0.0f, 0.0f, 90.0}, .seed = 4});
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 500; ++i) places.emplace_back(37.0 * i, -61.0 * i);
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const law::SheetParams params = sheetParams(sheets[s], {0.0, 0.0}, 90.0, 4);
    const std::vector<float> depth = clouds.sheetOpticalDepth(s, places);
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_NEAR(depth[i], law::sheetOpticalDepth(glm::vec2(places[i]), params), 2e-3f * sheets[s].opticalDepth);
  }
}

TEST(DensityField, RefusesAMissingMap) {
  std::vector<Layer> layers(1);
  layers[0].weather.map = "picture.png";
  EXPECT_THROW(DensityField({.layers = layers, .noise = test::smallNoise()}), Error);
  const std::vector<Volume> maps{Volume(2, 2, 1, 4)};
  EXPECT_NO_THROW(DensityField({.layers = layers, .noise = test::smallNoise(), .weatherMaps = maps}));
}

}  // namespace
}  // namespace welkin
