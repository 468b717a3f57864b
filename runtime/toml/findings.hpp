// Findings of a reader: problems, which reject a file, and warnings, which do not. Each is reported
// once, and their number is bounded. Single-threaded.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Problems kept: a file with more is broken as a whole, and further sentences help nobody.
inline constexpr size_t toml_problems = 1000;
}  // namespace limits

namespace toml {

class Findings {
 public:
  /// Keeps a problem, unless one with the same place and words is there.
  void problem(SourcePlace where, std::string what) {
    problem(problem_in(std::move(where), std::move(what)));
  }
  void problem(Problem p);
  /// Kept once for each place and text.
  void warning(SourcePlace where, std::string what);

  bool any_problem() const { return !problems_.empty(); }
  size_t problem_count() const { return problems_.size(); }
  /// All problems, grouped by file in the order of each file's first problem, then by line.
  Problems take_problems();
  std::vector<Problem> take_warnings() { return std::move(warnings_); }

 private:
  std::vector<Problem> problems_;
  std::vector<Problem> warnings_;
  std::set<std::string> said_;      // "file:line: what" of every problem
  std::set<std::string> warned_;    // likewise for warnings
  std::vector<std::string> files_;  // in the order of their first problem
};

}  // namespace toml
}  // namespace luxodus
