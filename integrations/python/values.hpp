#pragma once
// Parameters as Python values.
#include <pybind11/pybind11.h>

#include <string>

#include "welkin/scene/scene.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin::python {

// float, int, bool, str or a tuple of three floats, as a sky file writes it.
pybind11::object pythonValue(const Field& field, const FieldValue& value);

// The parameter at a path such as "layer.0.weather.coverage". Throws Error (badInput).
pybind11::object get(Scene& scene, const std::string& path);

// Sets it after the checks of `--set`, whose messages these are. Takes NumPy's numbers too. Throws Error (badInput).
void set(Scene& scene, const std::string& path, const pybind11::handle& value);

// Every row of the field tables, as dictionaries.
pybind11::list fields();

}  // namespace welkin::python
