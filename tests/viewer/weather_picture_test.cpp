#include "apps/viewer/model/weather_picture.hpp"

#include <gtest/gtest.h>

#include "apps/viewer/model/document.hpp"
#include "apps/viewer/model/weather_view.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/weather_map.hpp"

namespace welkin::viewer {
namespace {

using Pointer = Document::WeatherPicturePointer;

Pointer even(float coverage) { return std::make_shared<WeatherPicture>(100, 70, glm::vec4(coverage, 0, 0.5f, 0)); }

double sumOf(const WeatherPicture& picture, int channel) {
  double sum = 0.0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sum += static_cast<double>(picture.at(x, y, channel));
  return sum;
}

TEST(WeatherPicture, KeepsWhatAPngKeeps) {
  Volume map(70, 130, 1, 4);
  for (std::size_t i = 0; i < map.texels.size(); ++i) map.texels[i] = static_cast<float>(i * 7919 % 65536) / 65535.0f;
  const WeatherPicture picture(map);
  EXPECT_EQ(picture.volume().texels, map.texels);
  const std::vector<std::uint16_t> samples = picture.samples();  // north first
  EXPECT_EQ(samples[4], std::lround(65535.0f * map.at(1, 129, 0)[0]));
  EXPECT_THROW(WeatherPicture(Volume(WeatherPicture::kLargest + 1, 1, 1, 4)), Error);
}

TEST(WeatherPicture, ADabIsSoftRoundAndOfOneChannel) {
  WeatherPicture picture(100, 70, glm::vec4(0.2f));
  picture.dab(1, {50.5, 30.5}, {10.0, 5.0}, 0.5f, 1.0f);
  EXPECT_NEAR(picture.at(50, 30, 1), 0.6f, 1e-4f);
  EXPECT_GT(picture.at(50, 30, 1), picture.at(55, 30, 1));
  EXPECT_EQ(picture.at(55, 30, 1), picture.at(45, 30, 1));
  EXPECT_GT(picture.at(57, 30, 1), 0.21f);
  EXPECT_EQ(picture.at(50, 37, 1), picture.at(0, 0, 1));  // the other radius is shorter
  EXPECT_EQ(picture.at(50, 30, 0), picture.at(0, 0, 0));
}

TEST(WeatherPicture, WhatReachesOverAnEdgeComesInAtTheOther) {
  WeatherPicture corner(100, 70, glm::vec4(0.0f)), middle(100, 70, glm::vec4(0.0f));
  corner.dab(0, {0.5, 69.5}, {12.0, 12.0}, 1.0f, 1.0f);
  middle.dab(0, {50.5, 30.5}, {12.0, 12.0}, 1.0f, 1.0f);
  EXPECT_NEAR(sumOf(corner, 0), sumOf(middle, 0), 0.01);
  EXPECT_GT(corner.at(97, 2, 0), 0.5f);
  // Wider than the picture: every texel once.
  WeatherPicture whole(100, 70, glm::vec4(0.0f));
  whole.dab(0, {20.0, 20.0}, {1e6, 1e6}, 0.5f, 1.0f);
  EXPECT_NEAR(whole.at(80, 60, 0), 0.5f, 1e-4f);
  EXPECT_NEAR(whole.at(20, 20, 0), 0.5f, 1e-4f);
}

TEST(WeatherPicture, AStrokeIsTheSameHoweverFastTheHandIs) {
  const Brush brush{.radius = 4000.0f, .strength = 0.3f};
  WeatherPicture fast = *even(0.0f), slow = *even(0.0f);
  Stroke leap, creep;
  leap.follow(fast, brush, 60000.0, {-15000, 0});
  leap.follow(fast, brush, 60000.0, {15000, 0});
  for (int i = 0; i <= 300; ++i) creep.follow(slow, brush, 60000.0, {-15000.0 + 100.0 * i, 0});
  EXPECT_NEAR(sumOf(fast, 0) / sumOf(slow, 0), 1.0, 0.02);
  // Over the middle of the land, and nothing north of it.
  EXPECT_GT(fast.at(50, 35, 0), 0.5f);
  EXPECT_EQ(fast.at(50, 55, 0), 0.0f);
}

TEST(WeatherPicture, CopiesArePaintedApart) {
  const WeatherPicture before(100, 70, glm::vec4(0.5f));
  WeatherPicture after = before;
  after.dab(0, {10, 10}, {5, 5}, 1.0f, 0.0f);
  EXPECT_EQ(sumOf(before, 0), sumOf(WeatherPicture(100, 70, glm::vec4(0.5f)), 0));
  EXPECT_LT(sumOf(after, 0), sumOf(before, 0));
}

TEST(PaintedDocument, AStrokeIsOneStepAndTheFileItBeganWithStaysItself) {
  Document document{Scene{}};
  document.edit("map", [](Scene& s) { s.layers[0].weather.map = "coverage.png"; });
  const Pointer file = even(0.5f), once = even(0.6f), twice = even(0.7f);
  document.keepWeather("coverage.png", file);
  EXPECT_FALSE(document.unsavedWeather(0));
  document.beginGesture();
  document.paintWeather(0, once);
  document.paintWeather(0, twice);
  document.endGesture();
  EXPECT_NE(document.scene().layers[0].weather.map, "coverage.png");
  EXPECT_EQ(document.weatherPicture(0), twice);
  EXPECT_TRUE(document.unsavedWeather(0));
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(document.scene().layers[0].weather.map, "coverage.png");
  EXPECT_EQ(document.weatherPicture(0), file);
  EXPECT_TRUE(document.redo());
  EXPECT_EQ(document.weatherPicture(0), twice);
}

TEST(PaintedDocument, AfterSavingAnOlderPictureIsUnsavedAgain) {
  Document document{Scene{}};
  const Pointer first = even(0.6f), second = even(0.7f);
  document.paintWeather(0, first);
  document.wroteWeather(0, "evening.weather0.png");
  document.saved("evening.sky.toml");
  EXPECT_EQ(document.scene().layers[0].weather.map, "evening.weather0.png");
  EXPECT_FALSE(document.modified());
  document.paintWeather(0, second);
  EXPECT_TRUE(document.modified());
  document.wroteWeather(0, "evening.weather0.png");  // over the first
  document.saved("evening.sky.toml");
  EXPECT_FALSE(document.modified());
  document.undo();
  EXPECT_EQ(document.weatherPicture(0), first);
  EXPECT_TRUE(document.modified());
  EXPECT_TRUE(document.unsavedWeather(0));
}

TEST(PaintedDocument, OpeningReadsFilesAnewAndUndoingThatGoesBack) {
  Document document{Scene{}};
  document.paintWeather(0, even(0.6f));
  document.wroteWeather(0, "a.png");
  Scene other;
  other.layers[0].weather.map = "a.png";
  const Pointer before = document.weatherPicture(0);
  document.open(other, {});
  EXPECT_EQ(document.weatherPicture(0), nullptr);
  document.keepWeather("a.png", even(0.1f));
  document.undo();
  EXPECT_EQ(document.weatherPicture(0), before);
}

// The clouds stand where they are shown: what bakeWeather() finds at a place is white there, north up.
TEST(WeatherImage, ShowsPaintAndCloudsWhereTheyAre) {
  Layer layer;
  layer.weather.map = "painted";
  WeatherPicture picture(64, 64, glm::vec4(0, 0, 0.5f, 0));
  // A patch 15 km east and 20 km north of the origin.
  picture.dab(0, glm::dvec2(15000, 20000) / 60000.0 * 64.0 + 32.0, {8, 8}, 1.0f, 1.0f);
  const Volume map = picture.volume();
  const Drift drift{10.0, 1.0, 100.0};
  const WeatherView view{.centre = {0, 0}, .edge = 60000.0, .size = 60, .clouds = false};
  const std::vector<std::uint8_t> image = weatherImage(layer, &map, drift, 7, view);
  const glm::dvec2 at = glm::dvec2(15000, 20000) + driftOffset(drift);
  const auto x = static_cast<std::size_t>(30 + at.x / 1000), y = static_cast<std::size_t>(30 - at.y / 1000);
  const auto blue = [&](std::size_t i, std::size_t j) { return image[(j * 60 + i) * 4 + 2]; };
  EXPECT_GT(blue(x, y), 180);
  EXPECT_LT(blue(59 - x, y), 60);
  EXPECT_LT(blue(x, 59 - y), 60);

  WeatherView withClouds = view;
  withClouds.clouds = true;
  const std::vector<std::uint8_t> clouds = weatherImage(layer, &map, drift, 7, withClouds);
  const Volume weather = bakeWeather(layer, {0, 0}, 60000.0, 60, drift, 7, &map);
  int white = 0;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i)
      if (weather.at(i, j, 0)[0] > 0.3f * layer.cloud.thickness) {
        ++white;
        EXPECT_GT(clouds[static_cast<std::size_t>((59 - j) * 60 + i) * 4], 100);
      }
  EXPECT_GT(white, 5);
}

}  // namespace
}  // namespace welkin::viewer
