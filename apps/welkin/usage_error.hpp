#pragma once
#include <stdexcept>

namespace welkin::app {

// A wrong use of the command or of a function that serves it; the command ends with exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace welkin::app
