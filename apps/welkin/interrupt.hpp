#pragma once
// Ctrl-C that ends long work cleanly.
#include <csignal>

namespace welkin::app {

// While it lives, the first Ctrl-C asks for an end and the second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  bool asked() const;

 private:
  void (*before_)(int);
};

}  // namespace welkin::app
