#include "apps/viewer/model/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>

#include "welkin/base/error.hpp"
#include "welkin/base/fields.hpp"

namespace welkin::viewer {

namespace {

constexpr int kItemPatience = 120, kSettlePatience = 2000, kDragFrames = 8;

struct Verb {
  std::string_view name, usage;
  std::size_t least, most;
  bool tail = false;  // the last argument reaches to the end of the line
};
constexpr std::array kVerbs{Verb{"size", "size WIDTH HEIGHT", 2, 2},
                            Verb{"move", "move PLACE", 1, 1},
                            Verb{"press", "press [left|right|middle]", 0, 1},
                            Verb{"release", "release [left|right|middle]", 0, 1},
                            Verb{"click", "click PLACE [left|right|middle]", 1, 2},
                            Verb{"drag", "drag PLACE PLACE [left|right|middle]", 2, 3},
                            Verb{"wheel", "wheel CLICKS", 1, 1},
                            Verb{"key", "key CHORD, for example ctrl+z", 1, 1},
                            Verb{"hold", "hold CHORD FRAMES", 2, 2},
                            Verb{"type", "type TEXT", 1, 1, true},
                            Verb{"drop", "drop FILE", 1, 1, true},
                            Verb{"frames", "frames NUMBER", 1, 1},
                            Verb{"settle", "settle", 0, 0},
                            Verb{"screenshot", "screenshot FILE", 1, 1, true},
                            Verb{"picture", "picture FILE", 1, 1, true},
                            Verb{"do", "do ACTION [ARGUMENT]", 1, 2, true},
                            Verb{"fly", "fly FRAMES [NAME=VALUE ...], for example fly 120 throttle=1 pitch=0.2", 1, 8},
                            Verb{"rate", "rate FRAMES_A_SECOND, from 0 to 1000", 1, 1},
                            Verb{"random", "random FRAMES SEED [FOLDER]", 2, 3, true},
                            Verb{"quit", "quit", 0, 0}};

[[noreturn]] void refuse(const std::string& name, int line, const std::string& what) {
  throw Error(ErrorKind::badInput, fmt::format("{}:{}", name, line), what);
}

std::optional<float> numberOf(std::string_view word) {
  float value = 0.0f;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> countOf(std::string_view word, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 1 || value > most) return std::nullopt;
  return value;
}

std::optional<MouseButton> buttonOf(std::string_view word) {
  if (word == "left") return MouseButton::left;
  if (word == "right") return MouseButton::right;
  if (word == "middle") return MouseButton::middle;
  return std::nullopt;
}

// The words of a line; the last of `most` words takes the rest when the verb has a tail.
std::vector<std::string> wordsOf(std::string_view rest, const Verb& verb) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t begin = rest.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    rest.remove_prefix(begin);
    const bool last = verb.tail && words.size() + 1 == verb.most;
    const std::size_t end = last ? rest.size() : std::min(rest.find_first_of(" \t"), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end);
  }
}

// "400,300" or "@item", "@item:0.2" (a share of its width), "@item:0.2:0.5" (and of its height).
bool isPlace(const std::string& word) {
  if (word.starts_with('@')) return word.size() > 1;
  const std::size_t comma = word.find(',');
  return comma != std::string::npos && numberOf(std::string_view(word).substr(0, comma)) &&
         numberOf(std::string_view(word).substr(comma + 1));
}

