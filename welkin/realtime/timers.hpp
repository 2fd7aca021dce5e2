#pragma once
// Times of passes by pairs of timestamps (GL_TIME_ELAPSED reads 0 on Mesa's software driver).
#include <string>
#include <vector>

#include "welkin/gl/api.hpp"

namespace welkin::realtime {

struct PassTime {
  std::string name;
  double milliseconds;
};

class Timers {
 public:
  explicit Timers(const gl::Api& gl) : gl_(gl) {}
  ~Timers();
  Timers(const Timers&) = delete;
  Timers& operator=(const Timers&) = delete;

  void begin();
  // The pass that ends here.
  void mark(const std::string& name);
  // Waits for the driver; empty where it has no timestamps.
  std::vector<PassTime> read();

 private:
  void stamp(std::size_t index);
  const gl::Api& gl_;
  std::vector<GLuint> queries_;
  std::vector<std::string> names_;
};

}  // namespace welkin::realtime
