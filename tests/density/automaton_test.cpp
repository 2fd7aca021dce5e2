// The automaton of 64 cells a word against one of a cell at a time.
#include "welkin/density/classical/automaton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/error.hpp"

namespace welkin {
namespace {

using Chance = Automaton::Chance;

struct Cells {
  int w, b, h;
  std::vector<char> humid, cloud, active;
  std::size_t at(int x, int y, int z) const { return std::size_t((z * b + y) * w + x); }
  bool actsAt(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < w && y < b && z < h && active[at(x, y, z)] != 0;
  }
};

Cells cellsOf(const Automaton& a) {
  Cells c{a.width(), a.breadth(), a.height(), {}, {}, {}};
  for (int z = 0; z < c.h; ++z)
    for (int y = 0; y < c.b; ++y)
      for (int x = 0; x < c.w; ++x) {
        c.humid.push_back(a.humid(x, y, z));
        c.cloud.push_back(a.cloud(x, y, z));
        c.active.push_back(a.active(x, y, z));
      }
  return c;
}

// Dobashi et al. 2000, eqs. 1 to 4 and 5 to 7, as printed.
Cells naiveStep(const Cells& before, const Automaton& chances, int step) {
  Cells after = before;
  const auto happens = [&](Chance c, int x, int y, int z) {
    return chances.numberAt(c, step, x, y, z) < chances.chanceAt(c, x, y, z);
  };
  for (int z = 0; z < before.h; ++z)
    for (int y = 0; y < before.b; ++y)
      for (int x = 0; x < before.w; ++x) {
        const std::size_t i = before.at(x, y, z);
        const auto act = [&](int dx, int dy, int dz) { return before.actsAt(x + dx, y + dy, z + dz); };
        const bool near = act(1, 0, 0) || act(0, 1, 0) || act(0, 0, 1) || act(-1, 0, 0) || act(0, -1, 0) ||
                          act(0, 0, -1) || act(-2, 0, 0) || act(2, 0, 0) || act(0, -2, 0) || act(0, 2, 0) ||
                          act(0, 0, -2);
        const bool humid = before.humid[i], cloud = before.cloud[i], active = before.active[i];
        after.humid[i] = (humid && !active) || happens(Chance::rehumidification, x, y, z);
        after.cloud[i] = (cloud || active) && !happens(Chance::extinction, x, y, z);
        after.active[i] = (!active && humid && near) || happens(Chance::activation, x, y, z);
      }
  return after;
}

constexpr AutomatonSettings kSmallCloud{.width = 128, .breadth = 12, .height = 10, .regions = 3, .activation = 0.02f};

TEST(Automaton, FollowsTheRulesOfItsSource) {
  for (const int regions : {0, 3}) {
    AutomatonSettings s = kSmallCloud;
    s.regions = regions;
    Automaton automaton(s, 7);
    Cells naive = cellsOf(automaton);
    std::size_t clouds = 0;
    for (int step = 0; step < 12; ++step) {
      naive = naiveStep(naive, automaton, step);
      automaton.advance();
      const Cells now = cellsOf(automaton);
      ASSERT_EQ(now.humid, naive.humid) << step;
      ASSERT_EQ(now.cloud, naive.cloud) << step;
      ASSERT_EQ(now.active, naive.active) << step;
      for (const char c : now.cloud) clouds += c != 0;
    }
    EXPECT_GT(clouds, 1000u);
  }
}

TEST(Automaton, ChancesComeTrueAsOftenAsTheySay) {
  AutomatonSettings s = kSmallCloud;
  s.regions = 0;
  s.rehumidification = 0.1f;
  const Automaton automaton(s, 7);
  int true_ = 0, all = 0;
  for (int step = 0; step < 20; ++step)
    for (int z = 0; z < s.height; ++z)
      for (int x = 0; x < s.width; ++x, ++all)
        true_ += automaton.numberAt(Chance::rehumidification, step, x, 3, z) <
                 automaton.chanceAt(Chance::rehumidification, x, 3, z);
  EXPECT_NEAR(true_ / double(all), 0.1, 4.0 * std::sqrt(0.09 / all));
  EXPECT_EQ(automaton.chanceAt(Chance::rehumidification, 0, 0, 0), 6554u);
}

TEST(Automaton, WithoutChanceNothingVanishesAndHumidityIsSpent) {
  AutomatonSettings s = kSmallCloud;
  s.regions = 0;
  s.extinction = s.rehumidification = 0.0f;
  Automaton automaton(s, 2);
  Cells before = cellsOf(automaton);
  for (int step = 0; step < 30; ++step) {
    automaton.advance();
    const Cells now = cellsOf(automaton);
    for (std::size_t i = 0; i < now.cloud.size(); ++i) {
      ASSERT_GE(now.cloud[i], before.cloud[i]);
      ASSERT_LE(now.humid[i], before.humid[i]);
    }
    before = now;
  }
}

TEST(Automaton, ExtinctionAndRehumidificationKeepItAlive) {
  AutomatonSettings s = kSmallCloud;
  s.regions = 0;
  Automaton automaton(s, 2);
  const auto share = [&] {
    const Cells c = cellsOf(automaton);
    return static_cast<double>(std::count(c.cloud.begin(), c.cloud.end(), 1)) / static_cast<double>(c.cloud.size());
  };
  for (int i = 0; i < 200; ++i) automaton.advance();
  const double middle = share();
  for (int i = 0; i < 200; ++i) automaton.advance();
  EXPECT_GT(middle, 0.05);
  EXPECT_LT(middle, 0.95);
  EXPECT_NEAR(share(), middle, 0.1);
}

TEST(Automaton, WindMovesTheTopOnly) {
  AutomatonSettings s = kSmallCloud;
  s.regions = 0;
  s.humidity = s.activation = s.rehumidification = s.extinction = 0.0f;
  s.humidity = 0.5f;  // that nothing uses up
  for (const int shear : {3, -3}) {
    s.shear = shear;
    Automaton automaton(s, 2);
    const Cells before = cellsOf(automaton);
    for (int i = 0; i < 10; ++i) automaton.advance();
    const Cells now = cellsOf(automaton);
    const auto moved = [&](int z) { return static_cast<int>(std::floor(10.0 * shear * (z + 0.5) / s.height)); };
    EXPECT_NE(moved(9), moved(0));
    for (int z = 0; z < s.height; ++z)
      for (int x = 0; x < s.width; ++x) {
        const int from = x - moved(z);
        ASSERT_EQ(now.humid[now.at(x, 5, z)] != 0,
                  from >= 0 && from < s.width && before.humid[before.at(from, 5, z)] != 0)
            << x << " " << z;
      }
  }
}

TEST(Automaton, SmoothDensityIsAMean) {
  AutomatonSettings s = kSmallCloud;
  s.smoothing = 1;
  std::vector<std::vector<std::uint64_t>> clouds(2, std::vector<std::uint64_t>(2 * 12 * 10));
  clouds[0][(5 * 12 + 6) * 2 + 1] = 1;  // the cell (64, 6, 5), in one of two steps
  const std::vector<float> shares = smoothCloud(s, clouds);
  const auto at = [&](int x, int y, int z) { return shares[std::size_t((z * 12 + y) * 128 + x)]; };
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 128; ++x) {
        const bool in = std::abs(x - 64) <= 1 && std::abs(y - 6) <= 1 && std::abs(z - 5) <= 1;
        ASSERT_NEAR(at(x, y, z), in ? 0.5f / 27.0f : 0.0f, 1e-7f) << x << " " << y << " " << z;
      }
  s.smoothing = 0;
  EXPECT_EQ(smoothCloud(s, clouds)[(5 * 12 + 6) * 128 + 64], 0.5f);
}

TEST(Automaton, RefusesSizesThatCannotBe) {
  EXPECT_THROW(Automaton({.width = 100}, 1), Error);
  EXPECT_THROW(Automaton({.width = 0}, 1), Error);
  EXPECT_THROW(Automaton({.height = 0}, 1), Error);
}

}  // namespace
}  // namespace welkin