// What is wrong with the arguments of a step, or an empty text.
std::string wrongWith(const ScriptStep& step, const Verb& verb) {
  const auto& w = step.words;
  std::string usage = fmt::format("write {}", verb.usage);
  if (w.size() < verb.least || w.size() > verb.most) return usage;
  const bool button = verb.name == "press" || verb.name == "release" || verb.name == "click" || verb.name == "drag";
  const std::size_t places = verb.name == "drag" ? 2 : verb.name == "move" || verb.name == "click" ? 1 : 0;
  for (std::size_t i = 0; i < places; ++i)
    if (!isPlace(w[i])) return fmt::format("'{}' is not a place: write X,Y in pixels, or @ITEM", w[i]);
  if (button && w.size() > places && !buttonOf(w[places])) return usage;
  if (verb.name == "size" && (!countOf(w[0], 16384) || !countOf(w[1], 16384))) return usage;
  if (verb.name == "wheel" && !numberOf(w[0])) return usage;
  if (verb.name == "rate") {
    const std::optional<float> rate = numberOf(w[0]);
    if (!rate || *rate < 0.0f || *rate > 1000.0f) return usage;
  }
  if ((verb.name == "frames" || verb.name == "fly") && !countOf(w[0], 100000)) return usage;
  if (verb.name == "random" && (!countOf(w[0], 10000000) || !countOf(w[1], 1 << 30))) return usage;
  if ((verb.name == "key" || verb.name == "hold") && chordNamed(w[0]).key == Key::none)
    return fmt::format("'{}' is not a key: write for example a, f5, pageup, ctrl+shift+z", w[0]);
  if (verb.name == "hold" && !countOf(w[1], 100000)) return usage;
  return "";
}

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

Event mouseEvent(EventKind kind, const glm::vec2& at) { return {.kind = kind, .x = at.x, .y = at.y}; }

}  // namespace

