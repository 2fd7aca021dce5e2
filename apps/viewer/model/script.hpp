#pragma once
// Scripts of input: a text file, one step a line, played as if a user did it. docs/viewer.md lists the steps.
#include <deque>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/viewer/model/event.hpp"
#include "apps/viewer/model/random_input.hpp"

namespace welkin::viewer {

struct ScriptStep {
  int line = 0;
  std::string verb;
  std::vector<std::string> words;  // the arguments; of "type" and "do" the last one reaches to the end of the line
};

struct Script {
  std::string name;  // of the file, for messages
  std::vector<ScriptStep> steps;
};

// Throws Error (badInput) with file and line for a step that does not exist or is not complete.
Script parseScript(std::string_view text, const std::string& name);

// What lies on the screen under a name, in pixels from the upper left.
struct Box {
  glm::vec2 low{0.0f}, high{0.0f};
};
using FindItem = std::function<std::optional<Box>(const std::string& name)>;

// Of the picture on screen: time runs, or it will come to rest, or nothing in it changes by itself any more.
enum class Rest { runs, comes, there };

// Hands out a script's events frame by frame. The same script gives the same frames: it counts frames, not seconds.
class ScriptPlayer {
 public:
  explicit ScriptPlayer(Script script) : script_(std::move(script)) {}

  struct Frame {
    std::vector<Event> events;
    std::optional<ScriptStep> command;  // "screenshot", "picture" or "do", for the viewer, after the frame is drawn;
                                        // "fly" before it
    bool finished = false;              // there is nothing more
  };
  // Throws Error (badInput) for an item that does not appear within 120 frames, and for a step that waits for rest when
  // time runs or it does not come within 2000.
  Frame next(const FindItem& find, Rest rest);

  // Whether hands do anything at present: then nothing that they do ends the script.
  bool playsRandomly() const { return hands_.has_value(); }

  [[noreturn]] void fail(const ScriptStep& step, const std::string& what) const;

 private:
  bool expand(const ScriptStep& step, const FindItem& find, Rest rest);
  std::optional<glm::vec2> place(const std::string& word, const FindItem& find) const;
  void moveTo(const glm::vec2& to);
  void button(MouseButton which, bool down);
  void chord(const Chord& chord, int frames);

  Script script_;
  std::size_t at_ = 0;
  int waited_ = 0;  // frames at the present step
  std::deque<Frame> queue_;
  std::optional<RandomHands> hands_;  // of the step "random"
  int handsFrames_ = 0;               // of theirs to come
};

}  // namespace welkin::viewer
