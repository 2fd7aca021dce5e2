#include "welkin/base/progress.hpp"

#include <gtest/gtest.h>

namespace welkin {
namespace {

TEST(Progress, ACallbackCancelsByAnsweringFalse) {
  EXPECT_NO_THROW(report({}, 0.5));
  EXPECT_NO_THROW(report([](double) { return true; }, 0.5));
  EXPECT_THROW(report([](double) { return false; }, 0.5), Cancelled);
}

TEST(Progress, StagesFillTheirShare) {
  double seen = -1;
  const Progress whole = [&](double done) {
    seen = done;
    return true;
  };
  report(stageOf(whole, 0.2, 0.6), 0.5);
  EXPECT_DOUBLE_EQ(seen, 0.4);
  report(stageOf(whole, 0.2, 0.6), 7.0);
  EXPECT_DOUBLE_EQ(seen, 0.6);
  EXPECT_FALSE(stageOf({}, 0, 1));
}

TEST(Progress, ALineSaysShareRateAndRest) {
  EXPECT_EQ(progressLine("rendering", 0.0, 0.0), "rendering   0 %  0.0 s");
  EXPECT_EQ(progressLine("rendering", 0.25, 5.0), "rendering  25 %  5.0 s, 5.0 %/s, 15.0 s left");
  EXPECT_EQ(progressLine("rendering", 0.5, 4000.0), "rendering  50 %  1 h 06 min, 0.0 %/s, 1 h 06 min left");
  EXPECT_EQ(progressLine("rendering", 1.0, 125.0), "rendering 100 %  2 min 05 s");
}

TEST(Progress, LinesComeAtEveryTenth) {
  testing::internal::CaptureStderr();
  {
    ProgressDisplay display("baking", ProgressStyle::lines);
    const Progress callback = display.callback();
    for (int i = 0; i <= 1000; ++i) report(callback, i / 1000.0);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, QuietShowsNothing) {
  testing::internal::CaptureStderr();
  ProgressDisplay display("baking", ProgressStyle::quiet);
  report(display.callback(), 1.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, ABarRedrawsItsLineAndCleansUp) {
  testing::internal::CaptureStderr();
  {
    ProgressDisplay display("baking", ProgressStyle::bar);
    report(display.callback(), 0.5);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("\r[############............] baking  50 %"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace welkin
