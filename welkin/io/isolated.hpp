#pragma once
// Work on files that nobody vouches for, by libraries that trust them: in a process of its own, with limits.
#include <cstddef>
#include <functional>
#include <string>

namespace welkin {

struct IsolationLimits {
  std::size_t bytes = std::size_t{4} << 30;  // of memory beyond what this process uses already
  double seconds = 600.0;
};

// Writes to the other side; throws when nobody reads any more.
using Sink = std::function<void(const void* bytes, std::size_t count)>;
// Reads exactly so many bytes from the other side; throws Error when it ends before.
using Source = std::function<void(void* bytes, std::size_t count)>;

// Runs `work` in a child process, which sends, and `receive` here, which reads what it sends. An Error of the work is
// thrown here. When the work crashes or goes beyond its limits, Error (badInput) says so of `where`; nothing else
// happens to this process. The child has no threads but its own, and must not use OpenGL.
void runIsolated(const std::string& where, const IsolationLimits& limits, const std::function<void(const Sink&)>& work,
                 const std::function<void(const Source&)>& receive);

}  // namespace welkin
