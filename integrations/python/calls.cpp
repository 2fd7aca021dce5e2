#include "integrations/python/calls.hpp"

#include "apps/welkin/usage_error.hpp"
#include "welkin/base/error.hpp"

namespace welkin::python {

namespace py = pybind11;

namespace {

struct Types {
  py::handle error, badInput, failed, noOpenGl, cancelled;
};
Types types;  // live as long as the interpreter

py::handle newType(py::module_& module, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full = std::string("welkin.") + name;
  const py::handle type = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.attr(name) = type;
  return type;
}

void raise(const py::handle& type, const std::string& message, const std::string& where) {
  const py::object error = type(message);
  error.attr("where") = where;
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void defineErrors(py::module_& module) {
  const py::handle runtime = PyExc_RuntimeError, value = PyExc_ValueError;
  types.error = newType(module, "Error", "What went wrong, where, and what to do; `where` is a file, path or value.",
                        py::make_tuple(runtime));
  types.badInput =
      newType(module, "BadInput", "A file or value handed in is wrong.", py::make_tuple(types.error, value));
  types.failed =
      newType(module, "Failed", "It could not be done: disk full, cannot write.", py::make_tuple(types.error));
  types.noOpenGl = newType(module, "NoOpenGl", "No usable OpenGL context.", py::make_tuple(types.error));
  types.cancelled = newType(module, "Cancelled", "The progress callback returned False.", py::make_tuple(types.error));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& e) {
      raise(e.kind() == ErrorKind::badInput   ? types.badInput
            : e.kind() == ErrorKind::noOpenGl ? types.noOpenGl
                                              : types.failed,
            e.what(), e.where());
    } catch (const app::UsageError& e) {
      raise(types.badInput, e.what(), "");
    } catch (const Cancelled& e) {
      raise(types.cancelled, e.what(), "");
    }
  });
}

bool Watch::goOn(double done) noexcept {
  const py::gil_scoped_acquire lock;
  if (raised_) return false;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return callback_.is_none() || !callback_(done).is(py::bool_(false));
  } catch (...) {
    raised_ = std::current_exception();
    return false;
  }
}

}  // namespace welkin::python
