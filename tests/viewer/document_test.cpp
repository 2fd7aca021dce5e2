#include "apps/viewer/model/document.hpp"

#include <gtest/gtest.h>

namespace welkin::viewer {
namespace {

TEST(Document, AChangeIsOneStepThatCanBeUndoneAndDoneAgain) {
  Document document{Scene{}};
  EXPECT_FALSE(document.modified());
  EXPECT_EQ(document.set("layer.0.weather", "coverage", 0.75), "");
  EXPECT_FLOAT_EQ(document.scene().layers[0].weather.coverage, 0.75f);
  EXPECT_TRUE(document.modified());
  EXPECT_EQ(document.undoName(), "layer.0.weather.coverage");
  EXPECT_TRUE(document.undo());
  EXPECT_FLOAT_EQ(document.scene().layers[0].weather.coverage, Scene{}.layers[0].weather.coverage);
  EXPECT_FALSE(document.modified());
  EXPECT_FALSE(document.undo());
  EXPECT_TRUE(document.redo());
  EXPECT_FLOAT_EQ(document.scene().layers[0].weather.coverage, 0.75f);
}

TEST(Document, ARefusedValueChangesNothingAndSaysWhy) {
  Document document{Scene{}};
  const int revision = document.revision();
  EXPECT_NE(document.set("layer.0.weather", "coverage", 1.5).find("outside"), std::string::npos);
  EXPECT_NE(document.set("layer.0.weather", "coverge", 0.5), "");
  EXPECT_NE(document.set("layer.7", "base", 100.0), "");
  EXPECT_NE(document.set("sun", "date", std::string("2026-02-30")), "");
  EXPECT_FALSE(document.canUndo());
  EXPECT_EQ(document.revision(), revision);
}

TEST(Document, TheSameValueIsNoStep) {
  Document document{Scene{}};
  EXPECT_EQ(document.set("wind", "speed", 8.0), "");
  EXPECT_FALSE(document.canUndo());
}

TEST(Document, AGestureIsOneStep) {
  Document document{Scene{}};
  document.beginGesture();
  for (const double speed : {9.0, 12.0, 15.0}) document.set("wind", "speed", speed);
  document.set("wind", "from", 10.0);
  document.endGesture();
  document.set("wind", "speed", 20.0);
  EXPECT_TRUE(document.undo());
  EXPECT_FLOAT_EQ(document.scene().wind.speed, 15.0f);
  EXPECT_TRUE(document.undo());
  EXPECT_FLOAT_EQ(document.scene().wind.speed, 8.0f);
  EXPECT_FALSE(document.canUndo());
}

TEST(Document, UndoLeavesCameraAndTimeWhereTheyAre) {
  Document document{Scene{}};
  document.set("wind", "speed", 20.0);
  Camera camera = document.scene().camera;
  camera.position.z = 777.0;
  document.moveCamera(camera);
  document.moveTime(5.0f);
  document.undo();
  EXPECT_EQ(document.scene().camera.position.z, 777.0);
  EXPECT_EQ(document.scene().time, 5.0f);
}

TEST(Document, ButAStepAboutTheCameraIsUndone) {
  Document document{Scene{}};
  const float pitch = document.scene().camera.pitch;
  document.set("camera", "pitch", 30.0);
  document.undo();
  EXPECT_EQ(document.scene().camera.pitch, pitch);
}

TEST(Document, ListsGrowAndShrink) {
  Document document{Scene{}};
  document.edit("add layer", [](Scene& s) { s.layers.emplace_back(); });
  document.set("layer.1", "base", 5000.0);
  document.undo();
  document.undo();
  EXPECT_EQ(document.scene().layers.size(), 1u);
  document.redo();
  document.redo();
  ASSERT_EQ(document.scene().layers.size(), 2u);
  EXPECT_FLOAT_EQ(document.scene().layers[1].cloud.base, 5000.0f);
}

TEST(Document, ANewChangeForgetsWhatWasUndone) {
  Document document{Scene{}};
  document.set("wind", "speed", 20.0);
  document.undo();
  document.set("wind", "from", 90.0);
  EXPECT_FALSE(document.canRedo());
}

TEST(Document, OpeningIsAStepAndAsCleanAsBefore) {
  Document document{Scene{}, {"", ""}};
  Scene other;
  other.seed = 9;
  document.open(other, {"other.sky.toml", "other.sky.toml"});
  EXPECT_FALSE(document.modified());
  EXPECT_EQ(document.origin().file, "other.sky.toml");
  document.undo();
  EXPECT_EQ(document.origin().file, "");
  EXPECT_EQ(document.scene().seed, 1);
  EXPECT_FALSE(document.modified());
}

TEST(Document, AResetSectionHasItsDefaults) {
  Document document{Scene{}};
  document.set("layer.0.profile", "detail", 300.0);
  document.set("layer.0.profile", "warp", 0.0);
  document.resetSection("layer.0.profile");
  EXPECT_TRUE(sameFields(document.scene().layers[0].profile, ProfileSettings{}));
  document.undo();
  EXPECT_FLOAT_EQ(document.scene().layers[0].profile.detail, 300.0f);
  document.set("quality", "preset", std::string("low"));
  document.set("quality", "light_steps", std::int64_t{3});
  document.resetSection("quality");
  EXPECT_EQ(document.scene().quality, qualityPreset(QualityPreset::low));
}

}  // namespace
}  // namespace welkin::viewer