Script parseScript(std::string_view text, const std::string& name) {
  Script script{name, {}};
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') continue;
    line.remove_prefix(first);
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    const auto verb = std::find_if(kVerbs.begin(), kVerbs.end(), [&](const Verb& v) { return v.name == word; });
    if (verb == kVerbs.end()) {
      std::vector<std::string> names;
      names.reserve(kVerbs.size());
      for (const Verb& v : kVerbs) names.emplace_back(v.name);
      const std::string near = nearestName(word, names);
      refuse(name, number,
             fmt::format("'{}' is not a step of a script{}", word,
                         near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    ScriptStep step{number, std::string(word), wordsOf(line.substr(word.size()), *verb)};
    if (const std::string wrong = wrongWith(step, *verb); !wrong.empty()) refuse(name, number, wrong);
    script.steps.push_back(std::move(step));
  }
  return script;
}

void ScriptPlayer::fail(const ScriptStep& step, const std::string& what) const {
  refuse(script_.name, step.line, what);
}

std::optional<glm::vec2> ScriptPlayer::place(const std::string& word, const FindItem& find) const {
  if (!word.starts_with('@')) {
    const std::size_t comma = word.find(',');
    return glm::vec2(*numberOf(std::string_view(word).substr(0, comma)),
                     *numberOf(std::string_view(word).substr(comma + 1)));
  }
  // Shares stand after colons at the end, if they are numbers.
  std::string name = word.substr(1);
  std::vector<float> shares;
  for (std::size_t colon = name.rfind(':'); colon != std::string::npos && shares.size() < 2; colon = name.rfind(':')) {
    const std::optional<float> share = numberOf(std::string_view(name).substr(colon + 1));
    if (!share) break;
    shares.insert(shares.begin(), *share);
    name.resize(colon);
  }
  const std::optional<Box> box = find(name);
  if (!box) return std::nullopt;
  const glm::vec2 share(shares.empty() ? 0.5f : shares[0], shares.size() < 2 ? 0.5f : shares[1]);
  return box->low + share * (box->high - box->low);
}

void ScriptPlayer::moveTo(const glm::vec2& to) {
  queue_.push_back({{mouseEvent(EventKind::mouseMove, to)}, {}, false});
}

void ScriptPlayer::button(MouseButton which, bool down) {
  queue_.push_back({{Event{.kind = EventKind::mouseButton, .button = which, .down = down}}, {}, false});
}

void ScriptPlayer::chord(const Chord& chord, int frames) {
  std::vector<Key> keys;
  if (chord.modifiers.ctrl) keys.push_back(Key::ctrl);
  if (chord.modifiers.alt) keys.push_back(Key::alt);
  if (chord.modifiers.shift) keys.push_back(Key::shift);
  keys.push_back(chord.key);
  Frame press, release;
  for (const Key key : keys) press.events.push_back({.kind = EventKind::key, .down = true, .key = key});
  for (auto key = keys.rbegin(); key != keys.rend(); ++key)
    release.events.push_back({.kind = EventKind::key, .down = false, .key = *key});
  queue_.push_back(press);
  for (int i = 1; i < frames; ++i) queue_.emplace_back();
  queue_.push_back(release);
}

// Puts a step's frames into the queue; false when it has to wait.
bool ScriptPlayer::expand(const ScriptStep& step, const FindItem& find, Rest rest) {
  const std::string& verb = step.verb;
  const auto& words = step.words;
  const auto buttonAt = [&](std::size_t i) { return words.size() > i ? *buttonOf(words[i]) : MouseButton::left; };
  if (verb == "settle") {
    // A change of the frame before shows in what is settled only after one more frame.
    if (waited_ < 2) return false;
    if (rest == Rest::runs)
      fail(step, "the picture does not come to rest while time runs; 'key space' before it stops the time");
    if (rest == Rest::comes && waited_ >= kSettlePatience) fail(step, "the picture does not come to rest");
    return rest == Rest::there;
  }
  if (verb == "move" || verb == "click" || verb == "drag") {
    const std::size_t count = verb == "drag" ? 2 : 1;
    std::vector<glm::vec2> places;
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<glm::vec2> at = place(words[i], find);
      if (!at && waited_ < kItemPatience) return false;
      if (!at) fail(step, fmt::format("nothing on the screen is called '{}'", words[i].substr(1)));
      places.push_back(*at);
    }
    moveTo(places[0]);
    if (verb == "move") return true;
    button(buttonAt(count), true);
    if (verb == "drag")
      for (int i = 1; i <= kDragFrames; ++i)
        moveTo(glm::mix(places[0], places[1], static_cast<float>(i) / kDragFrames));
    button(buttonAt(count), false);
    queue_.emplace_back();
    return true;
  }
  if (verb == "press" || verb == "release") {
    button(buttonAt(0), verb == "press");
  } else if (verb == "wheel") {
    queue_.push_back({{Event{.kind = EventKind::wheel, .y = *numberOf(words[0])}}, {}, false});
  } else if (verb == "key") {
    chord(chordNamed(words[0]), 1);
  } else if (verb == "hold") {
    chord(chordNamed(words[0]), *countOf(words[1], 100000));
  } else if (verb == "type") {
    queue_.push_back({{Event{.kind = EventKind::text, .text = words[0]}}, {}, false});
  } else if (verb == "drop") {
    queue_.push_back({{Event{.kind = EventKind::drop, .text = words[0]}}, {}, false});
  } else if (verb == "size") {
    queue_.push_back(
        {{Event{.kind = EventKind::resize, .x = *numberOf(words[0]), .y = *numberOf(words[1])}}, {}, false});
  } else if (verb == "frames") {
    for (int i = *countOf(words[0], 100000); i > 0; --i) queue_.emplace_back();
  } else if (verb == "fly") {
    queue_.push_back({{}, step, false});
    for (int i = *countOf(words[0], 100000); i > 1; --i) queue_.emplace_back();
  } else if (verb == "random") {
    hands_.emplace(static_cast<std::uint32_t>(*countOf(words[1], 1 << 30)),
                   words.size() > 2 ? filesIn(words[2]) : std::vector<std::string>{});
    handsFrames_ = *countOf(words[0], 10000000);
  } else if (verb == "quit") {
    queue_.push_back({{Event{.kind = EventKind::quit}}, {}, false});
  } else {
    queue_.push_back({{}, step, false});
  }
  return true;
}

ScriptPlayer::Frame ScriptPlayer::next(const FindItem& find, Rest rest) {
  while (queue_.empty()) {
    if (hands_ && handsFrames_-- > 0) return {hands_->next(), {}, false};
    if (hands_) {
      queue_.push_back({hands_->release(), {}, false});
      hands_.reset();
      break;
    }
    if (at_ >= script_.steps.size()) return {{}, {}, true};
    if (!expand(script_.steps[at_], find, rest)) {
      ++waited_;
      return {};
    }
    waited_ = 0;
    ++at_;
  }
  Frame frame = std::move(queue_.front());
  queue_.pop_front();
  return frame;
}

}  // namespace welkin::viewer
