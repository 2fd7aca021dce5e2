#include "apps/viewer/model/script.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "welkin/base/error.hpp"

namespace welkin::viewer {
namespace {

std::string refusalOf(const std::string& text) {
  try {
    parseScript(text, "a.txt");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const FindItem kNothing = [](const std::string&) { return std::nullopt; };

// The events of every frame, one line each.
std::vector<std::string> play(const std::string& text, const FindItem& find = kNothing) {
  ScriptPlayer player(parseScript(text, "a.txt"));
  std::vector<std::string> frames;
  for (int i = 0; i < 1000; ++i) {
    const ScriptPlayer::Frame frame = player.next(find, Rest::there);
    if (frame.finished) return frames;
    std::string line;
    for (const Event& e : frame.events) {
      if (!line.empty()) line += ' ';
      if (e.kind == EventKind::mouseMove) line += fmt::format("move {},{}", e.x, e.y);
      if (e.kind == EventKind::mouseButton) line += e.down ? "press" : "release";
      if (e.kind == EventKind::key) line += fmt::format("{}{}", e.down ? '+' : '-', nameOf(e.key));
      if (e.kind == EventKind::text) line += fmt::format("text {}", e.text);
      if (e.kind == EventKind::drop) line += fmt::format("drop {}", e.text);
    }
    if (frame.command) line += frame.command->verb;
    frames.push_back(line);
  }
  return {"endless"};
}

TEST(Script, CommentsAndEmptyLinesAreNoSteps) {
  EXPECT_EQ(parseScript("# a\n\n  \t\r\n  key a\r\n", "a.txt").steps.size(), 1u);
  EXPECT_TRUE(parseScript("", "a.txt").steps.empty());
}

TEST(Script, WhatIsWrongIsSaidWithFileAndLine) {
  EXPECT_EQ(refusalOf("key a\nclik 1,2\n"), "a.txt:2: 'clik' is not a step of a script; did you mean 'click'?");
  EXPECT_EQ(refusalOf("click here\n"), "a.txt:1: 'here' is not a place: write X,Y in pixels, or @ITEM");
  EXPECT_NE(refusalOf("key ctrl+\n").find("'ctrl+' is not a key"), std::string::npos);
  EXPECT_NE(refusalOf("key meta+a\n"), "");
  EXPECT_NE(refusalOf("frames 0\n"), "");
  EXPECT_NE(refusalOf("frames many\n"), "");
  EXPECT_NE(refusalOf("size 0 10\n"), "");
  EXPECT_NE(refusalOf("drag 1,2\n"), "");
  EXPECT_NE(refusalOf("click 1,nan\n"), "");
  EXPECT_NE(refusalOf("settle now\n"), "");
  EXPECT_NE(refusalOf("press up\n"), "");
  EXPECT_NE(refusalOf("rate\n"), "");
  EXPECT_NE(refusalOf("rate -1\n"), "");
  EXPECT_EQ(refusalOf("rate 0\nrate 25\n"), "");
}

TEST(Script, AClickMovesPressesAndReleasesInFramesOfTheirOwn) {
  EXPECT_EQ(play("click 10,20"), (std::vector<std::string>{"move 10,20", "press", "release", ""}));
}

TEST(Script, ADragEndsWhereItShould) {
  const std::vector<std::string> frames = play("drag 0,0 80,40");
  ASSERT_EQ(frames.size(), 12u);
  EXPECT_EQ(frames[1], "press");
  EXPECT_EQ(frames[9], "move 80,40");
  EXPECT_EQ(frames[10], "release");
}

TEST(Script, PlacesAreFoundByNameAndShare) {
  const FindItem find = [](const std::string& name) -> std::optional<Box> {
    if (name == "layer.0.weather.coverage") return Box{{100, 10}, {200, 30}};
    return std::nullopt;
  };
  EXPECT_EQ(play("move @layer.0.weather.coverage", find)[0], "move 150,20");
  EXPECT_EQ(play("move @layer.0.weather.coverage:0.2", find)[0], "move 120,20");
  EXPECT_EQ(play("move @layer.0.weather.coverage:1:1", find)[0], "move 200,30");
  EXPECT_THROW(play("move @nowhere", find), Error);
}

TEST(Script, ChordsPressModifiersFirst) {
  EXPECT_EQ(play("key ctrl+shift+z"), (std::vector<std::string>{"+ctrl +shift +z", "-z -shift -ctrl"}));
  EXPECT_EQ(play("hold w 3"), (std::vector<std::string>{"+w", "", "", "-w"}));
}

TEST(Script, TailsKeepTheirSpaces) {
  EXPECT_EQ(play("type two words"), (std::vector<std::string>{"text two words"}));
  EXPECT_EQ(play("drop /a b/c.toml"), (std::vector<std::string>{"drop /a b/c.toml"}));
  const Script script = parseScript("do open a b.toml", "a.txt");
  EXPECT_EQ(script.steps[0].words, (std::vector<std::string>{"open", "a b.toml"}));
}

TEST(Script, SettlingWaitsUntilThePictureRestsAndNotForEver) {
  ScriptPlayer player(parseScript("settle\nscreenshot a.png", "a.txt"));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(player.next(kNothing, Rest::comes).command);
  EXPECT_TRUE(player.next(kNothing, Rest::there).command);
  ScriptPlayer endless(parseScript("settle", "a.txt"));
  EXPECT_THROW(
      {
        for (int i = 0; i < 5000; ++i) endless.next(kNothing, Rest::comes);
      },
      Error);
}

TEST(Script, RestIsNotWaitedForWhileTimeRuns) {
  ScriptPlayer player(parseScript("frames 2\nsettle", "a.txt"));
  const auto run = [&] {
    for (int i = 0; i < 10; ++i) player.next(kNothing, Rest::runs);
  };
  EXPECT_THROW(run(), Error);
}

TEST(Script, RandomHandsDoTheSameAgainAndLetGo) {
  const std::vector<std::string> once = play("random 600 7\nkey a\n"), again = play("random 600 7\nkey a\n");
  EXPECT_EQ(once, again);
  EXPECT_NE(once, play("random 600 8\nkey a\n"));
  ASSERT_EQ(once.size(), 603u);  // they let go, and a key is two frames
  std::multiset<std::string> down;
  bool presses = false, drags = false;
  for (const std::string& line : once) {
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (word == "text") break;
      if (word[0] == '+') down.insert(word.substr(1));
      if (word[0] == '-') down.erase(word.substr(1));
    }
    presses |= line.find('+') != std::string::npos;
    drags |= line == "press";
  }
  EXPECT_TRUE(down.empty());
  EXPECT_TRUE(presses && drags);
  EXPECT_NE(refusalOf("random 10\n"), "");
  EXPECT_NE(refusalOf("random 0 1\n"), "");
}

TEST(Chords, HaveNamesThatReadBack) {
  for (const char* name : {"a", "9", "f12", "ctrl+z", "ctrl+alt+shift+pageup", "slash"})
    EXPECT_EQ(nameOf(chordNamed(name)), name);
  for (int i = 1; i < kKeys; ++i) EXPECT_EQ(keyNamed(nameOf(static_cast<Key>(i))), static_cast<Key>(i));
  EXPECT_EQ(chordNamed("").key, Key::none);
  EXPECT_EQ(chordNamed("ctrl").key, Key::ctrl);
}

}  // namespace
}  // namespace welkin::viewer
