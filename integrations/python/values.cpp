#include "integrations/python/values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "welkin/base/error.hpp"

namespace welkin::python {

namespace py = pybind11;

namespace {

// Singles such as 0.1f as the shortest decimal that files write, not as the double next to them.
double asWritten(const Field& field, double value) { return std::strtod(formatValue(field, value).c_str(), nullptr); }

py::object boundsOf(const Field& field, const Range& range) {
  const auto bound = [&](double x) -> py::object {
    if (!std::isfinite(x)) return py::none();
    if (field.kind == FieldKind::integer) return py::int_(static_cast<std::int64_t>(x));
    return py::float_(x);
  };
  return py::make_tuple(bound(range.low), bound(range.high));
}

[[noreturn]] void refuse(const std::string& path, const py::handle& value, const std::string& what) {
  throw Error(ErrorKind::badInput, fmt::format("{}={}", path, py::repr(value).cast<std::string>()), what);
}

FieldValue fieldValue(const std::string& path, const py::handle& given) {
  py::object value = py::reinterpret_borrow<py::object>(given);
  if (py::isinstance(value, py::module_::import("numpy").attr("generic"))) value = value.attr("item")();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) {
    try {
      return value.cast<std::int64_t>();
    } catch (const py::cast_error&) {
      refuse(path, given, fmt::format("{} does not fit into 64 bits", path));
    }
  }
  if (py::isinstance<py::float_>(value)) return value.cast<double>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__len__") && py::len(value) == 3) {
    try {
      std::array<double, 3> vector{};
      for (std::size_t i = 0; i < 3; ++i) vector[i] = value[py::int_(i)].cast<double>();
      return vector;
    } catch (const std::exception&) {  // neither numbers nor a sequence: refused below
    }
  }
  refuse(path, given,
         fmt::format("{} takes a number, a text, True or False, or three numbers, not {}", path,
                     py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

}  // namespace

py::object pythonValue(const Field& field, const FieldValue& value) {
  if (const double* real = std::get_if<double>(&value)) return py::float_(asWritten(field, *real));
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return py::int_(*whole);
  if (const bool* on = std::get_if<bool>(&value)) return py::bool_(*on);
  if (const std::string* text = std::get_if<std::string>(&value)) return py::str(*text);
  const auto& v = std::get<std::array<double, 3>>(value);
  return py::make_tuple(asWritten(field, v[0]), asWritten(field, v[1]), asWritten(field, v[2]));
}

py::object get(Scene& scene, const std::string& path) {
  const std::vector<Section> sections = sectionsOf(scene);
  const std::string whole = withListNumber(path);
  const Parameter p = findParameter(sections, whole);
  if (!p.field) throw Error(ErrorKind::badInput, "", unknownParameter(scene, sections, whole));
  return pythonValue(*p.field, p.field->get(p.section->object));
}

void set(Scene& scene, const std::string& path, const py::handle& value) {
  const std::vector<Section> sections = sectionsOf(scene);
  const std::string whole = withListNumber(path);
  const Parameter p = findParameter(sections, whole);
  if (!p.field) refuse(whole, value, unknownParameter(scene, sections, whole));
  const std::string wrong = assign(scene, *p.section, *p.field, fieldValue(whole, value));
  if (!wrong.empty()) refuse(whole, value, fmt::format("{} {}", whole, wrong));
}

py::list fields() {
  static constexpr const char* kKinds[] = {"real", "integer", "boolean", "choice", "text", "file", "vector"};
  Scene scene;
  for (const SceneList& list : listsOf(scene))
    if (list.size == 0) list.append();
  py::list rows;
  for (const Section& section : sectionsOf(scene))
    for (const Field& f : section.fields) {
      const std::string table = tableName(section.path);
      py::dict row;
      row["path"] = table.empty() ? f.name : table + "." + f.name;
      row["kind"] = kKinds[static_cast<std::size_t>(f.kind)];
      row["unit"] = f.unit.symbol;
      row["default"] = pythonValue(f, f.defaultValue);
      row["range"] = boundsOf(f, f.hard);
      row["slider"] = boundsOf(f, f.soft);
      py::list choices;
      for (const std::string_view choice : f.choices) choices.append(std::string(choice));
      for (const std::int64_t choice : f.allowed) choices.append(choice);
      row["choices"] = choices;
      row["help"] = f.help;
      rows.append(row);
    }
  return rows;
}

}  // namespace welkin::python
