#include "welkin/realtime/timers.hpp"

namespace welkin::realtime {

Timers::~Timers() {
  if (!queries_.empty()) gl_.DeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

void Timers::stamp(std::size_t index) {
  if (!gl_.QueryCounter || !gl_.GetQueryObjectui64v) return;
  while (queries_.size() <= index) {
    GLuint query = 0;
    gl_.GenQueries(1, &query);
    queries_.push_back(query);
  }
  gl_.QueryCounter(queries_[index], GL_TIMESTAMP);
}

void Timers::begin() {
  names_.clear();
  stamp(0);
}

void Timers::mark(const std::string& name) {
  names_.push_back(name);
  stamp(names_.size());
}

std::vector<PassTime> Timers::read() {
  std::vector<PassTime> passes;
  if (!gl_.QueryCounter || !gl_.GetQueryObjectui64v || names_.empty()) return passes;
  GLuint64 before = 0;
  gl_.GetQueryObjectui64v(queries_[0], GL_QUERY_RESULT, &before);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    GLuint64 now = 0;
    gl_.GetQueryObjectui64v(queries_[i + 1], GL_QUERY_RESULT, &now);
    passes.push_back({names_[i], static_cast<double>(now - before) * 1e-6});
    before = now;
  }
  return passes;
}

}  // namespace welkin::realtime
