// Mixed-integer linear programs, solved by CBC (COIN-OR branch and cut). No other source includes
// CBC. The same program gives the same answer, unless a time limit or an interrupt ends the search.
// Thread rule: one call at a time in a process, since CBC has global state. The program's handler
// of SIGINT stays installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace luxodus {

/// low <= sum of value times variable <= high.
struct LinearRow {
  std::vector<int> column;
  std::vector<double> value;  // as many as columns
  double low = 0, high = 0;
};

/// Minimises the sum of cost times variable.
struct IntegerProgram {
  std::vector<double> cost, low, high;  // of each variable
  std::vector<char> whole;              // whether each variable is an integer
  std::vector<LinearRow> rows;

  /// Adds a variable and returns its index.
  int add_variable(double cost_of_one, double low_bound, double high_bound, bool is_whole);
};

struct ProgramLimits {
  double seconds = 60;
  /// The search ends when the best solution is within this share of the bound.
  double gap = 0;
  /// Only solutions with an objective below this are wanted.
  std::optional<double> cutoff = {};
  /// Largest number of nodes of the search tree.
  int64_t nodes = 10'000'000;
  /// Stop at the first solution.
  bool any_solution = false;
};

enum class ProgramEnd {
  solved,      // within the gap
  stopped,     // by a limit or an interrupt; `values` may be empty
  infeasible,  // no solution, or none below the cutoff
};

struct ProgramAnswer {
  ProgramEnd end = ProgramEnd::stopped;
  std::vector<double> values;  // best solution; empty: none was found
  double objective = 0;        // of `values`
  double bound = 0;            // lower bound on all solutions
};

/// Best objective and lower bound so far; without a solution the best is infinite.
using ProgramProgress = std::function<void(double best, double bound)>;

ProgramAnswer solve_program(const IntegerProgram& program, const ProgramLimits& limits,
                            const std::atomic<bool>& interrupt, const ProgramProgress& progress);

/// Dual values of the linear relaxation: for each row, the growth of the smallest objective when
/// the row's bound grows by one. Empty if the relaxation has no solution, or none within the time.
std::vector<double> row_prices(const IntegerProgram& program, double seconds,
                               const std::atomic<bool>& interrupt);

}  // namespace luxodus
