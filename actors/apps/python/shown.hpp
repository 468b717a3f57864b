// What Python shows of results: types of planes, pictures and other values with a short repr, a
// table for notebooks and plots, and dicts whose missing names are answered by those that there
// are. Called with the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

namespace luxodus::python {

/// Adds the types Values, Plane, View and Names to the module.
void add_shown(pybind11::module_& module);

/// The values as attributes of a type of the module luxodus: "Plane", "View" or "Values".
pybind11::object shown_as(const char* type, const pybind11::dict& values);

/// A dict by name, whose KeyError lists the names. `kind`: "plane".
pybind11::object names_of(const char* kind, const pybind11::dict& by_name);

}  // namespace luxodus::python
