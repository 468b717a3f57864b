#include "actors/apps/python/errors.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

std::string lines_of(const std::vector<Problem>& problems) {
  std::string out;
  for (const Problem& problem : problems) out += (out.empty() ? "" : "\n") + problem.text();
  return out;
}

py::object file_of(const Problem& problem) {
  return problem.where.file.empty() ? py::none() : py::object(py::str(problem.where.file));
}

py::object line_of(const Problem& problem) {
  return problem.where.line == 0 ? py::none() : py::object(py::int_(problem.where.line));
}

/// Requires: the interpreter's lock.
void raise_error(const Refused& refused) {
  const py::object type = py::module_::import("luxodus").attr("Error");
  const py::object error = type(refused.what());
  const Problem& first = refused.problems().front();
  error.attr("file") = file_of(first);
  error.attr("line") = line_of(first);
  py::list problems;
  for (const Problem& one : refused.problems())
    problems.append(py::make_tuple(file_of(one), line_of(one), one.what));
  error.attr("problems") = problems;
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

Refused::Refused(std::vector<Problem> problems)
    : problems_(std::move(problems)), text_(lines_of(problems_)) {}

void add_error(py::module_& module) {
  const auto type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc("luxodus.Error",
                                "What was refused, in the words of the program.\n\n"
                                "file: of the first problem, None where it is of no file.\n"
                                "line: of that file, None where a line has no meaning.\n"
                                "problems: all of them, as tuples (file, line, what).",
                                PyExc_Exception, nullptr));
  if (!type) throw py::error_already_set();
  type.attr("file") = py::none();
  type.attr("line") = py::none();
  type.attr("problems") = py::tuple();
  module.attr("Error") = type;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Refused& refused) {
      raise_error(refused);
    }
  });
}

}  // namespace luxodus::python
