#pragma once
// The one exception type of the library.
#include <stdexcept>
#include <string>
#include <utility>

namespace welkin {

enum class ErrorKind {
  failed,    // the operation could not be done (disk full, cannot write)
  badInput,  // a file or value handed in is wrong
  noOpenGl,  // no usable OpenGL context, or the driver lacks something required
};

// What went wrong, where (a file with line and column, or empty), and what to do about it, in one sentence each.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string where, const std::string& what)
      : std::runtime_error(where.empty() ? what : where + ": " + what), kind_(kind), where_(std::move(where)) {}
  ErrorKind kind() const { return kind_; }
  const std::string& where() const { return where_; }

 private:
  ErrorKind kind_;
  std::string where_;
};

}  // namespace welkin
