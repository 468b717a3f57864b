// What is found while files are read: problems, which refuse them, and warnings, which do not.
// Everything is said once, and what a file can make us say is bounded. Single-threaded.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Problems kept: after so many a file is broken as a whole, and more sentences help nobody.
inline constexpr size_t toml_problems = 1000;
}  // namespace limits

namespace toml {

class Findings {
 public:
  /// Keeps a problem, except a second one with the same place and words.
  void problem(SourcePlace where, std::string what) {
    problem(problem_in(std::move(where), std::move(what)));
  }
  void problem(Problem p);
  /// A key stands under a former name: one warning for each such name.
  void renamed(SourcePlace where, std::string_view old_name, std::string_view name);

  /// Kept once for each place and words.
  void warning(SourcePlace where, std::string what);

  bool any_problem() const { return !problems_.empty(); }
  size_t problem_count() const { return problems_.size(); }
  /// All problems, by file in the order of their first, then by line.
  Problems take_problems();
  std::vector<Problem> take_warnings() { return std::move(warnings_); }

 private:
  std::vector<Problem> problems_;
  std::vector<Problem> warnings_;
  std::set<std::string> said_;      // "file:line: what" of every problem
  std::set<std::string> warned_;    // likewise of warnings, but for those of former names
  std::set<std::string> renamed_;   // "old name, name" of every warning
  std::vector<std::string> files_;  // in the order of their first problem
};

}  // namespace toml
}  // namespace luxodus
