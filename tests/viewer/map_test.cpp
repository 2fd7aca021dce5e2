// The camera over a map, and the map of our own land.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "apps/viewer/flight/land_map.hpp"
#include "apps/viewer/model/map_camera.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin::viewer {
namespace {

glm::dvec3 pointUnder(const Camera& camera, double x = 0.0) {
  const glm::dmat3 axes = cameraAxes(camera);
  const glm::dvec3 ray = axes[2] + axes[0] * x * std::tan(0.5 * static_cast<double>(camera.fov));
  return camera.position - ray * (camera.position.z / ray.z);
}

const MapPicture kMap{.picture = {}, .corner = {1000, -4000}, .size = {20000, 10000}};

TEST(MapCamera, HangsOverTheMiddleAndFillsThePicture) {
  const Camera camera = cameraOver(Camera{}, kMap, 2.0);
  // A right angle in single precision is off by some millimetres on the ground.
  EXPECT_NEAR(camera.position.x, 11000.0, 0.01);
  EXPECT_NEAR(camera.position.y, 1000.0, 0.01);
  EXPECT_NEAR(pointUnder(camera, 1.0).x, 21000.0, 1.0);
  EXPECT_NEAR(cameraAxes(camera)[1].y, 1.0, 1e-6);  // north is up
}

TEST(MapCamera, TheGroundGoesAlongWithThePointer) {
  Camera camera = cameraOver(Camera{}, kMap, 2.0);
  swingMap(camera, {0.1f, -0.15f});
  const glm::dvec3 before = pointUnder(camera);
  slideMap(camera, {0.25f, 0.0f});  // what was in the middle stands half the way to the right edge
  EXPECT_NEAR(glm::distance(pointUnder(camera, 0.5), before), 0.0, 2.0);
}

TEST(MapCamera, TurningAndZoomingKeepThePointInTheMiddle) {
  Camera camera = cameraOver(Camera{}, kMap, 2.0);
  const glm::dvec3 middle = pointUnder(camera);
  swingMap(camera, {0.2f, -0.2f});
  EXPECT_LT(camera.position.z, 20000.0);
  zoomMap(camera, 3.0f);
  EXPECT_NEAR(glm::distance(pointUnder(camera), middle), 0.0, 1.0);
}

TEST(MapCamera, NothingLeavesTheAir) {
  std::mt19937 random(5);
  Camera camera;
  camera.pitch = 1.2f;  // from a view of the sky
  const auto any = [&] { return static_cast<float>(random() % 2001) / 500.0f - 2.0f; };
  for (int i = 0; i < 5000; ++i) {
    if (random() % 3 == 0) slideMap(camera, {any(), any()});
    if (random() % 3 == 0) swingMap(camera, {any(), any()});
    if (random() % 3 == 0) zoomMap(camera, 20.0f * any());
    ASSERT_TRUE(std::isfinite(camera.position.x) && std::isfinite(camera.heading));
    ASSERT_GE(camera.position.z, 2.0);
    ASSERT_LE(camera.position.z, 100e3);
    ASSERT_LE(std::abs(camera.position.x), 2e7);
  }
}

TEST(LandMap, ShowsTheSeaWhereTheSeaIs) {
  const Terrain terrain;
  const MapPicture map = landMap(terrain, 60000.0, 96);
  int seas = 0, lands = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const float* c = map.picture.at(x, y);
      const double height =
          terrain.height(map.corner.x + (x + 0.5) * 625.0, map.corner.y + 60000.0 - (y + 0.5) * 625.0);
      ASSERT_TRUE(std::isfinite(c[0]) && c[0] >= 0.0f && c[0] <= 1.0f);
      const bool sea = height<-5.0, land = height> 50.0 && height < 900.0;
      ASSERT_TRUE(!sea || c[2] > c[0]);
      ASSERT_TRUE(!land || c[1] > c[2]);
      seas += sea;
      lands += land;
    }
  EXPECT_GT(seas, 100);
  EXPECT_GT(lands, 100);
}

}  // namespace
}  // namespace welkin::viewer
