#include "welkin/scene/environment.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/angle.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin {
namespace {

glm::dvec3 toward(double heading, double elevation) {  // degrees
  const double h = heading * kPi / 180.0, e = elevation * kPi / 180.0;
  return {std::sin(h) * std::cos(e), std::cos(h) * std::cos(e), std::sin(e)};
}

EnvironmentPixels pixelsOf(EnvironmentLayout layout, int width, double centerHeading = 0.0) {
  return {environmentCameras(Camera{}, layout, centerHeading), width};
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(CameraRays, PointWhereTheHeadingAndPitchSay) {
  for (const Projection projection : {Projection::perspective, Projection::equirectangular}) {
    const Camera camera{.projection = projection, .heading = 1.9f, .pitch = 0.3f, .roll = 0.0f};
    const law::CameraParams p = cameraParams(camera, 2.0);
    const glm::dvec3 centre = glm::normalize(law::cameraRay({0.0f, 0.0f}, p));
    expectNear(centre, toward(1.9 * 180 / kPi, 0.3 * 180 / kPi), 1e-6);
    const glm::dvec3 right = law::cameraRay({0.01f, 0.0f}, p), above = law::cameraRay({0.0f, 0.01f}, p);
    EXPECT_GT(glm::dot(right, toward(1.9 * 180 / kPi + 90.0, 0.0)), 0.0);
    EXPECT_GT(glm::normalize(above).z, centre.z);
  }
}

TEST(CameraRays, HaveAnInverse) {
  for (const Projection projection : {Projection::perspective, Projection::equirectangular}) {
    const Camera camera{.projection = projection, .heading = -2.5f, .pitch = 0.7f, .roll = 0.4f, .fov = 1.5f};
    const law::CameraParams p = cameraParams(camera, 1.7);
    for (double y = -0.95; y < 1.0; y += 0.1)
      for (double x = -0.95; x < 1.0; x += 0.1) {
        const glm::dvec2 back = pictureFromDirection(p, glm::dvec3(law::cameraRay(glm::vec2(x, y), p)));
        ASSERT_NEAR(back.x, x, 2e-6);
        ASSERT_NEAR(back.y, y, 2e-6);
      }
  }
  EXPECT_TRUE(std::isinf(pictureFromDirection(cameraParams(Camera{}, 1.0), {0.0, -1.0, 0.0}).x));
}

// Seen from inside, zenith on top: east stands right of north.
TEST(Environment, LatlongHasItsHeadingInTheMiddleAndTheNextToTheRight) {
  for (const double centre : {0.0, 90.0, 180.0, 287.0}) {
    const EnvironmentPixels p = pixelsOf(EnvironmentLayout::latlong, 400, centre * kPi / 180.0);
    ASSERT_EQ(p.height(), 200);
    expectNear(p.direction(200, 100), toward(centre, 0), 1e-6);
    expectNear(p.direction(300, 100), toward(centre + 90, 0), 1e-6);
    expectNear(p.direction(100, 100), toward(centre - 90, 0), 1e-6);
    expectNear(p.direction(200, 50), toward(centre, 45), 1e-6);
    expectNear(p.direction(0, 100), p.direction(400, 100), 1e-6);
    expectNear(p.direction(123, 0), {0, 0, 1}, 1e-6);
    expectNear(p.direction(321, 200), {0, 0, -1}, 1e-6);
  }
}

TEST(Environment, PixelsCoverTheSphere) {
  for (const EnvironmentLayout layout : {EnvironmentLayout::latlong, EnvironmentLayout::cube}) {
    const EnvironmentPixels p = pixelsOf(layout, 128, 1.0);
    double sphere = 0.0, up = 0.0;
    for (int y = 0; y < p.height(); ++y)
      for (int x = 0; x < p.width(); ++x) {
        sphere += p.solidAngle(x, y);
        up += p.solidAngle(x, y) * std::max(p.direction(x + 0.5, y + 0.5).z, 0.0);
      }
    EXPECT_NEAR(sphere / (4 * kPi), 1.0, 1e-4);
    EXPECT_NEAR(up / kPi, 1.0, 1e-3);  // a midpoint rule where the cosine has its kink
  }
}

struct Sunny {
  DirectionalLight sun{toward(70, 35), {100.0, 90.0, 75.0}};
  EnvironmentPixels pixels;
  Image sky;
  std::vector<SunPixel> disc;

  Sunny(EnvironmentLayout layout, int width)
      : pixels(pixelsOf(layout, width, 0.3)), sky(pixels.width(), pixels.height(), 3), disc(sunPixels(pixels, sun)) {
    for (float& v : sky.pixels) v = 2.0f;
  }
};

// Of the red channel, over all directions.
double sum(const Sunny& s) {
  double all = 0.0;
  for (int y = 0; y < s.pixels.height(); ++y)
    for (int x = 0; x < s.pixels.width(); ++x) all += s.sky.at(x, y)[0] * s.pixels.solidAngle(x, y);
  return all;
}

// Whatever becomes of the sun, map and lost light together hold as much as before; and they light a plane as before
// where the pixels are small against the cosine (half a pixel at 512 is 0.6 % of it here).
TEST(Environment, NoTreatmentOfTheSunLosesLight) {
  for (const EnvironmentLayout layout : {EnvironmentLayout::latlong, EnvironmentLayout::cube})
    for (const int width : {32, 64, 512})
      for (const SunTreatment& treatment :
           {SunTreatment{SunStyle::full, 0, 1e38}, SunTreatment{SunStyle::soft, 0, 65504},
            SunTreatment{SunStyle::clamp, 50, 65504}, SunTreatment{SunStyle::none, 0, 65504}}) {
        Sunny s(layout, width);
        const double skyRed = sum(s);
        const glm::dvec3 before = upwardIrradiance(s.sky, s.pixels) + s.sun.illuminance * s.sun.direction.z;
        const auto lost = addSun(s.sky, s.pixels, s.sun, s.disc, treatment);
        glm::dvec3 after = upwardIrradiance(s.sky, s.pixels);
        if (lost) after += lost->illuminance * lost->direction.z;
        const double sphere = sum(s);
        const std::string where = fmt::format("style {} width {}", static_cast<int>(treatment.style), width);
        EXPECT_NEAR((sphere + (lost ? lost->illuminance[0] : 0.0)) / (skyRed + s.sun.illuminance[0]), 1.0, 1e-3)
            << where;
        for (int k = 0; k < 3 && width == 512; ++k) EXPECT_NEAR(after[k] / before[k], 1.0, 0.01) << where;
        const float most = *std::max_element(s.sky.pixels.begin(), s.sky.pixels.end());
        switch (treatment.style) {
          case SunStyle::full:
            EXPECT_FALSE(lost);
            EXPECT_GT(most, width == 512 ? 1e5f : 100.0f);
            break;
          case SunStyle::soft:
            EXPECT_LE(most, 65504.0f);
            EXPECT_FALSE(lost);
            EXPECT_GT(most, 100.0f);
            break;
          case SunStyle::clamp:
            for (std::size_t i = 0; i < s.sky.pixels.size(); i += 3)
              ASSERT_LE(0.2126f * s.sky.pixels[i] + 0.7152f * s.sky.pixels[i + 1] + 0.0722f * s.sky.pixels[i + 2],
                        50.001f);
            ASSERT_TRUE(lost);
            EXPECT_GT(glm::dot(lost->direction, s.sun.direction), std::cos(8.0 / width));
            break;
          case SunStyle::none:
            EXPECT_EQ(most, 2.0f);
            ASSERT_TRUE(lost);
            expectNear(lost->direction, s.sun.direction, 1e-9);
            expectNear(lost->illuminance, s.sun.illuminance, 1e-9);
            break;
        }
      }
}

TEST(Environment, TheSunsPixelLiesWhereTheSunStands) {
  Sunny s(EnvironmentLayout::latlong, 1024);
  addSun(s.sky, s.pixels, s.sun, s.disc, {SunStyle::full, 0, 1e38});
  const auto brightest =
      static_cast<std::size_t>(std::max_element(s.sky.pixels.begin(), s.sky.pixels.end()) - s.sky.pixels.begin()) / 3;
  // Heading 70 from a centre at 0.3 rad; elevation 35.
  const double u = 0.5 + (70.0 - 0.3 * 180 / kPi) / 360.0, v = 0.5 - 35.0 / 180.0;
  EXPECT_NEAR(static_cast<double>(brightest % 1024), u * 1024, 2.0);
  EXPECT_NEAR(static_cast<double>(brightest / 1024), v * 512, 2.0);
}

TEST(Environment, CloudsDimTheSunThatIsHandedOn) {
  Sunny s(EnvironmentLayout::latlong, 128);
  for (SunPixel& p : s.disc) p.transmittance = 0.25f;
  const auto lost = addSun(s.sky, s.pixels, s.sun, s.disc, {SunStyle::none, 0, 65504});
  ASSERT_TRUE(lost);
  expectNear(lost->illuminance, 0.25 * s.sun.illuminance, 1e-9);
}

TEST(Environment, ANightHasNoSun) {
  Sunny s(EnvironmentLayout::latlong, 128);
  s.sun.illuminance = glm::dvec3(0.0);
  EXPECT_TRUE(sunPixels(s.pixels, s.sun).empty());
  EXPECT_FALSE(addSun(s.sky, s.pixels, s.sun, {}, {SunStyle::none, 0, 65504}));
}

}  // namespace
}  // namespace welkin
