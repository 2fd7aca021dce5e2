// The governor against simulated renderers, and its rungs on a real one.
#include "welkin/realtime/governor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <random>

#include "tests/realtime/stage.hpp"
#include "welkin/base/error.hpp"

namespace welkin::realtime::test {
namespace {

constexpr double kTarget = 0.016;

// A renderer whose frames of quality high take `high` s, and a host that takes `rest` s besides. Times arrive `lag`
// frames late, off by `noise`.
struct Machine {
  double high = 0.01, rest = 0.0, noise = 0.0;
  std::size_t lag = 0;
  std::mt19937 random{7};
  std::deque<double> pending{};

  double timeOf(const Quality& q) const { return rest + high * relativeCost(q); }
  // Runs so many frames and returns how many times the governor has changed.
  int run(Governor& governor, int frames) {
    std::normal_distribution<double> bell(1.0, noise > 0.0 ? noise : 1.0);
    int changes = 0;
    for (int i = 0; i < frames; ++i) {
      pending.push_back(timeOf(governor.quality()) * (noise > 0.0 ? bell(random) : 1.0));
      if (pending.size() <= lag) continue;
      changes += governor.take(pending.front()) ? 1 : 0;
      pending.pop_front();
    }
    return changes;
  }
};

Governor governorFor(double target = kTarget) {
  GovernorSettings settings;
  settings.target = target;
  return Governor(settings);
}

TEST(Governor, RungsGoFromTheBestToTheWorstAndAlwaysGetCheaper) {
  for (const QualityPreset preset : {QualityPreset::ultra, QualityPreset::high, QualityPreset::medium}) {
    GovernorSettings settings;
    settings.best = qualityPreset(preset);
    const Governor governor(settings);
    const std::vector<Quality>& rungs = governor.rungs();
    EXPECT_EQ(rungs.front(), settings.best);
    EXPECT_GT(rungs[1].lightFrames, rungs[0].lightFrames) << "light gives way first";
    EXPECT_EQ(rungs.back().lightFrames, settings.worst.lightFrames);
    EXPECT_EQ(rungs.back().stepScale, settings.worst.stepScale);
    EXPECT_EQ(rungs.back().historyScale, settings.worst.historyScale);
    EXPECT_EQ(rungs.back().interleave, settings.worst.interleave);
    EXPECT_GE(rungs.size(), 6u);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      EXPECT_EQ(rungs[i].preset, preset);
      if (i > 0) {
        EXPECT_LT(relativeCost(rungs[i]), relativeCost(rungs[i - 1])) << i;
      }
    }
  }
}

TEST(Governor, BoundsThatLeaveNothingToTradeAreOneRung) {
  GovernorSettings settings;
  settings.worst = settings.best;
  settings.target = 1e-6;
  Governor governor(settings);
  EXPECT_EQ(governor.rungs().size(), 1u);
  EXPECT_EQ(Machine{}.run(governor, 500), 0);
}

TEST(Governor, StaysAtTheBestWhereThereIsTime) {
  Governor governor = governorFor();
  Machine machine{.high = 0.012, .noise = 0.1};
  EXPECT_EQ(machine.run(governor, 2000), 0);
  EXPECT_EQ(governor.rung(), 0u);
}

TEST(Governor, HoldsTheTargetWithoutOscillation) {
  for (const std::size_t lag : {0u, 3u})
    for (const double rest : {0.0, 0.004, 0.008}) {
      Governor governor = governorFor();
      Machine machine{.high = 0.02, .rest = rest, .noise = 0.05, .lag = lag};
      machine.run(governor, 300);
      const double found = machine.timeOf(governor.quality());
      EXPECT_LE(found, 1.04 * kTarget) << rest;
      // No rung above it would have done: not lower than it must be by more than one.
      if (governor.rung() > 1) {
        EXPECT_GT(machine.timeOf(governor.rungs()[governor.rung() - 2]), 0.85 * kTarget) << rest;
      }
      EXPECT_LE(machine.run(governor, 3000), 8) << rest << " with lag " << lag;
    }
}

TEST(Governor, ReactsToALastingLoadWithinSomeFramesAndComesBackAfterIt) {
  Governor governor = governorFor();
  Machine machine{.high = 0.012};
  machine.run(governor, 200);
  ASSERT_EQ(governor.rung(), 0u);
  machine.high = 0.028;
  machine.run(governor, 4);  // of the last five frames three are long
  EXPECT_GT(governor.rung(), 0u);
  machine.run(governor, 12);
  EXPECT_LE(machine.timeOf(governor.quality()), 1.03 * kTarget);
  machine.high = 0.008;
  machine.run(governor, 600);
  EXPECT_EQ(governor.rung(), 0u);
}

TEST(Governor, IsNotFooledBySingleLongFrames) {
  Governor governor = governorFor();
  Machine machine{.high = 0.014};
  int changes = machine.run(governor, 30);
  for (int i = 0; i < 40; ++i) {  // now and then two in a row, a hundred times too long
    changes += governor.take(1.6) ? 1 : 0;
    changes += governor.take(1.2) ? 1 : 0;
    changes += machine.run(governor, 8);
  }
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(governor.rung(), 0u);
}

TEST(Governor, ACutStartsItsJudgementAnew) {
  Governor governor = governorFor();
  Machine machine{.high = 0.014};
  machine.run(governor, 50);
  for (int i = 0; i < 20; ++i) {
    governor.cut();
    for (int k = 0; k < 4; ++k) EXPECT_FALSE(governor.take(0.3));
    EXPECT_EQ(machine.run(governor, 30), 0);
  }
  EXPECT_EQ(governor.rung(), 0u);
}

// Twice as dear for 40 frames, then cheap for 40: the better quality is tried later and later instead of at every turn.
TEST(Governor, ComesToRestUnderALoadThatComesAndGoes) {
  Governor governor = governorFor();
  Machine machine{.high = 0.012};
  int early = 0, late = 0;
  for (int i = 0; i < 80; ++i) {
    machine.high = i % 2 == 0 ? 0.024 : 0.012;
    (i < 40 ? early : late) += machine.run(governor, 40);
  }
  EXPECT_LE(late, 60);
  EXPECT_LE(late, early);
}

TEST(Governor, EndsAtTheWorstWhenNothingIsEnough) {
  Governor governor = governorFor();
  Machine machine{.high = 1.0};
  machine.run(governor, 60);
  EXPECT_EQ(governor.rung(), governor.rungs().size() - 1);
  EXPECT_EQ(machine.run(governor, 1000), 0);
}

TEST(Governor, GivesUpResolutionOnlyWhereItMay) {
  GovernorSettings settings;
  settings.target = kTarget;
  settings.leastScale = 0.5f;
  Governor governor(settings), whole = governorFor();
  Machine machine{.high = 1.0}, other{.high = 1.0};
  EXPECT_EQ(governor.scale(), 1.0f);
  machine.run(governor, 200);
  other.run(whole, 200);
  EXPECT_LT(governor.scale(), 0.6f);
  EXPECT_GE(governor.scale(), 0.495f);
  EXPECT_EQ(whole.scale(), 1.0f);
  EXPECT_EQ(governor.rungs().back(), whole.rungs().back());
  machine.high = 0.001;
  machine.run(governor, 1000);
  EXPECT_EQ(governor.scale(), 1.0f) << "and takes it again when there is time";
}

TEST(Governor, PassesOverNumbersThatAreNoTimes) {
  Governor governor = governorFor();
  for (int i = 0; i < 100; ++i)
    for (const double t : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
      EXPECT_FALSE(governor.take(t));
  for (const double target : {0.0, -0.01, std::nan("")}) {
    EXPECT_THROW(governorFor(target), Error);
    EXPECT_THROW(governor.setTarget(target), Error);
  }
}

TEST(Governor, TakesAnotherTarget) {
  Governor governor = governorFor();
  Machine machine{.high = 0.012};
  machine.run(governor, 60);
  governor.setTarget(0.008);
  machine.run(governor, 60);
  EXPECT_LE(machine.timeOf(governor.quality()), 1.03 * 0.008);
  governor.setTarget(0.05);
  machine.run(governor, 600);
  EXPECT_EQ(governor.rung(), 0u);
}

// Every rung after the other on one view of a camera that turns: the frame of the change is as near to the full march
// as one of a view that has always had that quality, and nearer than the first of a view that begins.
TEST(Governor, ChangesQualityWithoutABreakInThePicture) {
  Stage stage(128, 72);
  Scene scene;
  makeSmall(scene);
  scene.camera.pitch = 0.3f;
  GovernorSettings settings;
  settings.best = scene.quality;
  stage.sky->setScene(scene);
  const auto draw = [&](View& view, int frame) {
    scene.camera.heading = 0.001f * static_cast<float>(frame);
    return stage.draw(view, stage.frame(scene));
  };
  const auto bytes = [&] {
    std::size_t sum = 0;
    for (const MemoryRow& row : stage.sky->memory(stage.view)) sum += row.bytes;
    return sum;
  };
  Quality full = scene.quality;
  full.historyScale = full.interleave = 1;
  std::vector<Quality> order = Governor(settings).rungs();
  order.push_back(order.front());
  const int between = 20;
  int frame = 0;
  while (frame < between) draw(stage.view, frame++);
  const std::size_t before = bytes();
  for (const Quality& quality : order) {
    stage.sky->setQuality(full);
    View whole;
    const Image truth = draw(whole, frame);
    stage.sky->setQuality(quality);
    View steady, begun;
    for (int i = frame - between; i < frame; ++i) draw(steady, i);
    const double changed = displayedPsnr(draw(stage.view, frame), truth);
    const double always = displayedPsnr(draw(steady, frame), truth);
    const double first = displayedPsnr(draw(begun, frame), truth);
    std::printf("history %d, steps %.2f: %.1f dB, %.1f of one that has always been so, %.1f at the beginning\n",
                quality.historyScale, static_cast<double>(quality.stepScale), changed, always, first);
    const bool climbs = frame > between && quality == order.front();  // from a history of half the size
    if (!climbs) {
      EXPECT_GT(changed, always - 1.5) << quality.historyScale << ", " << quality.stepScale;
    }
    EXPECT_GT(changed, first) << quality.historyScale << ", " << quality.stepScale;
    for (int i = 1; i < between; ++i) draw(stage.view, ++frame);
    ++frame;
  }
  EXPECT_EQ(bytes(), before);
}

TEST(Governor, AQualityNeedsASkyFirst) {
  Stage stage(16, 16);
  EXPECT_THROW(stage.sky->setQuality(Quality{}), Error);
}

}  // namespace
}  // namespace welkin::realtime::test
