// Converts results to Python objects: JSON to dicts and lists, spatial values to NumPy arrays.
// Called with the interpreter's lock.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/write_vtk.hpp"

namespace luxodus::python {

/// Objects become dicts in the same order, lists lists, null None.
pybind11::object to_python(const Json& value);

/// A whole number of any length as a Python int. Requires: `text` is one.
pybind11::object whole_number(const std::string& text);

/// A copy with this shape. Requires: as many values.
template <class T>
pybind11::array_t<T> array_of(const std::vector<T>& values,
                              const std::vector<pybind11::ssize_t>& shape) {
  return pybind11::array_t<T>(shape, values.data());
}
/// Places [m] with a last axis of x, y, z.
pybind11::array_t<double> places_of(const std::vector<glm::dvec3>& places,
                                    std::vector<pybind11::ssize_t> shape);

/// Adds each array of a file for ParaView as an attribute. `shape`: of its cells; an array of
/// several components has a further axis.
void add_arrays(pybind11::dict& to, const std::vector<VtkArray>& arrays,
                const std::vector<pybind11::ssize_t>& shape);

}  // namespace luxodus::python
