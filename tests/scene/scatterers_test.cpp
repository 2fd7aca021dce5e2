#include "welkin/scene/scatterers.hpp"

#include <gtest/gtest.h>

namespace welkin {
namespace {

TEST(LeadingScatterers, AreOfTheFirstKindThatThereIs) {
  Scene scene;
  scene.layers.clear();
  EXPECT_FALSE(leadingScatterers(scene));
  scene.grids.push_back({.albedo = 0.1f});
  EXPECT_FALSE(leadingScatterers(scene)) << "a volume without a file is no cloud";
  scene.grids.push_back({.file = "cloud.vdb", .albedo = 0.2f});
  EXPECT_EQ(leadingScatterers(scene)->albedo, 0.2f);
  scene.heroes.resize(1);
  scene.heroes.front().cloud.albedo = 0.3f;
  EXPECT_EQ(leadingScatterers(scene)->albedo, 0.3f);
  scene.classical.resize(1);
  scene.classical.front().cloud.albedo = 0.4f;
  EXPECT_EQ(leadingScatterers(scene)->albedo, 0.4f);
  Layer layer;
  layer.cloud.albedo = 0.5f;
  layer.cloud.dropletDiameter = 20.0f;
  scene.layers.push_back(layer);
  EXPECT_EQ(leadingScatterers(scene)->albedo, 0.5f);
  EXPECT_EQ(leadingScatterers(scene)->dropletDiameter, 20.0f);
  EXPECT_EQ(meanCosine(leadingScatterers(scene)->phase), meanCosine(phaseOf(layer.cloud)));
}

}  // namespace
}  // namespace welkin
