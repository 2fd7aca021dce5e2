#include "apps/viewer/model/random_input.hpp"

#include <algorithm>
#include <array>

namespace welkin::viewer {

namespace {

// Numbers that are none or too large, text of other alphabets, a path.
constexpr std::array<const char*, 10> kTexts{"0",
                                             "-1",
                                             "1e999",
                                             "nan",
                                             "0.5",
                                             "999999999999",
                                             "coverage",
                                             "../",
                                             "é漢\xf0\x9f\x98\x80",
                                             "                                        "};

// Mostly usual ones; the least and the largest for a moment.
struct Size {
  int width, height, frames;
};
constexpr std::array<Size, 8> kSizes{Size{640, 360, 0}, {320, 180, 0},   {480, 480, 0}, {800, 450, 0},
                                     {1, 1, 3},         {4096, 4096, 1}, {4096, 1, 2},  {37, 1200, 3}};

}  // namespace

RandomHands::RandomHands(std::uint32_t seed, std::vector<std::string> files) : random_(seed), files_(std::move(files)) {
  frames_.push_back({Event{.kind = EventKind::resize, .x = 640.0f, .y = 360.0f}});
}

std::vector<Event> RandomHands::next() {
  while (frames_.empty()) act();
  std::vector<Event> events = std::move(frames_.front());
  frames_.pop_front();
  for (const Event& e : events) {
    if (e.kind != EventKind::key && e.kind != EventKind::mouseButton) continue;
    std::erase_if(held_, [&](const Event& h) { return h.kind == e.kind && h.key == e.key && h.button == e.button; });
    if (e.down) held_.push_back(e);
  }
  return events;
}

std::vector<Event> RandomHands::release() {
  std::vector<Event> events;
  std::swap(events, held_);
  for (Event& e : events) e.down = false;
  return events;
}

// Half of them on the panels at the left, some beside the window.
Event RandomHands::place() {
  const auto along = [&](int size, std::uint32_t share) {
    return static_cast<float>(static_cast<int>(below(1100)) - 50) / 1000.0f * static_cast<float>(size) /
           static_cast<float>(share);
  };
  return {.kind = EventKind::mouseMove, .x = along(width_, 1 + below(2)), .y = along(height_, 1)};
}

void RandomHands::click() {
  const auto button = static_cast<MouseButton>(below(8) > 1 ? 0 : below(3));
  frames_.push_back({place()});
  frames_.push_back({Event{.kind = EventKind::mouseButton, .button = button, .down = true}});
  frames_.push_back({Event{.kind = EventKind::mouseButton, .button = button, .down = false}});
}

void RandomHands::drag() {
  const auto button = static_cast<MouseButton>(below(3));
  frames_.push_back({place()});
  frames_.push_back({Event{.kind = EventKind::mouseButton, .button = button, .down = true}});
  for (std::uint32_t i = 1 + below(8); i > 0; --i) frames_.push_back({place()});
  frames_.push_back({Event{.kind = EventKind::mouseButton, .button = button, .down = false}});
}

void RandomHands::chord() {
  const auto key = static_cast<Key>(1 + below(kKeys - 1));
  std::vector<Event> down, up;
  const auto press = [&](Key k) {
    down.push_back({.kind = EventKind::key, .down = true, .key = k});
    up.insert(up.begin(), {.kind = EventKind::key, .down = false, .key = k});
  };
  const bool ctrl = below(4) == 0 && key != Key::q;
  if (ctrl) press(Key::ctrl);
  if (below(5) == 0) press(Key::shift);
  if (below(10) == 0) press(Key::alt);
  press(key);
  frames_.push_back(down);
  for (std::uint32_t i = below(6) == 0 ? below(20) : 0; i > 0; --i) frames_.emplace_back();
  frames_.push_back(up);
}

void RandomHands::type() { frames_.push_back({Event{.kind = EventKind::text, .text = kTexts[below(kTexts.size())]}}); }

void RandomHands::resize() {
  const Size& size = kSizes[below(kSizes.size())];
  const auto to = [&](int width, int height) {
    width_ = width;
    height_ = height;
    frames_.push_back(
        {Event{.kind = EventKind::resize, .x = static_cast<float>(width), .y = static_cast<float>(height)}});
  };
  to(size.width, size.height);
  if (size.frames == 0) return;
  frames_.resize(frames_.size() + static_cast<std::size_t>(size.frames));
  to(640, 360);
}

void RandomHands::act() {
  const std::uint32_t die = below(100);
  if (die < 15)
    frames_.push_back({place()});
  else if (die < 45)
    click();
  else if (die < 60)
    drag();
  else if (die < 67)
    frames_.push_back({Event{.kind = EventKind::wheel, .y = static_cast<float>(static_cast<int>(below(11)) - 5)}});
  else if (die < 88)
    chord();
  else if (die < 95)
    type();
  else if (die < 98 && !files_.empty())
    frames_.push_back(
        {Event{.kind = EventKind::drop, .text = files_[below(static_cast<std::uint32_t>(files_.size()))]}});
  else
    resize();
}

}  // namespace welkin::viewer
