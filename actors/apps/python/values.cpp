#include "actors/apps/python/values.hpp"

#include <variant>

namespace luxodus::python {

namespace py = pybind11;

namespace {

py::object number_of(const Json& value) {
  if (value.is_number_unsigned()) return py::int_(value.get<uint64_t>());
  if (value.is_number_integer()) return py::int_(value.get<int64_t>());
  return py::float_(value.get<double>());
}

}  // namespace

py::object to_python(const Json& value) {
  if (value.is_boolean()) return py::bool_(value.get<bool>());
  if (value.is_number()) return number_of(value);
  if (value.is_string()) return py::str(value.text());
  if (value.is_array()) {
    py::list out;
    for (const Json& one : value) out.append(to_python(one));
    return out;
  }
  if (!value.is_object()) return py::none();
  py::dict out;
  for (const auto& [key, one] : value.items()) out[py::str(key)] = to_python(one);
  return out;
}

py::object whole_number(const std::string& text) {
  const auto out = py::reinterpret_steal<py::object>(PyLong_FromString(text.c_str(), nullptr, 10));
  if (!out) throw py::error_already_set();
  return out;
}

py::array_t<double> places_of(const std::vector<glm::dvec3>& places,
                              std::vector<py::ssize_t> shape) {
  shape.push_back(3);
  std::vector<double> values;
  values.reserve(3 * places.size());
  for (const glm::dvec3& p : places) values.insert(values.end(), {p.x, p.y, p.z});
  return array_of(values, shape);
}

void add_arrays(py::dict& to, const std::vector<VtkArray>& arrays,
                const std::vector<py::ssize_t>& shape) {
  for (const VtkArray& array : arrays) {
    std::vector<py::ssize_t> whole = shape;
    if (array.components > 1) whole.push_back(array.components);
    to[py::str(array.name)] = std::visit(
        [&](const auto& values) -> py::object { return array_of(values, whole); }, array.values);
  }
}

}  // namespace luxodus::python
