// Volumes in the real-time renderer: what the voxels say, and the same picture as the clouds that were baked into them.
#include <gtest/gtest.h>

#include "tests/realtime/march_cpu.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/voxel_bake.hpp"
#include "welkin/realtime/grid_atlas.hpp"

namespace welkin::realtime::test {
namespace {

// One dense layer of low cloud over a few kilometres, seen from the side.
Scene cloudyScene() {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers[0].cloud.thickness = 500.0f;
  scene.layers[0].cloud.base = 600.0f;
  scene.layers[0].weather.coverage = 0.6f;
  scene.layers[0].weather.population = Population::domes;
  scene.layers[0].weather.cellSize = 1500.0f;
  scene.layers[0].profile.fineDetail = 0.0f;  // finer than the voxels
  scene.camera.pitch = 0.45f;
  return scene;
}

constexpr double kEdge = 6400.0, kLow = 400.0, kHigh = 1680.0;

VoxelGrid baked(const Scene& scene, double voxel) {
  const DensityField field({.layers = scene.layers, .noise = scene.noise, .seed = scene.seed});
  const VoxelBox box{glm::ivec3(glm::round(glm::dvec3(kEdge, kEdge, kHigh - kLow) / voxel)),
                     {-0.5 * kEdge, -0.5 * kEdge, kLow},
                     glm::dvec3(voxel)};
  return bakeVoxels(field, box, {});
}

// The scene with its layers as a grid.
Scene withoutLayers(Scene scene) {
  scene.layers.clear();
  scene.grids.resize(1);
  scene.grids[0].file = "clouds.vdb";  // its voxels are handed over
  return scene;
}

Image draw(Stage& stage, const Scene& scene, const std::vector<PlacedGrid>& grids) {
  CustomTextures textures;
  textures.grids = grids;
  stage.sky->setScene(scene, textures);
  stage.view.reset();
  return stage.draw(stage.view, stage.frame(scene));
}

PlacedGrid placedPlainly(VoxelGrid voxels) {
  return placed({.values = GridValues::extinction}, std::make_shared<const VoxelGrid>(std::move(voxels)));
}

TEST(GridFrameParity, TheAtlasHoldsTheVoxels) {
  Stage stage(128, 72);
  Scene scene = withoutLayers(cloudyScene());
  scene.quality.lightVolume = false;
  // Turned and moved, and a second one in another place: slices, rotation and offsets all count.
  const auto voxels = std::make_shared<const VoxelGrid>(baked(cloudyScene(), 40.0));
  scene.camera.position = {3000.0, -2000.0, 100.0};
  const std::vector<PlacedGrid> grids{
      placed({.position = {3000.0, 0.0, 50.0}, .rotation = {0.1f, 0.05f, 0.6f}, .values = GridValues::extinction},
             voxels),
      placed({.position = {3600.0, 1500.0, 900.0}, .scale = 0.5f, .values = GridValues::extinction, .density = 2.0f},
             voxels)};
  scene.grids.resize(2, scene.grids[0]);
  const Image gpu = draw(stage, scene, grids);
  const Image cpu = marchOnCpu(scene, stage.frame(scene), grids);
  const Statistics s = statistics(cpu);
  EXPECT_GT(s.deviation, 0.05 * s.mean) << "the picture shows nothing";
  EXPECT_GT(displayedPsnr(gpu, cpu), 45.0);  // as frame_parity_test.cpp
  // Negative control: half a voxel of shift.
  std::vector<PlacedGrid> moved = grids;
  for (PlacedGrid& g : moved) g.fromWorld[3] += glm::dvec4(20.0, 20.0, 0.0, 0.0);
  EXPECT_LT(displayedPsnr(gpu, marchOnCpu(scene, stage.frame(scene), moved)), 45.0);
}

TEST(GridFrameParity, BakedCloudsLookLikeThemselves) {
  Stage stage(128, 72);
  const Scene scene = cloudyScene();
  // The same land and light below both; only the box over the camera has clouds in the second.
  const Image procedural = stage.draw(scene);
  const Image fine = draw(stage, withoutLayers(scene), {placedPlainly(baked(scene, 16.0))});
  const Image coarse = draw(stage, withoutLayers(scene), {placedPlainly(baked(scene, 128.0))});
  const Image none = draw(stage, withoutLayers(scene), {placedPlainly(VoxelGrid(glm::ivec3(8), {}, glm::dvec3(1.0)))});
  const double same = displayedPsnr(procedural, fine);
  RecordProperty("psnr", std::to_string(same));
  // Measured: 39 dB; 34 with voxels of 128 m, wider than a cloud's edge, and 34 without clouds.
  EXPECT_GT(same, 36.0);
  EXPECT_LT(displayedPsnr(procedural, coarse), same - 5.0);
  EXPECT_LT(displayedPsnr(procedural, none), same - 5.0);
}

TEST(GridAtlas, FitsByHalvingItsResolution) {
  const VoxelGrid voxels = baked(cloudyScene(), 64.0);
  const PlacedGrid grids[] = {placedPlainly(voxels)};
  const GridPacking whole = packGrids(grids, {});
  EXPECT_EQ(whole.grids[0].placed.voxels->voxel().x, 64.0);
  const std::size_t bytes = 2 * whole.bricks.size();
  const GridPacking small = packGrids(grids, {.bytes = bytes / 2});
  EXPECT_EQ(small.grids[0].placed.voxels->voxel().x, 128.0);
  EXPECT_LT(2 * small.bricks.size(), 6 * bytes / 10);  // the texture's last bricks are not used
  // Optical depth is kept: the mean of eight voxels twice as large.
  const auto mass = [](const VoxelGrid& g) {
    double sum = 0.0;
    for (const float v : g.values()) sum += v;
    return sum * g.voxel().x * g.voxel().y * g.voxel().z;
  };
  EXPECT_NEAR(mass(*small.grids[0].placed.voxels) / mass(voxels), 1.0, 1e-5);
  // A driver with small textures.
  const GridPacking narrow = packGrids(grids, {.textureSize = 27});
  EXPECT_LE(narrow.bricksAcross.x, 3);
  EXPECT_LE(narrow.indexSize.x, 27);
}

TEST(GridAtlas, IsCountedAndAsked) {
  Stage stage(32, 18);
  Scene scene = withoutLayers(cloudyScene());
  EXPECT_THROW(stage.sky->setScene(scene), Error);
  draw(stage, scene, {placedPlainly(baked(cloudyScene(), 64.0))});
  std::size_t bytes = 0;
  for (const MemoryRow& row : stage.sky->memory(stage.view)) bytes += row.name.starts_with("grid") ? row.bytes : 0;
  EXPECT_GT(bytes, 10000u);
  scene.grids.clear();
  stage.sky->setScene(scene);
  for (const MemoryRow& row : stage.sky->memory(stage.view)) EXPECT_FALSE(row.name.starts_with("grid")) << row.name;
}

}  // namespace
}  // namespace welkin::realtime::test
