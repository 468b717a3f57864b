// Problems as the Python exception luxodus.Error: its text is what the program prints, its
// attributes give the place. Refused may be thrown on any thread; it becomes a Python exception
// where the interpreter's lock is held.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::python {

/// Carries problems to Python.
class Refused final : public std::exception {
 public:
  explicit Refused(Problem problem) : Refused(std::vector<Problem>{std::move(problem)}) {}
  /// Requires: there is one at least.
  explicit Refused(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::vector<Problem> problems_;
  std::string text_;  // one line for each
};

/// The value, or its problem as an exception.
template <class T>
T taken(Result<T> result) {
  if (!result) throw Refused(result.problem());
  return std::move(result).value();
}
inline void succeed(const Result<void>& result) {
  if (!result) throw Refused(result.problem());
}

/// Adds Error to the module, and translates Refused to it.
void add_error(pybind11::module_& module);

}  // namespace luxodus::python
