#include "apps/welkin/interrupt.hpp"

#include <atomic>

namespace welkin::app {

namespace {

std::atomic<bool> interrupted{false};

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = false;
  before_ = std::signal(SIGINT, [](int) {
    interrupted = true;
    std::signal(SIGINT, SIG_DFL);
  });
}

InterruptGuard::~InterruptGuard() { std::signal(SIGINT, before_); }

bool InterruptGuard::asked() const { return interrupted; }

}  // namespace welkin::app
