#pragma once
// The cellular automaton of clouds (Dobashi et al., "A simple, efficient method for realistic animation of clouds",
// SIGGRAPH 2000; 001 ch. 4.4): a bit each for humidity, cloud and activation, 64 cells in a word.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/density/classical/settings.hpp"

namespace welkin {

// The automaton's state after `start` steps and more. Same settings and seed, same bits, on any number of threads.
class Automaton {
 public:
  // Widths are multiples of 64. Throws Error (badInput) for others, and sizes below 1.
  Automaton(const AutomatonSettings& settings, std::uint32_t seed);

  // One step: what is active becomes cloud and is no longer humid; humid cells become active beside active ones; then
  // chance takes cloud away, and gives humidity and activation.
  void advance();
  int steps() const { return steps_; }  // taken since the beginning

  bool humid(int x, int y, int z) const { return bit(humid_, x, y, z); }
  bool cloud(int x, int y, int z) const { return bit(cloud_, x, y, z); }
  bool active(int x, int y, int z) const { return bit(active_, x, y, z); }

  int width() const { return settings_.width; }
  int breadth() const { return settings_.breadth; }
  int height() const { return settings_.height; }

  // Chances are counted in 65536ths.
  enum class Chance { extinction, rehumidification, activation };
  std::uint32_t chanceAt(Chance chance, int x, int y, int z) const;
  // The number that a cell's chance in a step is held against, from 0 to 65535: it happens where it is less.
  std::uint32_t numberAt(Chance chance, int step, int x, int y, int z) const;

  // The bits of cloud, x fastest, then y.
  const std::vector<std::uint64_t>& clouds() const { return cloud_; }

 private:
  using Words = std::vector<std::uint64_t>;
  bool bit(const Words& words, int x, int y, int z) const {
    return words[(std::size_t(z) * settings_.breadth + y) * across_ + x / 64] >> (x % 64) & 1;
  }
  std::uint64_t drawn(Chance chance, std::uint64_t stream, std::size_t word) const;
  void setChances();
  void shear(Words& words, int layer, int cells) const;

  AutomatonSettings settings_;
  std::uint32_t seed_;
  std::size_t across_;  // words in a row
  int steps_ = 0;
  Words humid_, cloud_, active_, wasActive_;
  // Of the three chances: 16 planes of bits, the highest first, for each word.
  Words chances_[3];
  std::vector<std::uint8_t> never_[3];  // 1 for a word without chance
};

// Share of cloud in the cells round each one and in all states given, from 0 to 1 (Dobashi et al. 2000 eq. 8, with
// equal weights); outside the box there is none. One number for each cell, x fastest, then y.
std::vector<float> smoothCloud(const AutomatonSettings& settings, std::span<const std::vector<std::uint64_t>> clouds);

}  // namespace welkin
