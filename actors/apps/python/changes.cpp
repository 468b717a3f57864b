#include "actors/apps/python/changes.hpp"

#include <cstdio>

#include "actors/apps/python/errors.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

/// A basic string of TOML, with escapes for characters that it may not contain.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (code < 0x20 || code == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04X", code);
      out += escaped;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

/// Nested lists of a change are points at most.
constexpr int max_nesting = 3;

std::string toml_of(const py::handle& value, int line, const std::string& key, int depth = 0) {
  const auto refuse = [&] {
    return Refused(problem_in(
        named_changes, line,
        "'" + key + "' is a " + py::str(py::type::of(value).attr("__name__")).cast<std::string>() +
            "; a change has texts, numbers, truths and lists of them"));
  };
  if (py::isinstance<py::str>(value)) return quoted(value.cast<std::string>());
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value).cast<std::string>();
  if (PyFloat_Check(value.ptr())) return py::repr(py::float_(value.cast<double>()));
  if (PyIndex_Check(value.ptr()) || PyNumber_Check(value.ptr())) {
    // NumPy scalars, or an array.
    if (!py::hasattr(value, "tolist")) throw refuse();
    const py::object plain = value.attr("tolist")();
    if (py::type::of(plain).is(py::type::of(value)) || depth >= max_nesting) throw refuse();
    return toml_of(plain, line, key, depth + 1);
  }
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) throw refuse();
  if (depth >= max_nesting) throw refuse();
  std::string out = "[";
  for (const py::handle& one : value)
    out += (out.size() > 1 ? ", " : "") + toml_of(one, line, key, depth + 1);
  return out + "]";
}

}  // namespace

std::string changes_text(const py::list& changes) {
  std::string out;
  int line = 0;
  for (const py::handle& change : changes) {
    ++line;
    if (!py::isinstance<py::dict>(change))
      throw Refused(problem_in(named_changes, line,
                               "a change is a dict such as {\"kind\": \"medium\", \"of\": "
                               "\"smoke\", \"factor\": 2}"));
    std::string keys;
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(change)) {
      const auto name = py::str(key).cast<std::string>();
      keys += (keys.empty() ? "" : ", ") + quoted(name) + " = " + toml_of(value, line, name);
    }
    out += (line == 1 ? "change = [{" : ",\n{") + keys + "}";
  }
  return out.empty() ? out : out + "]\n";
}

}  // namespace luxodus::python
