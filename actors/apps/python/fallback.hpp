// Keys of JSON as attributes of an object that has other attributes. Called with the interpreter's
// lock.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace luxodus::python {

/// The value of a key. `values` is called only if needed: notebooks ask every object for names that
/// begin with an underscore, which no key has.
/// Errors: AttributeError if there is no such key.
template <class Values>
pybind11::object value_of(const Values& values, const std::string& name, const char* type) {
  const pybind11::str key(name);
  if (name.rfind('_', 0) != 0) {
    const pybind11::dict& all = values();
    if (all.contains(key)) return all[key];
  }
  PyErr_SetString(PyExc_AttributeError,
                  (std::string(type) + " has no attribute '" + name + "'").c_str());
  throw pybind11::error_already_set();
}

/// The result of dir(): attributes of the type, and keys.
inline pybind11::list names_with(const pybind11::object& self, const pybind11::dict& values) {
  pybind11::list out(pybind11::module_::import("builtins").attr("dir")(pybind11::type::of(self)));
  for (const auto& item : values) out.append(item.first);
  return out;
}

}  // namespace luxodus::python
