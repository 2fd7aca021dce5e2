#pragma once
// Other programs.
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace welkin {

// The path of a program that is looked for in $PATH, or empty.
std::string findProgram(std::string_view name);

struct ProcessEnd {
  int code = 0;        // exit code, or 128 and the signal that ended it
  std::string errors;  // the last 4 KiB that it wrote to its standard error
};

// Runs a program with its arguments (the first is its path) and waits for it. It reads nothing, is in a process group
// of its own, so that Ctrl-C is for us alone, and ends with us. `line` gets each line of its output; `goOn` is asked
// ten times a second: when it answers false, the program is ended and Cancelled is thrown. Throws Error (failed) when
// it cannot be started.
ProcessEnd runProcess(std::span<const std::string> command, const std::function<void(std::string_view line)>& line,
                      const std::function<bool()>& goOn);

}  // namespace welkin
