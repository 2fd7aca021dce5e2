#pragma once
// What long calls need: Python's errors for ours, and a lock of the interpreter that is let go meanwhile.
#include <pybind11/pybind11.h>

#include <exception>

#include "welkin/base/progress.hpp"

namespace welkin::python {

// Adds Error and its kinds to the module and turns C++ exceptions into them.
void defineErrors(pybind11::module_& module);

// Progress for a Python function of one float, or None; it stops the work where that returns False or raises, and on
// Ctrl-C.
class Watch {
 public:
  explicit Watch(pybind11::object callback) : callback_(std::move(callback)) {}

  // Runs work(Progress) without the interpreter's lock. Throws what the callback has raised, or what the work throws.
  template <class Work>
  auto run(const Work& work) {
    const auto progress = [this](double done) { return goOn(done); };
    try {
      pybind11::gil_scoped_release others;
      return work(Progress(progress));
    } catch (const Cancelled&) {
      if (raised_) std::rethrow_exception(raised_);
      throw;
    }
  }

 private:
  bool goOn(double done) noexcept;

  pybind11::object callback_;
  std::exception_ptr raised_;
};

}  // namespace welkin::python
