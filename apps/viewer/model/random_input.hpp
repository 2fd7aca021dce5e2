#pragma once
// Hands that do anything: for tests that nothing which a user may do does harm.
#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <vector>

#include "apps/viewer/model/event.hpp"

namespace welkin::viewer {

class RandomHands {
 public:
  // `files` are dropped on the window. The same seed and files, the same events.
  RandomHands(std::uint32_t seed, std::vector<std::string> files);

  // Of the next frame. Everything but quitting; the first one sets the window's size.
  std::vector<Event> next();
  // Lets go of whatever is held.
  std::vector<Event> release();

 private:
  std::uint32_t below(std::uint32_t n) { return random_() % n; }
  Event place();
  void act();
  void click();
  void drag();
  void chord();
  void type();
  void resize();

  std::mt19937 random_;
  std::vector<std::string> files_;
  std::deque<std::vector<Event>> frames_;  // to come
  std::vector<Event> held_;
  int width_ = 640, height_ = 360;
};

}  // namespace welkin::viewer
